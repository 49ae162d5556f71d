// Fields in which things move.
#include "image/metrics.h"
#include "reconstruct/cpu_reconstructor.h"
#include "support/intermediates.h"
#include "support/synthetic.h"

#include <chrono>
#include <gtest/gtest.h>

namespace slant {
namespace {

const Rect kFrame{0, 0, 96, 72};

Image reconstruct(const LightField& field, Method method, int outputs = 128, const LensView& view = {}) {
    ReconstructOptions options;
    options.method = method;
    options.outputsPerPixel = outputs;
    CpuReconstructor cpu;
    return test::run(cpu, field, options, view).image;
}

LightField moving(int spp, std::uint32_t seed, int overscan = 30) {
    return synthetic::sampleMoving(synthetic::movingDiscs(), kFrame, overscan, spp, seed);
}

TEST(MotionStability, isBetterThanBox) {
    const Image truth = reconstruct(moving(900, 77, 2), Method::box);
    for (const int spp : {1, 4, 16}) {
        const LightField field = moving(spp, 3);
        const Image box = reconstruct(field, Method::box);
        const auto start = std::chrono::steady_clock::now();
        const Image full = reconstruct(field, Method::full);
        const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        LightField still = field;
        still.motion.clear();
        const auto start2 = std::chrono::steady_clock::now();
        const Image frozen = reconstruct(still, Method::full);
        const double s2 = std::chrono::duration<double>(std::chrono::steady_clock::now() - start2).count();
        const auto start3 = std::chrono::steady_clock::now();
        const Image automatic = reconstruct(field, Method::automatic);
        const double s3 = std::chrono::duration<double>(std::chrono::steady_clock::now() - start3).count();
        const auto d = compare(automatic, truth);
        std::printf("auto %.5f gain %.2f %.2f s\n", d.relMse, compare(box, truth).relMse / d.relMse, s3);
        const auto a = compare(box, truth), b = compare(full, truth), c = compare(frozen, truth);
        std::printf("spp %d box %.5f full %.5f still %.5f gain %.2f; %.2f s, %.2f s\n", spp, a.relMse,
                    b.relMse, c.relMse, a.relMse / b.relMse, s, s2);
    }
}

} // namespace
} // namespace slant
