// Shape directives as plain shapes.
#pragma once
#include "scene/parameters.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace slant {

class SceneFiles;
class TextureTable;

/// The shapes of one Shape directive (a PLY file with triangles and quads makes two), with geometry alone:
/// transform, orientation, material and light are the caller's. Meshes go to `scene.meshes`. Throws
/// Error(badInput), also for parameters that the kind does not have.
std::vector<Shape> readShapes(const std::string& kind, ParameterList& parameters, Scene& scene,
                              SceneFiles& files, TextureTable& textures);

} // namespace slant
