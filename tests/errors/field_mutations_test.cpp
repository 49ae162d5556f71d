// Random damage to valid light field files: the readers, and what comes after them, succeed or throw Error.
// What the fuzzers once found stays fixed.
#include "support/damage.h"
#include "support/field_samples.h"
#include "support/fuzz_targets.h"
#include "support/temp_dir.h"

#include <fmt/format.h>

namespace slant {
namespace {

/// A field small enough to go through reconstruction, as bytes of a fuzz target: plain, or with all planes.
std::string bytesOf(const std::string& extension, bool rich) {
    FieldFile file;
    file.field = synthetic::sample(synthetic::discsOverChecks(), {0, 0, 5, 4}, 2, 2, 3);
    file.field.slopeModel = {-8, 3};
    for (LightFieldSample& s : file.field.samples) s.slope = file.field.slopeModel(s.w);
    file.field.resize(file.field.samples.size(), {rich, rich, rich});
    for (glm::vec3& motion : file.field.motion) motion = {3, -2, 0.5f};
    file.details = {file.field.frame, PixelFilter(), 0.5f, 0, "", "by hand", 3};
    SilentMonitor monitor;
    const test::TempDir dir;
    const std::string path = dir.file("a" + extension);
    writeField(path, file.field, file.details, monitor);
    if (extension == ".exr") return test::readText(path);
    return test::readText(path + ".header") + '\0' + test::readText(path);
}

TEST(FieldMutations, neverDoWorseThanAnError) {
    for (const auto& [extension, target] :
         {std::pair(".exr", &test::fuzzDeepExr), {".bin", &test::fuzzTlfr}, {".txt", &test::fuzzTlfr}}) {
        SCOPED_TRACE(extension);
        for (const bool rich : {false, true}) {
            const auto [read, refused] = test::survive(target, bytesOf(extension, rich), 300);
            EXPECT_GT(read, 20); // the damage reaches more than the first check
            EXPECT_GT(refused, 50);
        }
    }
}

TEST(FuzzSeeds, neverDoWorseThanAnError) {
    std::size_t files = 0;
    for (const auto& [name, target] : {std::pair("scene", &test::fuzzScene),
                                       {"ply", &test::fuzzPly},
                                       {"picture", &test::fuzzPicture},
                                       {"lens", &test::fuzzLens},
                                       {"aperture", &test::fuzzAperture},
                                       {"spd", &test::fuzzSpd},
                                       {"deep_exr", &test::fuzzDeepExr},
                                       {"tlfr", &test::fuzzTlfr}})
        for (const auto& entry :
             std::filesystem::directory_iterator(std::string(SLANT_SOURCE_DIR "/tests/fuzz/seeds/") + name)) {
            SCOPED_TRACE(entry.path());
            EXPECT_NO_THROW(target(test::readText(entry.path().string())));
            ++files;
        }
    EXPECT_GE(files, 4u);
}

} // namespace
} // namespace slant
