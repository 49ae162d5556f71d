// Fields of compound lenses: the compute path against the CPU's, to the bit, and the layer map against the
// search of the bins.
#include "compute/compute_reconstructor.h"
#include "reconstruct/cpu_reconstructor.h"
#include "scene/read_scene.h"
#include "support/intermediates.h"
#include "support/vulkan_fixture.h"
#include "trace/sample_pass.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slant {
namespace {

const std::string kDoubleGauss =
    "dgauss-50mm.dat\" \"float aperturediameter\" 17.1 \"float focusdistance\" 0.6";
const std::string kFisheye = "fisheye-10mm.dat\" \"float aperturediameter\" 6 \"float focusdistance\" 0.6";

/// Emitting walls, near, in focus and far, that overlap and reach into the corners.
LightField fieldThrough(const std::string& lens, int spp) {
    SilentMonitor monitor;
    const auto wall = [](const char* radiance, const char* corners) {
        return std::string("AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" ") + radiance +
               " \"bool twosided\" true Shape \"bilinearmesh\" \"point3 P\" " + corners + " AttributeEnd\n";
    };
    const Scene scene = readSceneText(
        "Film \"rgb\" \"integer xresolution\" 61 \"integer yresolution\" 37 \"float diagonal\" 24\n"
        "Camera \"realistic\" \"string lensfile\" \"" SLANT_SOURCE_DIR "/scenes/lenses/" +
            lens + "\nWorldBegin\n" + wall("[1 2 3]", "[-9 -9 2  9 -9 2.5  -9 9 1.5  9 9 2]") +
            wall("[3 1 1]", "[-0.1 -0.4 0.6  0.05 -0.4 0.62  -0.1 0.1 0.6  0.05 0.1 0.6]") +
            wall("[1 4 1]", "[-0.4 0.02 0.4  0.2 0.02 0.4  -0.4 0.06 0.4  0.2 0.06 0.4]"),
        "s.pbrt", monitor);
    const Tracer tracer(scene, monitor);
    LightField field = traceLightField(tracer, scene, {.samplesPerPixel = spp}, monitor);
    EXPECT_EQ(sanitize(field).total(), 0u);
    EXPECT_FALSE(field.lensMap.empty());
    return field;
}

ReconstructOptions optionsOf(Method method) {
    ReconstructOptions options;
    options.method = method;
    options.outputsPerPixel = 64;
    return options;
}

class LensParity : public test::VulkanTest {
protected:
    static test::Reconstruction runBoth(const LightField& field, const ReconstructOptions& options) {
        CpuReconstructor cpu;
        ComputeReconstructor compute(device());
        const test::Reconstruction expected = test::run(cpu, field, options);
        test::Reconstruction got = test::run(compute, field, options);
        test::expectEqual(expected.intermediates, got.intermediates);
        EXPECT_EQ(expected.report.fromMap, got.report.fromMap);
        return got;
    }
};

/// Through the disc of the pupil and through a shape at the stop, distorted little and much.
TEST_F(LensParity, layerMapsServeAsTheSearchDoes) {
    for (const std::string& lens : {kDoubleGauss, kDoubleGauss + " \"string aperture\" \"star\"", kFisheye})
        for (const int spp : {1, 4, 8}) {
            const LightField field = fieldThrough(lens, spp);
            const test::Reconstruction looked = runBoth(field, optionsOf(Method::automatic));
            const test::Reconstruction searched = runBoth(field, optionsOf(Method::full));
            EXPECT_GT(looked.report.fromMap, looked.report.outputs / 2) << lens << ", " << spp;
            double difference = 0, sum = 0;
            for (std::size_t i = 0; i < looked.image.pixels.size(); ++i) {
                difference += std::abs(double(looked.image.pixels[i]) - double(searched.image.pixels[i]));
                sum += double(searched.image.pixels[i]);
            }
            // 0.018, noise of the outputs.
            EXPECT_LT(difference / sum, 0.025) << lens << ", " << spp;
        }
}

TEST_F(LensParity, samplesWithoutAPlaceAreLeftOut) {
    LightField field = fieldThrough(kDoubleGauss, 4);
    for (std::size_t i = 0; i < field.samples.size(); i += 5)
        (i % 2 ? field.samples[i].u : field.samples[i].y) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_GT(sanitize(field).outsideLens, 0u);
    EXPECT_GT(runBoth(field, optionsOf(Method::full)).report.outputs, 0u);
}

TEST_F(LensParity, layerMapsDoNotDependOnMemory) {
    const LightField field = fieldThrough(kFisheye, 8);
    ReconstructOptions options = optionsOf(Method::automatic);
    const test::Reconstruction plenty = runBoth(field, options);
    options.memoryBytes = 4'000'000;
    const test::Reconstruction tight = runBoth(field, options);
    EXPECT_GT(std::ranges::count(tight.intermediates.names, "layer_map"), 1);
    EXPECT_TRUE(plenty.intermediates.contents.back() == tight.intermediates.contents.back());
}

} // namespace
} // namespace slant
