// PLY meshes: ASCII and binary of both byte orders (G. Turk's format 1.0), read as pbrt-v4 reads them.
#pragma once
#include "scene/scene.h"

#include <optional>
#include <string>
#include <string_view>

namespace slant {

/// Faces of 3 vertices become triangles, of 4 bilinear patches (as in pbrt); others are counted and skipped.
/// Both meshes hold all vertices of the file. Normals are nx ny nz, texture coordinates u v, s t, texture_u
/// texture_v or texture_s texture_t.
struct PlyMeshes {
    std::optional<Mesh> triangles, patches;
    std::size_t skippedFaces = 0;
    std::size_t lostNormals = 0; ///< that are not finite, and 0 here
};

/// `name` stands for the file in messages. Allocates no more than a small multiple of `bytes`. Throws
/// Error(badInput) for files that are malformed, have no faces, indices out of range or places that are not
/// finite; with the line where the file is text.
PlyMeshes parsePly(std::string_view bytes, const std::string& name);

} // namespace slant
