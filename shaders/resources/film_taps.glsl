// The pixels around one that the pixel filter reaches.
#ifndef SLANT_RESOURCES_FILM_TAPS_GLSL
#define SLANT_RESOURCES_FILM_TAPS_GLSL

/// Pixels to each side.
layout(constant_id = 0) const int kReachX = 1;
layout(constant_id = 1) const int kReachY = 1;
const int kColumns = 2 * kReachX + 1, kRows = 2 * kReachY + 1, kTaps = kColumns * kRows;
#endif
