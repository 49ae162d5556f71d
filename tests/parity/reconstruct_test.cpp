// The compute path against the CPU path, stage by stage, to the bit.
#include "compute/compute_reconstructor.h"
#include "reconstruct/cpu_reconstructor.h"
#include "support/synthetic.h"
#include "support/vulkan_fixture.h"

#include <cstring>

namespace slant {
namespace {

struct Stages : StageObserver {
    void stage(const std::string& name, std::span<const uint> words) override {
        names.push_back(name);
        contents.emplace_back(words.begin(), words.end());
    }
    std::vector<std::string> names;
    std::vector<std::vector<uint>> contents;
};

class ReconstructParity : public test::VulkanTest {
protected:
    static Stages run(Reconstructor& reconstructor, const LightField& field,
                      const ReconstructOptions& options) {
        Stages stages;
        SilentMonitor monitor;
        ReconstructReport report;
        const Image image = reconstructor.reconstruct(field, options, monitor, report, &stages);
        EXPECT_EQ(report.emptyPixels, 0u);
        return stages;
    }

    static void expectEqual(const Stages& expected, const Stages& got) {
        ASSERT_EQ(expected.names, got.names);
        for (std::size_t i = 0; i < expected.names.size(); ++i) {
            ASSERT_EQ(expected.contents[i].size(), got.contents[i].size()) << expected.names[i];
            for (std::size_t word = 0; word < expected.contents[i].size(); ++word)
                ASSERT_EQ(expected.contents[i][word], got.contents[i][word])
                    << "stage " << i << " '" << expected.names[i] << "', word " << word << ": expected "
                    << std::bit_cast<float>(expected.contents[i][word]) << ", got "
                    << std::bit_cast<float>(got.contents[i][word]);
        }
    }
};

TEST_F(ReconstructParity, everyStageAtOddSizes) {
    for (const Rect frame : {Rect{0, 0, 61, 43}, Rect{-7, 3, 30, 36}})
        for (const int spp : {1, 3, 8}) {
            LightField field = synthetic::sample(synthetic::discsOverChecks(), frame, 15, spp, 7);
            EXPECT_EQ(sanitize(field).total(), 0u);
            for (const Method method : {Method::box, Method::full}) {
                ReconstructOptions options;
                options.method = method;
                options.outputsPerPixel = 16;
                CpuReconstructor cpu;
                ComputeReconstructor compute(device());
                const Stages expected = run(cpu, field, options);
                expectEqual(expected, run(compute, field, options));
                expectEqual(expected, run(compute, field, options));
            }
        }
}

} // namespace
} // namespace slant
