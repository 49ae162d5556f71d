// Carries out the directives of scene text, one by one, on a Scene.
#pragma once
#include "scene/graphics_state.h"
#include "scene/material_table.h"
#include "scene/option_block.h"
#include "scene/scene_files.h"
#include "scene/texture_table.h"
#include "scene/tokenizer.h"

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace slant {

class Monitor;

/// Feed it the main text, then finish(). What is wrong or not supported goes to the issues, and reading goes
/// on; throws Error(badInput) where that makes no sense.
class Interpreter {
public:
    /// `directory` is where relative file names start. All must outlive this.
    Interpreter(const std::string& directory, Scene& scene, Issues& issues, Monitor& monitor);

    void run(const std::string& name, const std::string& text);
    void finish();

private:
    using Handler = void (Interpreter::*)(Tokenizer&, const Position&);
    struct Directive {
        enum class Block { any, options, world } block;
        Handler handler;
    };
    struct Saved {
        GraphicsState state;
        bool isObject;
        Position where;
    };
    struct PendingInstance {
        std::string name;
        MovingTransform transform;
        Position where;
    };

    static const std::map<std::string_view, Directive>& directives();

    // interpreter.cpp: text, blocks, nesting
    void runFile(Tokenizer& tokens, const Position& where);
    void include(Tokenizer& tokens, const Position& where);
    void import(Tokenizer& tokens, const Position& where);
    void worldBegin(Tokenizer& tokens, const Position& where);
    void attributeBegin(Tokenizer& tokens, const Position& where);
    void attributeEnd(Tokenizer& tokens, const Position& where);
    void transformBegin(Tokenizer& tokens, const Position& where);
    void attribute(Tokenizer& tokens, const Position& where);
    void place(const PendingInstance& instance);
    void push(bool isObject, const Position& where);
    void pop(bool isObject, const char* directive, const char* opening, const Position& where);
    void carryOut(const Directive& directive, Tokenizer& tokens, const Position& where);

    // interpreter_transforms.cpp
    void identity(Tokenizer& tokens, const Position& where);
    void translate(Tokenizer& tokens, const Position& where);
    void scale(Tokenizer& tokens, const Position& where);
    void rotate(Tokenizer& tokens, const Position& where);
    void lookAt(Tokenizer& tokens, const Position& where);
    void transform(Tokenizer& tokens, const Position& where);
    void concatTransform(Tokenizer& tokens, const Position& where);
    void coordinateSystem(Tokenizer& tokens, const Position& where);
    void coordSysTransform(Tokenizer& tokens, const Position& where);
    void activeTransform(Tokenizer& tokens, const Position& where);
    void transformTimes(Tokenizer& tokens, const Position& where);
    void multiply(const glm::dmat4& matrix, const Position& where);
    void setTransform(const MovingTransform& transform, const Position& where);

    // interpreter_entities.cpp: what makes the scene
    void film(Tokenizer& tokens, const Position& where);
    void pixelFilter(Tokenizer& tokens, const Position& where);
    void sampler(Tokenizer& tokens, const Position& where);
    void integrator(Tokenizer& tokens, const Position& where);
    void accelerator(Tokenizer& tokens, const Position& where);
    void camera(Tokenizer& tokens, const Position& where);
    void option(Tokenizer& tokens, const Position& where);
    void colorSpace(Tokenizer& tokens, const Position& where);
    void renderer(Tokenizer& tokens, const Position& where);
    void worldEnd(Tokenizer& tokens, const Position& where);
    void volume(Tokenizer& tokens, const Position& where);
    void mediumInterface(Tokenizer& tokens, const Position& where);
    void makeNamedMedium(Tokenizer& tokens, const Position& where);
    void reverseOrientation(Tokenizer& tokens, const Position& where);
    void material(Tokenizer& tokens, const Position& where);
    void makeNamedMaterial(Tokenizer& tokens, const Position& where);
    void namedMaterial(Tokenizer& tokens, const Position& where);
    void texture(Tokenizer& tokens, const Position& where);
    void lightSource(Tokenizer& tokens, const Position& where);
    void areaLightSource(Tokenizer& tokens, const Position& where);
    void shape(Tokenizer& tokens, const Position& where);
    void objectBegin(Tokenizer& tokens, const Position& where);
    void objectEnd(Tokenizer& tokens, const Position& where);
    void objectInstance(Tokenizer& tokens, const Position& where);
    void setOption(const char* directive, Tokenizer& tokens, const Position& where);
    ParameterList list(std::string_view directive, std::string& kind, Tokenizer& tokens,
                       const Position& where, const ParameterVector& inherited = {});
    ParameterVector parameters(Tokenizer& tokens) const;
    const ParameterVector& defaults(AttributeTarget target) const;
    void warnIfMoving(const char* what, const Position& where);
    void noteOlder(const Position& where);
    std::optional<MovingTransform> placement(const Position& where);

    Scene& scene_;
    Issues& issues_;
    SceneFiles files_;
    TextureTable textures_;
    MaterialTable materials_;
    OptionBlock options_;
    GraphicsState state_;
    std::vector<Saved> saved_;
    bool inWorld_ = false, isOlder_ = false;
    std::array<double, 2> transformTimes_{0, 1};
    std::map<std::string, MovingTransform> coordinateSystems_;
    std::map<std::string, int> objects_;
    int openObject_ = -1; // index in Scene::objects
    std::vector<PendingInstance> instances_;

    std::deque<std::string> fileNames_;  // what Positions point to
    std::vector<std::string> openFiles_; // canonical paths, outermost first
    std::size_t filesRead_ = 0, textBytes_ = 0;
};

} // namespace slant
