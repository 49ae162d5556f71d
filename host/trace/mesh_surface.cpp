#include "trace/mesh_surface.h"

#include "base/parallel.h"

#include <algorithm>

namespace slant {

MeshSurface::MeshSurface(const Shape& shape, const Mesh& mesh, std::uint32_t corners)
    : mesh_(mesh), corners_(corners), flip_(flipsNormals(shape)) {
    if (mesh.indices.size() % corners != 0 || mesh.indices.size() / corners > 0x7fffffffu ||
        std::any_of(mesh.indices.begin(), mesh.indices.end(),
                    [&](std::uint32_t index) { return index >= mesh.positions.size(); }))
        throw badInput(shape.location, "the mesh's indices do not fit its {} vertices",
                       mesh.positions.size());
    if ((!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) ||
        (!mesh.uvs.empty() && mesh.uvs.size() != mesh.positions.size()))
        throw badInput(shape.location, "the mesh has {} vertices, {} normals and {} uvs",
                       mesh.positions.size(), mesh.normals.size(), mesh.uvs.size());

    const glm::dmat4& matrix = shape.worldFromObject.at[0];
    requireInvertible(matrix, shape.location);
    positions_.resize(mesh.positions.size() + 1);
    normals_.resize(mesh.normals.size());
    glm::dmat3 normalMatrix = glm::transpose(glm::inverse(glm::dmat3(matrix)));
    double side = shape.reverseOrientation ? -1 : 1;
    parallelFor(0, mesh.positions.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            positions_[i] = transformPoint(matrix, mesh.positions[i]);
            if (!normals_.empty()) normals_[i] = side * (normalMatrix * glm::dvec3(mesh.normals[i]));
        }
    });
}

} // namespace slant
