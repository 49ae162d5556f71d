// A sample seen from an output's lens position. As host/reconstruct/search.cpp.
#ifndef SLANT_LIB_CANDIDATE_GLSL
#define SLANT_LIB_CANDIDATE_GLSL

#define kInfinity uintBitsToFloat(0x7f800000u)

struct Candidate {
    vec2 offset; // from the output, pixels
    float distance2;
    float slope;
    uint record;
};
#endif
