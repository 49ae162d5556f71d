#version 460
// Dense samples, first try: the front-most apparent surface within R.
#extension GL_GOOGLE_include_directive : require
#include "resources/bins.glsl"

#include "lib/nearest.glsl"
#include "resources/search_outputs.glsl"
