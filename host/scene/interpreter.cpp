#include "scene/interpreter.h"

#include "base/suggest.h"
#include "scene/spelling.h"

#include <algorithm>
#include <filesystem>

namespace slant {
namespace {

// No real scene comes near these; they keep hostile ones from filling memory.
constexpr std::size_t kMaxNesting = 1000; // open AttributeBegin
constexpr std::size_t kMaxFileDepth = 32; // Include within Include
constexpr std::size_t kMaxFilesRead = 10000;
constexpr std::size_t kMaxTextBytes = std::size_t(1) << 32;
constexpr std::size_t kMaxDefaults = 256; // Attribute parameters of one target

std::string canonical(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::weakly_canonical(path, ignored).string();
}

} // namespace

Interpreter::Interpreter(const std::string& directory, Scene& scene, Issues& issues, Monitor& monitor)
    : scene_(scene), issues_(issues), files_(directory, scene, monitor), textures_(scene, files_, issues),
      materials_(issues), options_(issues) {}

const std::map<std::string_view, Interpreter::Directive>& Interpreter::directives() {
    using I = Interpreter;
    using Block = Directive::Block;
    static const std::map<std::string_view, Directive> table{
        {"Accelerator", {Block::options, &I::accelerator}},
        {"ActiveTransform", {Block::any, &I::activeTransform}},
        {"AreaLightSource", {Block::world, &I::areaLightSource}},
        {"Attribute", {Block::any, &I::attribute}},
        {"AttributeBegin", {Block::world, &I::attributeBegin}},
        {"AttributeEnd", {Block::world, &I::attributeEnd}},
        {"Camera", {Block::options, &I::camera}},
        {"ColorSpace", {Block::any, &I::colorSpace}},
        {"ConcatTransform", {Block::any, &I::concatTransform}},
        {"CoordSysTransform", {Block::any, &I::coordSysTransform}},
        {"CoordinateSystem", {Block::any, &I::coordinateSystem}},
        {"Film", {Block::options, &I::film}},
        {"Identity", {Block::any, &I::identity}},
        {"Import", {Block::world, &I::import}},
        {"Include", {Block::any, &I::include}},
        {"Integrator", {Block::options, &I::integrator}},
        {"LightSource", {Block::world, &I::lightSource}},
        {"LookAt", {Block::any, &I::lookAt}},
        {"MakeNamedMaterial", {Block::world, &I::makeNamedMaterial}},
        {"MakeNamedMedium", {Block::any, &I::makeNamedMedium}},
        {"Material", {Block::world, &I::material}},
        {"MediumInterface", {Block::any, &I::mediumInterface}},
        {"NamedMaterial", {Block::world, &I::namedMaterial}},
        {"ObjectBegin", {Block::world, &I::objectBegin}},
        {"ObjectEnd", {Block::world, &I::objectEnd}},
        {"ObjectInstance", {Block::world, &I::objectInstance}},
        {"Option", {Block::any, &I::option}},
        {"PixelFilter", {Block::options, &I::pixelFilter}},
        {"Renderer", {Block::options, &I::renderer}},
        {"ReverseOrientation", {Block::world, &I::reverseOrientation}},
        {"Rotate", {Block::any, &I::rotate}},
        {"Sampler", {Block::options, &I::sampler}},
        {"Scale", {Block::any, &I::scale}},
        {"Shape", {Block::world, &I::shape}},
        {"SurfaceIntegrator", {Block::options, &I::integrator}},
        {"Texture", {Block::world, &I::texture}},
        {"Transform", {Block::any, &I::transform}},
        {"TransformBegin", {Block::world, &I::transformBegin}},
        {"TransformEnd", {Block::world, &I::attributeEnd}},
        {"TransformTimes", {Block::options, &I::transformTimes}},
        {"Translate", {Block::any, &I::translate}},
        {"Volume", {Block::world, &I::volume}},
        {"VolumeIntegrator", {Block::options, &I::renderer}},
        {"WorldBegin", {Block::options, &I::worldBegin}},
        {"WorldEnd", {Block::world, &I::worldEnd}},
    };
    return table;
}

void Interpreter::run(const std::string& name, const std::string& text) {
    fileNames_.push_back(name);
    openFiles_.push_back(canonical(name));
    textBytes_ += text.size();
    Tokenizer tokens(text, &fileNames_.back());
    while (tokens.peek().kind != TokenKind::end) {
        const Token token = tokens.next();
        const auto directive = directives().find(token.kind == TokenKind::word ? token.text : "");
        if (directive == directives().end()) {
            std::vector<std::string_view> names;
            for (const auto& entry : directives()) names.push_back(entry.first);
            throw syntaxError(token.position, "unknown directive {}{}", token.shown(),
                              didYouMean(token.text, names));
        }
        const auto block = directive->second.block;
        if (block == Directive::Block::world && !inWorld_)
            throw syntaxError(token.position, "{} must stand after WorldBegin", token.text);
        if (block == Directive::Block::options && inWorld_)
            throw syntaxError(token.position, "{} must stand before WorldBegin", token.text);
        carryOut(directive->second, tokens, token.position);
    }
    openFiles_.pop_back();
}

void Interpreter::carryOut(const Directive& directive, Tokenizer& tokens, const Position& where) {
    if (issues_.attempt("it is left out", [&] { (this->*directive.handler)(tokens, where); })) return;
    // The handler may have stopped before its last word.
    const auto isDirective = [](const Token& token) {
        return token.kind == TokenKind::end ||
               (token.kind == TokenKind::word && directives().contains(token.text));
    };
    while (!isDirective(tokens.peek())) tokens.next();
}

void Interpreter::runFile(Tokenizer& tokens, const Position& where) {
    const Token filename = tokens.next();
    const std::string path = files_.resolve(stringOf(filename));
    if (std::find(openFiles_.begin(), openFiles_.end(), canonical(path)) != openFiles_.end())
        throw syntaxError(where, "{} includes itself", path);
    if (openFiles_.size() > kMaxFileDepth)
        throw syntaxError(where, "files are included more than {} deep", kMaxFileDepth);
    const std::string text = readBytes(path, filename.position);
    scene_.files.push_back(path);
    if (++filesRead_ > kMaxFilesRead || textBytes_ + text.size() > kMaxTextBytes)
        throw syntaxError(where, "more than {} files or {} bytes are included", kMaxFilesRead, kMaxTextBytes);
    run(path, text);
}

void Interpreter::include(Tokenizer& tokens, const Position& where) {
    runFile(tokens, where);
}

void Interpreter::import(Tokenizer& tokens, const Position& where) {
    // pbrt reads an imported file beside the rest: its attributes and transforms stay its own.
    const GraphicsState state = state_;
    const auto coordinateSystems = coordinateSystems_;
    const std::size_t depth = saved_.size();
    const int object = openObject_;
    runFile(tokens, where);
    if (saved_.size() != depth || openObject_ != object)
        throw syntaxError(where, "the imported file must close all that it opens, and nothing else");
    state_ = state;
    coordinateSystems_ = coordinateSystems;
}

void Interpreter::worldBegin(Tokenizer&, const Position&) {
    inWorld_ = true;
    state_.transform = {};
    state_.active = ActiveTransform::all;
    coordinateSystems_["world"] = state_.transform;
    options_.resolve(scene_, files_);
}

void Interpreter::push(bool isObject, const Position& where) {
    if (saved_.size() >= kMaxNesting)
        throw syntaxError(where, "attributes are nested more than {} deep", kMaxNesting);
    saved_.push_back({state_, isObject, where});
}

void Interpreter::pop(bool isObject, const char* directive, const char* opening, const Position& where) {
    if (saved_.empty()) throw syntaxError(where, "{} without {}", directive, opening);
    // Older files may end their attributes within an object that they began outside of it.
    if (saved_.back().isObject != isObject && !isOlder_)
        throw syntaxError(where, "{} within the {} of line {}", directive,
                          isObject ? "AttributeBegin" : "ObjectBegin", saved_.back().where.line);
    state_ = std::move(saved_.back().state);
    saved_.pop_back();
}

void Interpreter::attributeBegin(Tokenizer&, const Position& where) {
    push(false, where);
}

void Interpreter::attributeEnd(Tokenizer&, const Position& where) {
    pop(false, "AttributeEnd", "AttributeBegin", where);
}

void Interpreter::transformBegin(Tokenizer&, const Position& where) {
    issues_.note(where,
                 "TransformBegin and TransformEnd are deprecated and mean AttributeBegin and AttributeEnd");
    push(false, where);
}

void Interpreter::attribute(Tokenizer& tokens, const Position&) {
    constexpr std::string_view kTargets[] = {"shape", "light", "material", "texture"};
    const Token token = tokens.next();
    const std::string name = stringOf(token);
    const auto target = std::find(std::begin(kTargets), std::end(kTargets), name);
    if (target == std::end(kTargets))
        throw badInput(token.position, "unknown attribute target {}{}", token.shown(),
                       didYouMean(name, kTargets));
    ParameterVector& defaults = state_.defaults[std::size_t(target - std::begin(kTargets))];
    for (auto& parameter : parameters(tokens)) {
        // The last one counts; those before it need not be kept.
        std::erase_if(defaults, [&](const auto& p) {
            return p->name == parameter->name && p->type == parameter->type;
        });
        if (defaults.size() >= kMaxDefaults)
            throw syntaxError(parameter->position, "more than {} attributes of one target", kMaxDefaults);
        defaults.push_back(std::move(parameter));
    }
}

void Interpreter::finish() {
    const Position end{fileNames_.empty() ? nullptr : &fileNames_.front(), 0, 0};
    if (!inWorld_ && issues_.empty()) throw syntaxError(end, "the file has no WorldBegin");
    if (!saved_.empty())
        throw syntaxError(saved_.back().where, "this {} is never closed",
                          saved_.back().isObject ? "ObjectBegin" : "AttributeBegin");
    textures_.buildAll();
    materials_.build(scene_, textures_, files_);
    dropInterfaces(scene_);
    for (const PendingInstance& instance : instances_)
        issues_.attempt("it is left out", [&] { place(instance); });
}

void Interpreter::place(const PendingInstance& instance) {
    const auto object = objects_.find(instance.name);
    if (object == objects_.end()) {
        std::vector<std::string_view> names;
        for (const auto& entry : objects_) names.push_back(entry.first);
        throw badInput(instance.where, "there is no object '{}'{}", printable(instance.name),
                       didYouMean(instance.name, names));
    }
    scene_.instances.push_back({object->second, instance.transform});
}

} // namespace slant
