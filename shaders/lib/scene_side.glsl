// Outputs on the scene's side of a lens. Needs lensMapAt (lib/lens_map.glsl).
#ifndef SLANT_LIB_SCENE_SIDE_GLSL
#define SLANT_LIB_SCENE_SIDE_GLSL
#include "lib/lens_map.glsl"
#include "lib/output.glsl"

/// Takes an output of the film to the scene's side, where samples are searched. As host/reconstruct/output_pattern.cpp.
void toSceneSide(inout Output o) {
    const SceneRay place = sceneRay(o.xy, o.uv);
    o.xy = place.xy;
    o.uv = place.uv;
    o.weight = place.weight;
    o.filmMetric = place.filmMetric;
    o.extent = place.extent;
}
#endif
