// An output: its place in pixel, lens and time. As in host/reconstruct/output_pattern.h.
#ifndef SLANT_LIB_OUTPUT_GLSL
#define SLANT_LIB_OUTPUT_GLSL
struct Output {
    vec2 xy;
    vec2 uv;
    float t;
    float positionCode;
};
#endif
