#include "scene/spelling.h"
#include "scene/tokenizer.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

const std::string kName = "t.pbrt";

double number(const std::string& text) {
    Tokenizer tokens(text, &kName);
    return numberOf(tokens.next());
}

int integer(const std::string& text) {
    Tokenizer tokens(text, &kName);
    return integerOf(tokens.next());
}

/// The message that `read(text)` ends with.
template <typename Read>
std::string messageOf(Read read, const std::string& text) {
    try {
        read(text);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Tokenizer, knowsWhereTokensStand) {
    Tokenizer tokens("Shape \"sphere\" # rest\n\t[1 -2.5e3]\r\n\"a\\\"b\\n\"x", &kName);
    const struct {
        TokenKind kind;
        std::string_view text;
        int line, column;
    } expected[] = {
        {TokenKind::word, "Shape", 1, 1},    {TokenKind::string, "sphere", 1, 7},
        {TokenKind::open, "[", 2, 2},        {TokenKind::word, "1", 2, 3},
        {TokenKind::word, "-2.5e3", 2, 5},   {TokenKind::close, "]", 2, 11},
        {TokenKind::string, "a\"b\n", 3, 1}, {TokenKind::word, "x", 3, 9},
        {TokenKind::end, "", 3, 10},         {TokenKind::end, "", 3, 10},
    };
    for (const auto& e : expected) {
        EXPECT_EQ(tokens.peek().kind, e.kind);
        const Token token = tokens.next();
        EXPECT_EQ(token.kind, e.kind);
        EXPECT_EQ(token.text, e.text);
        EXPECT_EQ(token.position.line, e.line) << e.text;
        EXPECT_EQ(token.position.column, e.column) << e.text;
        EXPECT_EQ(FileLocation(token.position).file, kName);
    }
}

TEST(Tokenizer, refusesStringsThatDoNotEnd) {
    EXPECT_EQ(messageOf(number, "  \"abc"), "t.pbrt:1:3: this string has no closing quote in its line");
    EXPECT_EQ(messageOf(number, "\"abc\nd\""), "t.pbrt:1:1: this string has no closing quote in its line");
    EXPECT_EQ(messageOf(number, "\"abc\\"), "t.pbrt:1:1: the file ends within this string");
    EXPECT_EQ(messageOf(number, "\"a\\q\""), "t.pbrt:1:1: unknown escape '\\q' in a string");
}

TEST(Tokenizer, readsNumbers) {
    EXPECT_EQ(number("0"), 0);
    EXPECT_EQ(number("+.5"), 0.5);
    EXPECT_EQ(number("-12.25E-2"), -0.1225);
    EXPECT_EQ(number("5."), 5);
    EXPECT_EQ(number("1e-400"), 0);
    EXPECT_EQ(number("123456789"), 123456789);
    EXPECT_EQ(integer("+7"), 7);
    EXPECT_EQ(integer("-2147483648"), -2147483648);
    for (const char* text : {"nan", "inf", "1e39", "-1e999", "Infinity"})
        EXPECT_EQ(messageOf(number, text),
                  fmt::format("t.pbrt:1:1: '{}' is not a finite number in the range of a float", text));
    for (const char* text : {"1.2.3", "x", "+-1", "1e", "0x10"})
        EXPECT_EQ(messageOf(number, text), fmt::format("t.pbrt:1:1: expected a number, found '{}'", text));
    EXPECT_EQ(messageOf(number, "\"1\""), "t.pbrt:1:1: expected a number, found \"1\"");
    EXPECT_EQ(messageOf(number, ""), "t.pbrt:1:1: expected a number, found the end of the file");
    EXPECT_EQ(messageOf(integer, "1.5"), "t.pbrt:1:1: expected an integer, found '1.5'");
    EXPECT_EQ(messageOf(integer, "2147483648"),
              "t.pbrt:1:1: '2147483648' is not in the range of a 32-bit integer");
}

TEST(Spelling, showsWhatCannotBePrinted) {
    EXPECT_EQ(printable("a\x01\xff z"), "a\\x01\\xff z");
    EXPECT_EQ(printable(std::string(100, 'x')), std::string(40, 'x') + "...");
}

} // namespace
} // namespace slant
