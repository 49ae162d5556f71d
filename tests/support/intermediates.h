// All intermediates of a reconstruction, kept, and the comparison of two such runs.
#pragma once
#include "reconstruct/prepared_field.h"

#include <algorithm>
#include <bit>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace slant::test {

struct Intermediates : IntermediateObserver {
    void receive(const std::string& name, std::span<const uint> words) override {
        names.push_back(name);
        contents.emplace_back(words.begin(), words.end());
    }
    std::vector<std::string> names;
    std::vector<std::vector<uint>> contents;
};

struct Reconstruction {
    Intermediates intermediates;
    ReconstructReport report;
    Image image;
};

inline Reconstruction run(Reconstructor& reconstructor, const LightField& field,
                          const ReconstructOptions& options, const LensView& view = {},
                          ValuePlane plane = ValuePlane::radiance) {
    Reconstruction run;
    SilentMonitor monitor;
    run.image =
        reconstructor.reconstruct(field, options, monitor, run.report, &run.intermediates, view, plane);
    return run;
}

/// Every word of every intermediate.
inline void expectEqual(const Intermediates& expected, const Intermediates& got) {
    ASSERT_EQ(expected.names, got.names);
    for (std::size_t i = 0; i < expected.names.size(); ++i) {
        const std::vector<uint>&a = expected.contents[i], &b = got.contents[i];
        ASSERT_EQ(a.size(), b.size()) << expected.names[i];
        const std::size_t word = std::size_t(std::mismatch(a.begin(), a.end(), b.begin()).first - a.begin());
        ASSERT_EQ(word, a.size()) << "intermediate " << i << " '" << expected.names[i] << "': expected "
                                  << std::bit_cast<float>(a[word]) << ", got "
                                  << std::bit_cast<float>(b[word]);
    }
}

} // namespace slant::test
