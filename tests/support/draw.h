// Random numbers and places for tests, the same in every run.
#pragma once
#include "support/synthetic.h"

namespace slant::test {

struct Draw {
    synthetic::Random random{7};

    float operator()(float low, float high) { return low + (high - low) * random.uniform(); }
    glm::vec2 place(float low, float high) {
        const float x = (*this)(low, high);
        return {x, (*this)(low, high)};
    }
    double part() { return double(random.uniform()); }
    /// 0 to count - 1.
    int below(int count) { return int(random.bits() % std::uint32_t(count)); }
    bool chance(float share) { return random.uniform() < share; }
};

} // namespace slant::test
