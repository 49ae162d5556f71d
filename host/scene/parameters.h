// Parameter lists of directives: `"type name" values...`, typed look-ups with defaults, and the rule that an
// unused parameter is not supported.
#pragma once
#include "scene/colour_space.h"
#include "scene/issues.h"
#include "scene/tokenizer.h"

#include <glm/glm.hpp>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slant {

/// One parameter as written. Values fit the type (checked when read): `strings` for string, texture and
/// named spectra, `flags` for bool, else `numbers`, a whole number of items (3 a point3, ...), never none.
struct Parameter {
    std::string type{}, name{};
    Position position{};
    std::vector<double> numbers{};
    std::vector<std::string> strings{};
    std::vector<bool> flags{};
    const ColourSpace* colourSpace = nullptr; ///< of an rgb; Rec.709 if null
};

/// Shared, so that attribute defaults are not copied for each shape.
using ParameterVector = std::vector<std::shared_ptr<const Parameter>>;

/// Reads what follows a directive up to the next word. Throws SyntaxError.
ParameterVector readParameters(Tokenizer& tokens, const ColourSpace* colourSpace);

/// Values that a number may have.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool excludesLow = false;
};
inline constexpr Range kPositive{0, std::numeric_limits<double>::infinity(), true};
inline constexpr Range kNonNegative{0, std::numeric_limits<double>::infinity(), false};

/// The parameters of one directive, with the Attribute defaults behind them. As in pbrt, the last of several
/// with the same name counts, and a default only applies if the directive has none. Look-ups throw
/// Error(badInput) with the place of the parameter.
class ParameterList {
public:
    using Types = std::initializer_list<std::string_view>;

    /// `subject` names the owner in messages, e.g. `Shape "sphere"`. `issues` must outlive the list.
    ParameterList(Position position, std::string subject, ParameterVector own, Issues& issues,
                  const ParameterVector& inherited = {});

    const Position& position() const { return position_; }
    const std::string& subject() const { return subject_; }

    /// The parameter of that name, nullptr if there is none; an error if it is of none of `types`.
    const Parameter* find(std::string_view name, Types types);

    std::optional<float> number(std::string_view name, Range range = {});
    float number(std::string_view name, float fallback, Range range = {});
    int integer(std::string_view name, int fallback, int low, int high);
    bool flag(std::string_view name, bool fallback);
    std::optional<std::string> text(std::string_view name);
    /// One of `options`; anything else is an error.
    std::string choice(std::string_view name, std::string_view fallback, Types options);
    glm::vec3 triple(std::string_view name, std::string_view type, glm::vec3 fallback);

    std::vector<float> numbers(std::string_view name);
    std::vector<int> integers(std::string_view name);
    std::vector<glm::vec2> pairs(std::string_view name, std::string_view type);
    std::vector<glm::vec3> triples(std::string_view name, std::string_view type);

    /// Place of the parameter if it is there, else of the directive.
    Position positionOf(std::string_view name) const;

    /// Accepts parameters that cannot change the picture.
    void ignore(Types names);
    /// Accepts all others.
    void ignoreRest();
    /// Adds what is not supported to the issues, and lets its owner go on without it.
    void report(const Unsupported& error) {
        issues_->attempt("it is ignored", [&] { throw error; });
    }
    /// A warning about a parameter.
    void note(std::string_view name, const std::string& message) { issues_->note(positionOf(name), message); }
    /// Reports the parameters that nobody asked for.
    void finish();

private:
    struct Entry {
        std::shared_ptr<const Parameter> parameter;
        bool inherited = false;
    };

    const Parameter* single(std::string_view name, std::string_view type, std::size_t count = 1);
    bool asked(std::string_view name) const;

    Position position_;
    std::string subject_;
    Issues* issues_;
    std::vector<Entry> entries_; // in order of precedence
    std::vector<std::string> asked_;
};

/// Throws if `value` lies outside `range`.
void checkRange(double value, Range range, const Parameter& parameter);

} // namespace slant
