#include "scene/parameters.h"

#include "base/suggest.h"
#include "scene/spelling.h"

#include <algorithm>
#include <array>

namespace slant {
namespace {

enum class Values { numbers, integers, strings, flags, spectrum };

struct Type {
    std::string_view name;
    Values values;
    std::size_t perItem;
};

constexpr Type kTypes[] = {
    {"bool", Values::flags, 1},        {"float", Values::numbers, 1},     {"integer", Values::integers, 1},
    {"point2", Values::numbers, 2},    {"vector2", Values::numbers, 2},   {"point3", Values::numbers, 3},
    {"vector3", Values::numbers, 3},   {"normal", Values::numbers, 3},    {"xyz", Values::numbers, 3},
    {"string", Values::strings, 1},    {"texture", Values::strings, 1},   {"rgb", Values::numbers, 3},
    {"spectrum", Values::spectrum, 2}, {"blackbody", Values::numbers, 1},
};

/// Types of older files, and other spellings, and what they are called now.
constexpr std::array<std::string_view, 2> kRenamed[] = {
    {"color", "rgb"}, {"point", "point3"}, {"vector", "vector3"}, {"normal3", "normal"}};

const Type& typeOf(const std::string& name, const Position& position) {
    for (const Type& type : kTypes)
        if (type.name == name) return type;
    std::vector<std::string_view> names;
    for (const Type& type : kTypes) names.push_back(type.name);
    throw syntaxError(position, "unknown parameter type '{}'{}", printable(name), didYouMean(name, names));
}

/// Splits "type name" of a declaration.
Parameter declared(const Token& token) {
    const std::string_view text = token.text, blanks = " \t";
    const auto word = [&](std::size_t from) {
        const std::size_t first = std::min(text.find_first_not_of(blanks, from), text.size());
        return std::pair(first, std::min(text.find_first_of(blanks, first), text.size()));
    };
    const auto [typeFirst, typeEnd] = word(0);
    const auto [nameFirst, nameEnd] = word(typeEnd);
    if (nameFirst == text.size() || word(nameEnd).first != text.size())
        throw syntaxError(token.position, "expected a parameter such as \"float radius\", found {}",
                          token.shown());
    Parameter parameter;
    parameter.type = text.substr(typeFirst, typeEnd - typeFirst);
    parameter.name = text.substr(nameFirst, nameEnd - nameFirst);
    parameter.position = token.position;
    return parameter;
}

bool flagOf(const Token& token) {
    // In quotes in older files.
    const bool isText = token.kind == TokenKind::word || token.kind == TokenKind::string;
    if (isText && (token.text == "true" || token.text == "false")) return token.text == "true";
    throw syntaxError(token.position, "expected true or false, found {}", token.shown());
}

void appendValue(Parameter& parameter, Values values, const Token& token) {
    const bool named = token.kind == TokenKind::string && parameter.numbers.empty();
    switch (values) {
    case Values::flags:
        parameter.flags.push_back(flagOf(token));
        break;
    case Values::integers:
        parameter.numbers.push_back(integerOf(token));
        break;
    case Values::strings:
        parameter.strings.push_back(stringOf(token));
        break;
    case Values::spectrum:
        if (named || !parameter.strings.empty()) {
            parameter.strings.push_back(stringOf(token));
            break;
        }
        [[fallthrough]];
    case Values::numbers:
        parameter.numbers.push_back(numberOf(token));
        break;
    }
}

Parameter readParameter(Tokenizer& tokens) {
    Parameter parameter = declared(tokens.next());
    for (const auto& [other, current] : kRenamed)
        if (parameter.type == other) parameter.type = current;
    const Type& type = typeOf(parameter.type, parameter.position);
    Token token = tokens.next();
    if (token.kind == TokenKind::open) {
        const Position opened = token.position;
        for (token = tokens.next(); token.kind != TokenKind::close; token = tokens.next()) {
            if (token.kind == TokenKind::end) throw syntaxError(opened, "this '[' is never closed");
            appendValue(parameter, type.values, token);
        }
    } else {
        appendValue(parameter, type.values, token);
    }
    if (parameter.numbers.empty() && parameter.strings.empty() && parameter.flags.empty())
        throw syntaxError(parameter.position, "parameter '{}' has no values", printable(parameter.name));
    if (parameter.numbers.size() % type.perItem != 0)
        throw syntaxError(parameter.position, "'{}' has {} numbers, not a multiple of {} as type {} needs",
                          printable(parameter.name), parameter.numbers.size(), type.perItem, type.name);
    return parameter;
}

void becomeRgb(Parameter& xyz) {
    xyz.type = "rgb";
    for (std::size_t i = 0; i < xyz.numbers.size(); i += 3) {
        const glm::dvec3 rgb = rec709FromXyz({xyz.numbers[i], xyz.numbers[i + 1], xyz.numbers[i + 2]});
        for (int c = 0; c < 3; ++c) xyz.numbers[i + std::size_t(c)] = std::max(rgb[c], 0.0);
    }
}

std::string joined(ParameterList::Types words) {
    std::string list;
    for (const std::string_view word : words) list += (list.empty() ? "" : ", ") + std::string(word);
    return list;
}

} // namespace

ParameterVector readParameters(Tokenizer& tokens, const ColourSpace* colourSpace) {
    ParameterVector parameters;
    while (tokens.peek().kind == TokenKind::string) {
        Parameter parameter = readParameter(tokens);
        if (parameter.type == "rgb") parameter.colourSpace = colourSpace;
        if (parameter.type == "xyz") becomeRgb(parameter);
        parameters.push_back(std::make_shared<const Parameter>(std::move(parameter)));
    }
    return parameters;
}

ParameterList::ParameterList(Position position, std::string subject, ParameterVector own, Issues& issues,
                             const ParameterVector& inherited)
    : position_(position), subject_(std::move(subject)), issues_(&issues) {
    for (auto parameter = own.rbegin(); parameter != own.rend(); ++parameter)
        entries_.push_back({std::move(*parameter), false});
    for (auto parameter = inherited.rbegin(); parameter != inherited.rend(); ++parameter)
        entries_.push_back({*parameter, true});
}

bool ParameterList::asked(std::string_view name) const {
    return std::find(asked_.begin(), asked_.end(), name) != asked_.end();
}

const Parameter* ParameterList::find(std::string_view name, Types types) {
    if (!asked(name)) asked_.emplace_back(name);
    for (const auto& [parameter, inherited] : entries_) {
        if (parameter->name != name) continue;
        if (std::find(types.begin(), types.end(), parameter->type) != types.end()) return parameter.get();
        // A default may be meant for another kind of shape or material.
        if (!inherited)
            throw badInput(parameter->position, "'{}' of {} is given as {}, but must be {}", name, subject_,
                           parameter->type, joined(types));
    }
    return nullptr;
}

const Parameter* ParameterList::single(std::string_view name, std::string_view type, std::size_t count) {
    const Parameter* parameter = find(name, {type});
    if (!parameter) return nullptr;
    if (parameter->numbers.size() + parameter->strings.size() + parameter->flags.size() != count)
        throw badInput(parameter->position, "'{}' must have one value", name);
    return parameter;
}

void checkRange(double value, Range range, const Parameter& parameter) {
    if (value <= range.high && (range.excludesLow ? value > range.low : value >= range.low)) return;
    std::string bounds = fmt::format("{} {}", range.excludesLow ? "above" : "at least", range.low);
    if (range.high < std::numeric_limits<double>::infinity())
        bounds += fmt::format(" and at most {}", range.high);
    throw badInput(parameter.position, "'{}' is {}, but must be {}", parameter.name, value, bounds);
}

std::optional<float> ParameterList::number(std::string_view name, Range range) {
    const Parameter* parameter = single(name, "float");
    if (!parameter) return std::nullopt;
    checkRange(parameter->numbers[0], range, *parameter);
    return float(parameter->numbers[0]);
}

float ParameterList::number(std::string_view name, float fallback, Range range) {
    return number(name, range).value_or(fallback);
}

int ParameterList::integer(std::string_view name, int fallback, int low, int high) {
    const Parameter* parameter = single(name, "integer");
    if (!parameter) return fallback;
    checkRange(parameter->numbers[0], {double(low), double(high), false}, *parameter);
    return int(parameter->numbers[0]);
}

bool ParameterList::flag(std::string_view name, bool fallback) {
    const Parameter* parameter = single(name, "bool");
    return parameter ? bool(parameter->flags[0]) : fallback;
}

std::optional<std::string> ParameterList::text(std::string_view name) {
    const Parameter* parameter = single(name, "string");
    if (!parameter) return std::nullopt;
    return parameter->strings[0];
}

std::string ParameterList::choice(std::string_view name, std::string_view fallback, Types options) {
    const Parameter* parameter = single(name, "string");
    if (!parameter) return std::string(fallback);
    const std::string& chosen = parameter->strings[0];
    if (std::find(options.begin(), options.end(), chosen) != options.end()) return chosen;
    throw badInput(parameter->position, "'{}' is \"{}\", but must be one of: {}{}", name, printable(chosen),
                   joined(options), didYouMean(chosen, options));
}

glm::vec3 ParameterList::triple(std::string_view name, std::string_view type, glm::vec3 fallback) {
    const Parameter* parameter = single(name, type, 3);
    if (!parameter) return fallback;
    return {parameter->numbers[0], parameter->numbers[1], parameter->numbers[2]};
}

std::vector<float> ParameterList::numbers(std::string_view name) {
    const Parameter* parameter = find(name, {"float"});
    if (!parameter) return {};
    return {parameter->numbers.begin(), parameter->numbers.end()};
}

std::vector<int> ParameterList::integers(std::string_view name) {
    const Parameter* parameter = find(name, {"integer"});
    if (!parameter) return {};
    return {parameter->numbers.begin(), parameter->numbers.end()};
}

std::vector<glm::vec2> ParameterList::pairs(std::string_view name, std::string_view type) {
    const Parameter* parameter = find(name, {type});
    std::vector<glm::vec2> items(parameter ? parameter->numbers.size() / 2 : 0);
    for (std::size_t i = 0; i < items.size(); ++i)
        items[i] = {parameter->numbers[2 * i], parameter->numbers[2 * i + 1]};
    return items;
}

std::vector<glm::vec3> ParameterList::triples(std::string_view name, std::string_view type) {
    const Parameter* parameter = find(name, {type});
    std::vector<glm::vec3> items(parameter ? parameter->numbers.size() / 3 : 0);
    for (std::size_t i = 0; i < items.size(); ++i)
        items[i] = {parameter->numbers[3 * i], parameter->numbers[3 * i + 1], parameter->numbers[3 * i + 2]};
    return items;
}

Position ParameterList::positionOf(std::string_view name) const {
    for (const Entry& entry : entries_)
        if (entry.parameter->name == name) return entry.parameter->position;
    return position_;
}

void ParameterList::ignore(Types names) {
    for (const std::string_view name : names) asked_.emplace_back(name);
}

void ParameterList::ignoreRest() {
    for (const Entry& entry : entries_) asked_.push_back(entry.parameter->name);
}

void ParameterList::finish() {
    for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
        const Parameter& parameter = *entry->parameter;
        if (entry->inherited || asked(parameter.name)) continue;
        std::vector<std::string_view> names; // what is given, too, was not meant
        for (const std::string& name : asked_)
            if (std::none_of(entries_.begin(), entries_.end(),
                             [&](const Entry& other) { return other.parameter->name == name; }))
                names.push_back(name);
        report(unsupported(parameter.position, "{} has no parameter '{}', or none that is supported{}",
                           subject_, printable(parameter.name), didYouMean(parameter.name, names)));
    }
}

} // namespace slant
