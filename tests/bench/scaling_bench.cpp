// How the time of each stage of the reconstruction grows with samples, outputs, pixels and blur: exponents of
// power laws through medians, on the device that the program would choose. Discs at many depths before a
// textured plane.
#include "compute/compute_reconstructor.h"
#include "compute/device.h"
#include "support/synthetic.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <map>
#include <string>

namespace slant {
namespace {

constexpr int kRuns = 3;

struct Setting {
    int samples = 8, outputs = 64, width = 320;
    float slopePx = 8; ///< of the largest blur, to either side of the focus
};

LightField makeField(const Setting& setting) {
    const glm::vec2 size(float(setting.width), float(setting.width) * 0.5625f);
    std::vector<synthetic::Layer> layers;
    synthetic::Random random(7);
    constexpr int discs = 40;
    for (int i = 0; i < discs; ++i) {
        const glm::vec2 centre(random.uniform() * size.x, random.uniform() * size.y);
        const float radius = (0.02f + 0.06f * random.uniform()) * size.x, tint = random.uniform();
        layers.push_back({setting.slopePx * (2 * (float(i) + 0.5f) / discs - 1),
                          [=](glm::vec2 p) { return glm::distance(p, centre) < radius; },
                          [=](glm::vec2) { return glm::vec3(tint, 1 - tint, 0.5f); }});
    }
    layers.push_back({setting.slopePx, [](glm::vec2) { return true; },
                      [](glm::vec2 p) { return glm::vec3(0.5f + 0.4f * std::sin(p.x * 0.3f)); }});
    const int overscan = int(std::ceil(setting.slopePx)) + 8;
    return synthetic::sample(layers, {0, 0, int(size.x), int(size.y)}, overscan, setting.samples, 1);
}

/// Median seconds of each stage.
std::map<std::string, double> measure(ComputeReconstructor& reconstructor, Method method,
                                      const Setting& setting) {
    const LightField field = makeField(setting);
    ReconstructOptions options;
    options.method = method;
    options.outputsPerPixel = setting.outputs;
    std::map<std::string, std::vector<double>> runs;
    for (int run = 0; run <= kRuns; ++run) {
        SilentMonitor monitor;
        ReconstructReport report;
        reconstructor.reconstruct(field, options, monitor, report, nullptr);
        if (run == 0) continue; // compiles the shaders
        for (const StageStats& stage : report.stages)
            if (!stage.name.starts_with("pass ")) runs[stage.name].push_back(stage.seconds);
    }
    std::map<std::string, double> medians;
    for (auto& [stage, seconds] : runs) {
        std::nth_element(seconds.begin(), seconds.begin() + kRuns / 2, seconds.end());
        medians[stage] = seconds[kRuns / 2];
    }
    return medians;
}

struct Growth {
    std::string of;
    std::vector<std::pair<double, Setting>> settings; ///< the quantity, and where it has that value
};

std::vector<Growth> growths() {
    std::vector<Growth> all{{"samples", {}}, {"outputs", {}}, {"pixels", {}}, {"blur", {}}};
    for (const int samples : {4, 8, 16, 32})
        all[0].settings.push_back({double(samples), {.samples = samples}});
    for (const int outputs : {32, 64, 128, 256})
        all[1].settings.push_back({double(outputs), {.outputs = outputs}});
    for (const int width : {160, 240, 320, 480})
        all[2].settings.push_back({double(width * width), {.width = width}});
    for (const float slope : {4.f, 8.f, 16.f, 32.f}) all[3].settings.push_back({slope, {.slopePx = slope}});
    return all;
}

/// The exponent of the power law through (x, y), by least squares of logarithms.
double exponent(const std::vector<std::pair<double, double>>& points) {
    double x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& [a, b] : points) {
        x += std::log(a), y += std::log(b);
        xx += std::log(a) * std::log(a), xy += std::log(a) * std::log(b);
    }
    const double n = double(points.size());
    return (n * xy - x * y) / (n * xx - x * x);
}

} // namespace
} // namespace slant

int main() {
    using namespace slant;
    Device device(DeviceOptions{});
    ComputeReconstructor reconstructor(device);
    fmt::print("{}; exponents of seconds, medians of {}\n", device.info().name, kRuns);
    for (const Method method : {Method::automatic, Method::full})
        for (const Growth& growth : growths()) {
            std::map<std::string, std::vector<std::pair<double, double>>> points;
            for (const auto& [value, setting] : growth.settings)
                for (const auto& [stage, seconds] : measure(reconstructor, method, setting))
                    points[stage].push_back({value, seconds});
            fmt::print("{:5} {:8}", nameOf(method), growth.of);
            for (const auto& [stage, curve] : points)
                fmt::print("  {} {:.2f} ({:.3f} to {:.3f} s)", stage, exponent(curve), curve.front().second,
                           curve.back().second);
            fmt::print("\n");
        }
}
