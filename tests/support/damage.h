// Random damage to valid files.
#pragma once
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <utility>

namespace slant::test {

/// A few bytes flipped, replaced, inserted, removed or doubled, perhaps the end cut off.
inline std::string damaged(std::string bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return std::size_t(random()) % n; };
    for (std::size_t edits = 1 + below(4); edits > 0 && !bytes.empty(); --edits) {
        const std::size_t place = below(bytes.size()), length = std::min(1 + below(12), bytes.size() - place);
        constexpr char kTelling[] = "\"[]#-.e9 \n\0\xff";
        switch (below(6)) {
        case 0:
            bytes[place] = char(bytes[place] ^ (1 << below(8)));
            break;
        case 1:
            bytes[place] = kTelling[below(sizeof kTelling - 1)];
            break;
        case 2:
            bytes.insert(place, 1, kTelling[below(sizeof kTelling - 1)]);
            break;
        case 3:
            bytes.erase(place, length);
            break;
        case 4:
            bytes.insert(place, bytes.substr(below(bytes.size()), length));
            break;
        default:
            if (below(4) == 0) bytes.resize(place);
        }
    }
    return bytes;
}

/// Counts of variants that were read and refused.
template <typename Target>
std::pair<int, int> survive(Target target, const std::string& valid, int variants) {
    EXPECT_TRUE(target(valid));
    std::pair<int, int> counts{0, 0};
    for (int seed = 0; seed < variants; ++seed) {
        std::mt19937 random{unsigned(seed)};
        SCOPED_TRACE(seed);
        EXPECT_NO_THROW(++(target(damaged(valid, random)) ? counts.first : counts.second));
    }
    return counts;
}

} // namespace slant::test
