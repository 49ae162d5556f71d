// Whether outputs look through a compound lens: then samples are on its scene's side
// (host/camera/lens_map.h).
#ifndef SLANT_RESOURCES_COMPOUND_LENS_GLSL
#define SLANT_RESOURCES_COMPOUND_LENS_GLSL

layout(constant_id = 0) const bool kCompoundLens = false;
#endif
