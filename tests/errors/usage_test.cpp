#include "support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::ProgramResult;
using test::runSlant;
using testing::HasSubstr;

TEST(Usage, helpAndVersionGoToStdout) {
    const ProgramResult help = runSlant({"--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.out, HasSubstr("Usage: slant"));
    EXPECT_EQ(help.err, "");
    const ProgramResult version = runSlant({"--version"});
    EXPECT_EQ(version.status, 0);
    EXPECT_THAT(version.out,
                testing::MatchesRegex("slant [0-9]+\\.[0-9]+\\.[0-9]+( \\([0-9a-f]+(-dirty)?\\))?\n"));
}

TEST(Usage, wrongWordsGiveOneLineAndStatusTwo) {
    const std::vector<std::vector<std::string>> wrong = {{},   {"banana"}, {"--banana"},
                                                         {""}, {"-x"},     {"a\nb"}};
    for (const auto& words : wrong) {
        const ProgramResult result = runSlant(words);
        EXPECT_EQ(result.status, 2) << testing::PrintToString(words);
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_THAT(result.err, testing::StartsWith("slant: error: "));
        EXPECT_THAT(result.err, HasSubstr("--help")) << result.err;
        EXPECT_EQ(result.out, "");
    }
    EXPECT_THAT(runSlant({"--versoin"}).err, HasSubstr("did you mean '--version'?"));
}

TEST(Usage, fullStandardOutputIsAnError) {
    const ProgramResult result =
        test::runWords({"sh", "-c", "exec " + test::shellQuote(SLANT_PROGRAM) + " --help >/dev/full"});
    EXPECT_EQ(result.status, 5);
    EXPECT_EQ(result.errorLines(), 1) << result.err;
}

} // namespace
} // namespace slant
