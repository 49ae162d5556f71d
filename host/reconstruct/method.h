// The methods of reconstruction, and how they differ.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace slant {

enum class Method {
    box,        ///< the pixel filter over the input samples: no reconstruction
    window,     ///< reprojection within a fixed window of pixels: where Slant came from, for comparison
    full,       ///< reprojection, apparent surfaces and visibility for every output (Lehtinen et al. 2011)
    unfiltered, ///< outputs of blurred surfaces from a layer map, the others as `full`
    automatic,  ///< "auto": the same, with the noise of shading filtered
};
inline constexpr std::size_t kMethodCount = 5;

/// Where the dense samples of a method come from.
enum class DenseSource {
    input,  ///< they are the input samples
    window, ///< outputs, each from the samples of a window of pixels
    bins,   ///< outputs, each from the samples that the bins hold around it
};

struct SearchContext;
struct Output;
struct Reconstructed;

/// How methods that search the bins do so at first; the outputs that this leaves go to the visibility kernel
/// (search.h).
struct SearchKernel {
    const char* pass = nullptr; ///< the shader
    Reconstructed (*onCpu)(const SearchContext& context, const Output& output) = nullptr;
};

/// One row of the table of methods: all that the rest of the program needs to know of a method.
struct MethodTraits {
    std::string name; ///< what users call it
    DenseSource source;
    SearchKernel search = {};    ///< of methods that search the bins
    bool usesLayerMap = false;   ///< outputs come from the layer map where it serves
    bool filtersShading = false; ///< where samples have the parts of their radiance

    /// Whether it makes outputs, so that their number and the lens matter.
    bool makesOutputs() const { return source != DenseSource::input; }
    /// Whether it can show another focus. Methods that look for samples in their own pixels cannot, since
    /// another focus moves samples out of their pixels.
    bool refocuses() const { return source == DenseSource::bins; }
};

const MethodTraits& traitsOf(Method method);

/// In the order of Method.
std::span<const std::string> methodNames();
const std::string& nameOf(Method method);
std::optional<Method> parseMethod(std::string_view name);

} // namespace slant
