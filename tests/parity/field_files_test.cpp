// From scene to picture through a file is the same as without one, to the bit, in every format and on every
// device.
#include "image/exr.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

class ThroughFiles : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        const char* value = std::getenv("SLANT_TESTS_WITHOUT_VULKAN");
        if (value && std::string_view(value) == "1" && GetParam() != std::string("cpu"))
            GTEST_SKIP() << "SLANT_TESTS_WITHOUT_VULKAN";
    }
    /// Sampled and reconstructed through each of `files`, a scene is as rendered, which is returned. TLFR
    /// holds no parts of radiance, so shading is filtered only where `sampling` asks for them.
    Image renderedThrough(const std::vector<std::string>& files, const std::string& scene,
                          const std::vector<std::string>& tracing,
                          const std::vector<std::string>& sampling = {}) const {
        const std::string method = sampling.empty() ? "unfiltered" : "auto";
        const std::vector<std::string> picturing = {"--out-spp", "16",       "--float", "--method",
                                                    method,      "--device", GetParam()};
        std::vector<std::string> both = tracing;
        both.insert(both.end(), picturing.begin(), picturing.end());
        run({"render", scene, "-o", dir_.file("render.exr"), "--quiet"}, both);
        const Image expected = picture("render.exr");
        for (const std::string& field : files) {
            std::vector<std::string> sampled = tracing;
            sampled.insert(sampled.end(), sampling.begin(), sampling.end());
            run({"sample", scene, "-o", dir_.file(field), "--quiet"}, sampled);
            run({"reconstruct", dir_.file(field), "-o", dir_.file("out.exr"), "--quiet"}, picturing);
            const Image got = picture("out.exr");
            EXPECT_EQ(got.dataWindow, expected.dataWindow);
            EXPECT_EQ(got.displayWindow, expected.displayWindow);
            EXPECT_TRUE(got.pixels == expected.pixels) << field;
        }
        return expected;
    }
    void run(std::vector<std::string> words, const std::vector<std::string>& more) const {
        words.insert(words.end(), more.begin(), more.end());
        const test::ProgramResult result = test::runSlant(words);
        EXPECT_EQ(result.status, 0) << testing::PrintToString(words) << result.err;
    }
    Image picture(const std::string& name) const { return readExr(dir_.file(name)).image; }

    test::TempDir dir_;
};

TEST_P(ThroughFiles, sampleAndReconstructIsRender) {
    const Image picture =
        renderedThrough({"field.exr", "field.bin", "field.txt"}, SLANT_SOURCE_DIR "/scenes/row.pbrt",
                        {"--crop", "201,262,101,148", "--spp", "3", "--seed", "5"});
    EXPECT_EQ(picture.width(), 61);
}

TEST_P(ThroughFiles, shadingIsFilteredAsInRender) {
    const std::vector<std::string> tracing = {"--crop", "201,262,101,148", "--spp", "3", "--seed", "5"};
    const std::string row = SLANT_SOURCE_DIR "/scenes/row.pbrt";
    const Image filtered = renderedThrough({"field.exr"}, row, tracing, {"--shading"});
    EXPECT_FALSE(filtered.pixels == renderedThrough({"field.exr"}, row, tracing).pixels);
}

TEST_P(ThroughFiles, sampleAndReconstructIsRenderThroughALensToo) {
    renderedThrough({"field.exr", "field.txt"}, SLANT_SOURCE_DIR "/scenes/row-fisheye.pbrt",
                    {"--crop", "440,479,231,260", "--spp", "3"});
}

TEST_P(ThroughFiles, shapesAtTheStopOfALensTravelAlong) {
    const std::string scene = dir_.file("scene.pbrt");
    std::vector<Image> pictures;
    for (const std::string aperture : {"star", "gaussian"}) {
        test::writeText(
            scene,
            "Film \"rgb\" \"integer xresolution\" 48 \"integer yresolution\" 27 \"float diagonal\" 36\n"
            "\"float iso\" 1000 Sampler \"independent\" \"integer pixelsamples\" 3\n"
            "Camera \"realistic\" \"string lensfile\" \"" SLANT_SOURCE_DIR
            "/scenes/lenses/dgauss-50mm.dat\" \"float aperturediameter\" 17.1\n"
            "\"float focusdistance\" 0.6 \"string aperture\" \"" +
                aperture +
                "\"\nWorldBegin\n"
                "LightSource \"infinite\" \"rgb L\" [0.1 0.2 0.4]\nTranslate -0.1 0.05 1.2\n"
                "AreaLightSource \"diffuse\" Shape \"sphere\" \"float radius\" 0.03\n");
        pictures.push_back(renderedThrough({"field.bin"}, scene, {}));
        run({"render", scene, "-o", dir_.file("cpu.exr"), "--quiet", "--out-spp", "16", "--float", "--method",
             "unfiltered", "--device", "cpu"},
            {});
        EXPECT_TRUE(picture("cpu.exr").pixels == pictures.back().pixels) << aperture;
    }
    EXPECT_FALSE(pictures[0].pixels == pictures[1].pixels);
}

TEST_P(ThroughFiles, aperturesTravelAlong) {
    Image dots({0, 0, 5, 5}, {"Y"});
    for (std::size_t i = 0; i < dots.pixels.size(); i += 2) dots.pixels[i] = float(i);
    writeExr(dir_.file("dots.exr"), dots);
    const std::string scene = dir_.file("scene.pbrt");
    std::vector<Image> pictures;
    for (const std::string aperture : {"disc", "star", "dots.exr"}) {
        test::writeText(scene, "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 20\n"
                               "Sampler \"independent\" \"integer pixelsamples\" 3\n"
                               "Camera \"perspective\" \"float lensradius\" 0.6 \"float focaldistance\" 2\n"
                               "\"string aperture\" \"" +
                                   aperture +
                                   "\"\nWorldBegin\n"
                                   "LightSource \"infinite\" \"rgb L\" [0.1 0.2 0.4]\nTranslate 0 0 4\n"
                                   "AreaLightSource \"diffuse\" Shape \"sphere\" \"float radius\" 0.4\n");
        const std::vector<std::string> picturing = {"--out-spp", "32",         "--float",  "--quiet",
                                                    "--method",  "unfiltered", "--device", GetParam()};
        run({"render", scene, "-o", dir_.file("render.exr")}, picturing);
        pictures.push_back(picture("render.exr"));
        for (const std::string field : {"field.exr", "field.bin"}) {
            run({"sample", scene, "-o", dir_.file(field), "--quiet"}, {});
            run({"reconstruct", dir_.file(field), "-o", dir_.file("out.exr")}, picturing);
            EXPECT_TRUE(picture("out.exr").pixels == pictures.back().pixels) << field << ' ' << aperture;
        }
    }
    EXPECT_FALSE(pictures[0].pixels == pictures[1].pixels);
    EXPECT_FALSE(pictures[1].pixels == pictures[2].pixels);
}

TEST_P(ThroughFiles, everyFormatRefocusesToTheSameBits) {
    const std::string scene = SLANT_SOURCE_DIR "/scenes/spheres.pbrt";
    const std::vector<std::string> picturing = {"--out-spp", "8",       "--method", "full",
                                                "--float",   "--quiet", "--device", GetParam()};
    std::vector<Image> last;
    for (const std::string field : {"field.exr", "field.bin"}) {
        run({"sample", scene, "-o", dir_.file(field)},
            {"--crop", "201,242,101,128", "--spp", "2", "--quiet"});
        run({"reconstruct", dir_.file(field), "-o", dir_.file("pull.exr"), "--focus-from", "7", "--focus-to",
             "20", "--frames", "3", "--stats", dir_.file("pull.json")},
            picturing);
        run({"reconstruct", dir_.file(field), "-o", dir_.file("one.exr"), "--focus-distance", "20"},
            picturing);
        run({"reconstruct", dir_.file(field), "-o", dir_.file("narrow.exr"), "--aperture-scale", "0.5"},
            picturing);
        EXPECT_TRUE(picture("one.exr").pixels == picture("pull-0003.exr").pixels);
        EXPECT_FALSE(picture("one.exr").pixels == picture("pull-0002.exr").pixels);
        EXPECT_FALSE(picture("one.exr").pixels == picture("narrow.exr").pixels);
        last.push_back(picture("one.exr"));
    }
    EXPECT_TRUE(last[0].pixels == last[1].pixels);
    EXPECT_EQ(readExr(dir_.file("pull-0001.exr")).metadata.at("slant:focusDistance"),
              (decltype(Metadata().begin()->second)(7.f)));
    EXPECT_NE(test::readText(dir_.file("pull.json")).find("\"frames\": 3"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Devices, ThroughFiles, testing::Values("cpu", "auto"),
                         [](const auto& device) { return std::string(device.param); });

} // namespace
} // namespace slant
