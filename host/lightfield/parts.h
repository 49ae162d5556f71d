// Halves of a light field, and light fields put together.
#pragma once
#include "lightfield/lightfield.h"

namespace slant {

/// Copies `count` samples with their planes of values; a plane that `from` lacks is left as it is.
void copySamples(const SampleSet& from, std::size_t source, SampleSet& to, std::size_t target,
                 std::size_t count);

/// Every other sample of each pixel. The halves 0 and 1 are alike; where a pixel's number of samples is odd,
/// neighbours take turns in which half has one more.
LightField halfOf(const LightField& field, int half);

/// Puts the samples of another field behind those of the same pixels; its bounds lie within `field.bounds`.
/// Both have the same planes of values, but either may lack motion.
void addSamples(LightField& field, const LightField& more);

} // namespace slant
