// The program where what it stands on gives way: a driver that fails at any call, a full disc, a folder that
// is gone, little memory, signals, no Vulkan loader, odd environments. It ends with its documented status,
// one line, and no half file.
#include "image/exr.h"
#include "support/run_program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::ProgramResult;
using test::runWords;
using testing::HasSubstr;

class Faults : public testing::Test {
protected:
    Faults() {
        test::writeText(scene_, "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 17\n"
                                "Camera \"perspective\" \"float lensradius\" 0.1 \"float focaldistance\" 2\n"
                                "WorldBegin\nLightSource \"point\" \"point3 from\" [0 2 0]\n"
                                "Shape \"sphere\" \"float radius\" 0.5\nTranslate 0.4 0 3\n"
                                "Shape \"sphere\" \"float radius\" 0.7\n");
    }

    /// slant with settings of the environment, "NAME=VALUE".
    static ProgramResult slantWith(std::vector<std::string> settings, const std::vector<std::string>& words) {
        settings.insert(settings.begin(), "env");
        settings.push_back(SLANT_PROGRAM);
        settings.insert(settings.end(), words.begin(), words.end());
        return runWords(settings);
    }
    /// slant in a shell: after `before`, as "$@".
    static ProgramResult slantAfter(const std::string& before, const std::vector<std::string>& words) {
        std::vector<std::string> all{"sh", "-c", before, "sh", SLANT_PROGRAM};
        all.insert(all.end(), words.begin(), words.end());
        return runWords(all);
    }
    void expectFailure(const ProgramResult& run, int status, const std::string& when) const {
        EXPECT_EQ(run.status, status) << when << ": " << run.err;
        EXPECT_EQ(run.errorLines(), 1) << when << ": " << run.err;
        EXPECT_THAT(run.err, testing::StartsWith("slant: error: ")) << when;
        EXPECT_EQ(run.out, "") << when;
        EXPECT_EQ(dir_.entries(), 0u) << when;
    }
    std::vector<std::string> render(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"render", scene_, "--quiet", "--spp", "2", "--out-spp", "8", "-o",
                                   dir_.file("out.exr")});
        return more;
    }

    const test::TempDir inputs_, dir_;
    const std::string scene_ = inputs_.file("tiny.pbrt");
};

bool withoutVulkan() {
    const char* value = std::getenv("SLANT_TESTS_WITHOUT_VULKAN");
    return value && std::string_view(value) == "1";
}

/// Calls to the driver are walked to their end, by ever longer steps unless SLANT_EVERY_FAULT=1.
class DriverFaults : public Faults, public testing::WithParamInterface<const char*> {};

TEST_P(DriverFaults, endWithOneLineAndNoFile) {
    if (withoutVulkan()) GTEST_SKIP();
    const std::string kind = GetParam(), field = inputs_.file("field.exr");
    ASSERT_EQ(slantWith({}, {"sample", scene_, "--quiet", "--spp", "2", "-o", field}).status, 0);
    const char* every = std::getenv("SLANT_EVERY_FAULT");
    const int steps = every && *every == '1' ? 1 << 30 : 4;
    int survived = 0;
    for (const std::vector<std::string>& words :
         {render(),
          {"reconstruct", field, "--quiet", "--out-spp", "8", "-o", dir_.file("out.exr")},
          {"devices"}}) {
        const int before = survived;
        for (int call = 1;; call += 1 + call / steps) {
            ASSERT_LT(call, 100000);
            const ProgramResult run =
                slantWith({"VK_LAYER_PATH=" SLANT_FAULT_LAYER, "VK_INSTANCE_LAYERS=VK_LAYER_SLANT_fault",
                           "SLANT_VALIDATE=0", fmt::format("SLANT_FAULT={} {}", call, kind)},
                          words);
            if (run.status == 0) break;
            expectFailure(run, kind == "lost" ? 4 : 5, fmt::format("{}, call {} {}", words[0], call, kind));
            if (HasFailure()) return;
            ++survived;
        }
        EXPECT_GE(survived - before, words[0] != "devices" ? 10 : kind == "lost" ? 0 : 1) << words[0];
        std::filesystem::remove(dir_.file("out.exr"));
    }
    RecordProperty("survived", survived);
}

INSTANTIATE_TEST_SUITE_P(Kinds, DriverFaults, testing::Values("host", "device", "lost"),
                         [](const auto& kind) { return std::string(kind.param); });

TEST_F(Faults, filesThatGrowTooLarge) {
    for (const std::vector<std::string>& words :
         {render({"--device", "cpu", "--float"}),
          {"sample", scene_, "--quiet", "-o", dir_.file("field.exr")},
          {"reference", scene_, "--quiet", "--spp", "1", "--float", "-o", dir_.file("out.exr")}}) {
        const ProgramResult run = slantAfter("ulimit -f 1; exec \"$@\"", words);
        expectFailure(run, 5, words[0]);
        EXPECT_THAT(run.err, HasSubstr("File too large"));
    }
}

TEST_F(Faults, pipesThatNobodyReads) {
    const ProgramResult run = slantAfter("{ \"$@\"; echo $? >&2; } | exit 0", {"render", "--help"});
    EXPECT_THAT(run.err, testing::AnyOf("0\n", "slant: error: cannot write to standard output\n5\n"));
}

TEST_F(Faults, foldersThatGoMeanwhile) {
    std::filesystem::create_directory(dir_.file("gone"));
    const std::string script =
        "\"$@\" & for i in $(seq 3000); do grep -q 'SigCgt:.*[2367abef]$' /proc/$!/status "
        "&& break; sleep 0.01; done; sleep 0.3; rm -r '" +
        dir_.file("gone") + "'; wait $!";
    const ProgramResult run = slantAfter(
        script, {"reference", scene_, "--quiet", "--spp", "5000", "-o", dir_.file("gone/out.exr")});
    expectFailure(run, 5, "rm -r");
}

/// A kill leaves nothing under the output's name but what was there, or all of the new picture.
TEST_F(Faults, killedAtAnyMoment) {
    const std::string output = dir_.file("out.exr");
    int killed = 0;
    for (int hundredths = 0; hundredths < 60; hundredths += 3) {
        test::writeText(output, "an older picture");
        const std::string script = fmt::format("\"$@\" & sleep {}; kill -9 $!; wait $!", 0.01 * hundredths);
        killed += slantAfter(script, render({"--device", "cpu"})).status != 0;
        if (test::readText(output) != "an older picture") {
            EXPECT_EQ(readExr(output).image.width(), 24);
        }
    }
    EXPECT_GT(killed, 0);
}

TEST_F(Faults, littleMemory) {
    EXPECT_EQ(slantAfter("ulimit -v 1048576; exec \"$@\"", render({"--device", "cpu"})).status, 0);
    std::filesystem::remove(dir_.file("out.exr"));
    const std::vector<std::string> large = {"reference", scene_, "--quiet",           "--spp", "1", "--crop",
                                            "0,1,0,1",   "-o",   dir_.file("out.exr")};
    for (const int kilobytes : {60'000, 100'000, 150'000, 200'000, 300'000}) {
        const ProgramResult run = slantAfter(fmt::format("ulimit -v {}; exec \"$@\"", kilobytes), large);
        // 127: the loader of programs itself gave up.
        EXPECT_THAT(run.status, testing::AnyOf(0, 5, 127)) << kilobytes << run.err;
        if (run.status == 5) expectFailure(run, 5, "ulimit -v");
        std::filesystem::remove(dir_.file("out.exr"));
    }
}

TEST_F(Faults, noLoaderOfVulkan) {
    for (const char* name : {"libvulkan.so", "libvulkan.so.1"}) test::writeText(inputs_.file(name), "");
    const std::string setting = "LD_LIBRARY_PATH=" + inputs_.path().string();
    const ProgramResult run = slantWith({setting}, render());
    expectFailure(run, 4, "no loader");
    EXPECT_THAT(run.err, HasSubstr("no Vulkan loader"));
    EXPECT_EQ(slantWith({setting}, render({"--device", "cpu"})).status, 0);
}

TEST_F(Faults, oddEnvironments) {
    const std::vector<std::string> odd = {"HOME=/dev/null",      "XDG_CACHE_HOME=/dev/null",
                                          "TMPDIR=/nonexistent", "LANG=xx_YY",
                                          "LC_ALL=xx_YY",        "TERM=",
                                          "COLUMNS=-3",          "TZ=nowhere",
                                          "SLANT_VALIDATE="};
    EXPECT_EQ(slantWith(odd, render({"--device", "cpu"})).status, 0);
    if (withoutVulkan()) return;
    EXPECT_EQ(slantWith(odd, render()).status, 0);
    std::filesystem::remove(dir_.file("out.exr"));
    test::writeText(
        inputs_.file("driver.json"),
        R"({"file_format_version": "1.0.0", "ICD": {"library_path": "./none.so", "api_version": "1.2.0"}})");
    const std::string bad = inputs_.file("driver.json");
    expectFailure(slantWith({"VK_DRIVER_FILES=" + bad, "VK_ICD_FILENAMES=" + bad}, render()), 4,
                  "bad driver");
}

} // namespace
} // namespace slant
