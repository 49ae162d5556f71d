// Expectations on slant::Error.
#pragma once
#include "base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

namespace slant::test {

/// `action` throws an Error of that code whose message is one line and holds `part`.
template <typename Action>
void expectError(ErrorCode code, const std::string& part, const Action& action) {
    try {
        action();
        ADD_FAILURE() << "no error; expected one with '" << part << "'";
    } catch (const Error& error) {
        EXPECT_EQ(int(error.code()), int(code)) << error.what();
        EXPECT_THAT(error.what(), testing::HasSubstr(part));
        EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
    }
}

} // namespace slant::test
