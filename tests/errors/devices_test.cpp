// slant devices, on a machine with lavapipe, and as if it had no driver.
#include "support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace slant {
namespace {

using test::ProgramResult;
using test::runSlant;
using testing::HasSubstr;

bool withoutVulkan() {
    const char* value = std::getenv("SLANT_TESTS_WITHOUT_VULKAN");
    return value && std::string_view(value) == "1";
}

TEST(Devices, listMarksExactlyOne) {
    if (withoutVulkan()) GTEST_SKIP();
    const ProgramResult list = runSlant({"devices"});
    EXPECT_EQ(list.status, 0) << list.err;
    EXPECT_THAT(list.out, testing::StartsWith("* "));
    EXPECT_EQ(list.err, "");

    const auto json = nlohmann::json::parse(runSlant({"devices", "--json"}).out);
    int marked = 0;
    for (const auto& device : json) {
        marked += int(device["auto"].get<bool>());
        EXPECT_TRUE(device["unsuitable"] != "" || device["limits"]["texelBufferElements"] >= 65536);
        EXPECT_THAT(list.out, HasSubstr(device["name"].get<std::string>()));
    }
    EXPECT_EQ(marked, 1);
}

TEST(Devices, noDriverGivesOneLineAndStatusFour) {
    const ProgramResult result =
        test::runWords({"env", "VK_ICD_FILENAMES=/nonexistent.json", "VK_DRIVER_FILES=/nonexistent.json",
                        SLANT_PROGRAM, "devices"});
    EXPECT_EQ(result.status, 4);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.errorLines(), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("no Vulkan"));
}

} // namespace
} // namespace slant
