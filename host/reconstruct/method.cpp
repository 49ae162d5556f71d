#include "reconstruct/method.h"

#include "base/error.h"

#include <algorithm>
#include <array>

namespace slant {
namespace {

const std::array<std::string, kMethodCount> kMethodNames = {"box", "window", "full", "auto"};

} // namespace

std::span<const std::string> methodNames() {
    return kMethodNames;
}

const std::string& nameOf(Method method) {
    return kMethodNames.at(std::size_t(method));
}

std::optional<Method> parseMethod(std::string_view name) {
    const auto found = std::find(kMethodNames.begin(), kMethodNames.end(), name);
    if (found == kMethodNames.end()) return {};
    return Method(found - kMethodNames.begin());
}

bool usesOutputs(Method method) {
    return method != Method::box;
}

const Aperture& apertureOf(const LightField& field, const ReconstructOptions& options) {
    return options.aperture ? *options.aperture : field.aperture;
}

std::uint64_t maxDenseSamples(const ReconstructOptions& options) {
    return options.memoryBytes / 2 / sizeof(vec4);
}

void checkFocus(const ReconstructOptions& options, float slopeShift) {
    const bool ownPixels = options.method == Method::box || options.method == Method::window;
    if (slopeShift != 0 && (ownPixels || !options.anyFocus))
        throw Error(ErrorCode::usage,
                    fmt::format("method {} {}", nameOf(options.method),
                                ownPixels ? "looks for samples in their own pixels, which another focus "
                                            "moves them out of; choose another"
                                          : "was prepared for the traced focus only"));
}

StageStats& ReconstructReport::stage(const char* name, const char* unit) {
    const auto found = std::find_if(stages.begin(), stages.end(),
                                    [&](const StageStats& stage) { return stage.name == name; });
    if (found != stages.end()) return *found;
    StageStats& stage = stages.emplace_back();
    stage.name = name;
    stage.unit = unit;
    return stage;
}

} // namespace slant
