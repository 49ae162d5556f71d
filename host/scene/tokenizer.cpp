#include "scene/tokenizer.h"

#include "scene/issues.h"
#include "scene/spelling.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace slant {
namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
bool endsWord(char c) {
    return isBlank(c) || c == '"' || c == '[' || c == ']' || c == '#';
}

char unescape(char c, const Position& position) {
    switch (c) {
    case 'b':
        return '\b';
    case 'f':
        return '\f';
    case 'n':
        return '\n';
    case 'r':
        return '\r';
    case 't':
        return '\t';
    case '\\':
    case '\'':
    case '"':
        return c;
    default:
        throw syntaxError(position, "unknown escape '\\{}' in a string", printable({&c, 1}));
    }
}

/// std::from_chars does not accept a leading plus sign.
std::string_view withoutPlus(std::string_view text) {
    return text.size() > 1 && text[0] == '+' && text[1] != '-' ? text.substr(1) : text;
}

} // namespace

std::string Token::shown() const {
    switch (kind) {
    case TokenKind::word:
        return fmt::format("'{}'", printable(text));
    case TokenKind::string:
        return fmt::format("\"{}\"", printable(text));
    case TokenKind::open:
        return "'['";
    case TokenKind::close:
        return "']'";
    default:
        return "the end of the file";
    }
}

char Tokenizer::advance() {
    const char c = text_[offset_++];
    if (c == '\n') {
        ++position_.line;
        position_.column = 1;
    } else {
        ++position_.column;
    }
    return c;
}

void Tokenizer::skipBlanks() {
    while (offset_ < text_.size()) {
        if (text_[offset_] == '#') {
            while (offset_ < text_.size() && text_[offset_] != '\n' && text_[offset_] != '\r') advance();
        } else if (isBlank(text_[offset_])) {
            advance();
        } else {
            return;
        }
    }
}

Token Tokenizer::scanString(Token token) {
    token.kind = TokenKind::string;
    const std::size_t start = offset_;
    std::string resolved;
    bool escaped = false;
    while (true) {
        if (offset_ == text_.size() || text_[offset_] == '\n')
            throw syntaxError(token.position, "this string has no closing quote in its line");
        const char c = advance();
        if (c == '"') break;
        if (c != '\\') {
            if (escaped) resolved += c;
            continue;
        }
        if (!escaped) resolved = text_.substr(start, offset_ - 1 - start);
        escaped = true;
        if (offset_ == text_.size()) throw syntaxError(token.position, "the file ends within this string");
        resolved += unescape(advance(), token.position);
    }
    token.text = escaped ? std::string_view(unescaped_.emplace_back(std::move(resolved)))
                         : text_.substr(start, offset_ - 1 - start);
    return token;
}

Token Tokenizer::scan() {
    skipBlanks();
    Token token{TokenKind::end, {}, position_};
    if (offset_ == text_.size()) return token;
    const std::size_t start = offset_;
    const char c = advance();
    if (c == '"') return scanString(token);
    if (c == '[' || c == ']') {
        token.kind = c == '[' ? TokenKind::open : TokenKind::close;
    } else {
        token.kind = TokenKind::word;
        while (offset_ < text_.size() && !endsWord(text_[offset_])) advance();
    }
    token.text = text_.substr(start, offset_ - start);
    return token;
}

Token Tokenizer::next() {
    if (!peeked_) return scan();
    const Token token = *peeked_;
    peeked_.reset();
    return token;
}

const Token& Tokenizer::peek() {
    if (!peeked_) peeked_ = scan();
    return *peeked_;
}

double numberOf(const Token& token) {
    const std::string_view text = withoutPlus(token.text);
    double value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (token.kind != TokenKind::word || end != text.data() + text.size() ||
        status == std::errc::invalid_argument)
        throw syntaxError(token.position, "expected a number, found {}", token.shown());
    // from_chars does not set the value on overflow or underflow; strtod distinguishes the two.
    if (status == std::errc::result_out_of_range) value = std::strtod(std::string(text).c_str(), nullptr);
    if (!(std::abs(value) <= std::numeric_limits<float>::max()))
        throw syntaxError(token.position, "{} is not a finite number in the range of a float", token.shown());
    return value;
}

int integerOf(const Token& token) {
    const std::string_view text = withoutPlus(token.text);
    int value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (token.kind != TokenKind::word || end != text.data() + text.size() ||
        status == std::errc::invalid_argument)
        throw syntaxError(token.position, "expected an integer, found {}", token.shown());
    if (status != std::errc())
        throw syntaxError(token.position, "{} is not in the range of a 32-bit integer", token.shown());
    return value;
}

std::string stringOf(const Token& token) {
    if (token.kind != TokenKind::string)
        throw syntaxError(token.position, "expected a string in quotes, found {}", token.shown());
    return std::string(token.text);
}

} // namespace slant
