// Splits pbrt scene text into tokens that know where they stand.
#pragma once
#include "scene/position.h"

#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace slant {

enum class TokenKind { word, string, open, close, end };

/// The `text` of a string has no quotes, and escapes are resolved. Valid as long as the Tokenizer and its
/// text.
struct Token {
    TokenKind kind = TokenKind::end;
    std::string_view text;
    Position position;

    /// Its name in messages.
    std::string shown() const;
};

/// Comments and white space are skipped. Throws SyntaxError for strings that do not end in their line.
class Tokenizer {
public:
    /// Both must outlive the tokenizer; `name` also every Position.
    Tokenizer(std::string_view text, const std::string* name) : text_(text), position_{name, 1, 1} {}

    Token next();
    const Token& peek();

private:
    Token scan();
    Token scanString(Token token);
    char advance();
    void skipBlanks();

    std::string_view text_;
    std::size_t offset_ = 0;
    Position position_;
    std::optional<Token> peeked_;
    std::deque<std::string> unescaped_; // strings with escapes, resolved; stable addresses
};

/// The token's value. Throws SyntaxError if it is not a finite number in float's range.
double numberOf(const Token& token);
/// The same for a 32-bit integer, without fraction or exponent.
int integerOf(const Token& token);
/// The same for a quoted string.
std::string stringOf(const Token& token);

} // namespace slant
