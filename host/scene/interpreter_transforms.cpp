// The transform directives.
#include "base/suggest.h"
#include "scene/interpreter.h"

#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace slant {
namespace {

/// N numbers, with or without brackets.
template <std::size_t N>
std::array<double, N> readNumbers(Tokenizer& tokens) {
    const bool bracketed = tokens.peek().kind == TokenKind::open;
    if (bracketed) tokens.next();
    std::array<double, N> numbers;
    for (double& number : numbers) number = numberOf(tokens.next());
    if (!bracketed) return numbers;
    if (const Token token = tokens.next(); token.kind != TokenKind::close)
        throw badInput(token.position, "expected ']' after {} numbers, found {}", N, token.shown());
    return numbers;
}

/// pbrt writes matrices column by column, as GLM keeps them.
glm::dmat4 readMatrix(Tokenizer& tokens, const Position& where) {
    return affine(glm::make_mat4(readNumbers<16>(tokens).data()), where);
}

} // namespace

void Interpreter::setTransform(const MovingTransform& transform, const Position& where) {
    checkFinite(transform, where);
    state_.transform = transform;
}

void Interpreter::multiply(const glm::dmat4& matrix, const Position& where) {
    MovingTransform product = state_.transform;
    if (state_.active != ActiveTransform::end) product.at[0] = product.at[0] * matrix;
    if (state_.active != ActiveTransform::start) product.at[1] = product.at[1] * matrix;
    setTransform(product, where);
}

void Interpreter::identity(Tokenizer&, const Position&) {
    if (state_.active != ActiveTransform::end) state_.transform.at[0] = glm::dmat4(1);
    if (state_.active != ActiveTransform::start) state_.transform.at[1] = glm::dmat4(1);
}

void Interpreter::translate(Tokenizer& tokens, const Position& where) {
    const auto [x, y, z] = readNumbers<3>(tokens);
    multiply(glm::translate(glm::dmat4(1), {x, y, z}), where);
}

void Interpreter::scale(Tokenizer& tokens, const Position& where) {
    const auto [x, y, z] = readNumbers<3>(tokens);
    multiply(glm::scale(glm::dmat4(1), {x, y, z}), where);
}

void Interpreter::rotate(Tokenizer& tokens, const Position& where) {
    const auto [degrees, x, y, z] = readNumbers<4>(tokens);
    if (x == 0 && y == 0 && z == 0) throw badInput(where, "Rotate needs an axis that is not 0 0 0");
    multiply(rotation(degrees, {x, y, z}), where);
}

void Interpreter::lookAt(Tokenizer& tokens, const Position& where) {
    const auto n = readNumbers<9>(tokens);
    multiply(slant::lookAt({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}, where), where);
}

void Interpreter::transform(Tokenizer& tokens, const Position& where) {
    const glm::dmat4 matrix = readMatrix(tokens, where);
    identity(tokens, where);
    multiply(matrix, where);
}

void Interpreter::concatTransform(Tokenizer& tokens, const Position& where) {
    multiply(readMatrix(tokens, where), where);
}

void Interpreter::coordinateSystem(Tokenizer& tokens, const Position&) {
    coordinateSystems_[stringOf(tokens.next())] = state_.transform;
}

void Interpreter::coordSysTransform(Tokenizer& tokens, const Position& where) {
    const Token token = tokens.next();
    const auto system = coordinateSystems_.find(stringOf(token));
    if (system == coordinateSystems_.end()) {
        std::vector<std::string_view> names;
        for (const auto& entry : coordinateSystems_) names.push_back(entry.first);
        throw badInput(token.position, "there is no coordinate system {}{}", token.shown(),
                       didYouMean(token.text, names));
    }
    setTransform(system->second, where);
}

void Interpreter::activeTransform(Tokenizer& tokens, const Position&) {
    constexpr std::string_view kWhich[] = {"All", "StartTime", "EndTime"};
    const Token token = tokens.next();
    if (token.kind == TokenKind::word && token.text == kWhich[0])
        state_.active = ActiveTransform::all;
    else if (token.kind == TokenKind::word && token.text == kWhich[1])
        state_.active = ActiveTransform::start;
    else if (token.kind == TokenKind::word && token.text == kWhich[2])
        state_.active = ActiveTransform::end;
    else
        throw badInput(token.position, "ActiveTransform takes All, StartTime or EndTime, not {}{}",
                       token.shown(), didYouMean(token.text, kWhich));
}

void Interpreter::transformTimes(Tokenizer& tokens, const Position& where) {
    const auto [start, end] = readNumbers<2>(tokens);
    if (!(start < end)) throw badInput(where, "TransformTimes needs a start before the end");
    transformTimes_ = {start, end};
}

} // namespace slant
