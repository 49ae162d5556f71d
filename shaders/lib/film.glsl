// What a dense sample contributes to a pixel through the pixel filter.
//
// Needs, declared before the include: filterWeightAt(int), which reads the weights of a filter's table. In
// C++ it is included in a struct that has that.
#include "shared/kernel.h"
#include "shared/reconstruct.h"

/// Weight of a sample at subpixel q of the pixel `offset` pixels away, along one axis.
KERNEL float axisWeight(int tableBegin, int tableLength, int offset, int q) {
    const int k = offset * kSubpixels + q - kSubpixels / 2;
    const int index = k >= 0 ? k : -k - 1;
    return index >= tableLength ? 0.0f : filterWeightAt(tableBegin + index);
}

KERNEL vec4 weighted(vec4 dense, float weight) {
    return vec4(weight * dense.x, weight * dense.y, weight * dense.z, weight);
}
