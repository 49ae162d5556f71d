#include "reconstruct/method.h"

#include "reconstruct/search.h"

#include <algorithm>
#include <array>

namespace slant {
namespace {

/// In the order of Method.
const std::array<MethodTraits, kMethodCount> kMethods = {{
    {"box", DenseSource::input},
    {"window", DenseSource::window},
    {"full", DenseSource::bins, {"reconstruct", reconstructNearest}},
    {"unfiltered", DenseSource::bins, {"reconstruct", reconstructNearest}, true},
    {"auto", DenseSource::bins, {"reconstruct", reconstructNearest}, true, true},
}};

const std::array<std::string, kMethodCount> kNames = [] {
    std::array<std::string, kMethodCount> names;
    std::ranges::transform(kMethods, names.begin(), &MethodTraits::name);
    return names;
}();

} // namespace

const MethodTraits& traitsOf(Method method) {
    return kMethods.at(std::size_t(method));
}

std::span<const std::string> methodNames() {
    return kNames;
}

const std::string& nameOf(Method method) {
    return traitsOf(method).name;
}

std::optional<Method> parseMethod(std::string_view name) {
    const auto found = std::ranges::find(kMethods, name, &MethodTraits::name);
    if (found == kMethods.end()) return {};
    return Method(found - kMethods.begin());
}

} // namespace slant
