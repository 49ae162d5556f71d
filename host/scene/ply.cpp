#include "scene/ply.h"

#include "scene/ply_input.h"
#include "scene/spelling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace slant {
namespace {

constexpr std::size_t kMaxVertices = std::numeric_limits<std::int32_t>::max();

/// Where a vertex property goes: an offset in VertexRow, or -1 if it is dropped.
enum VertexField { x, y, z, nx, ny, nz, u, v, fieldCount };
using VertexRow = std::array<double, fieldCount>;

constexpr std::string_view kFieldNames[] = {"x", "y", "z", "nx", "ny", "nz"};
constexpr std::pair<std::string_view, std::string_view> kUvNames[] = {
    {"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};

/// Vertex field of each property of the element.
struct VertexLayout {
    std::vector<int> fields;
    bool hasNormals = false, hasUvs = false;
};

bool has(const PlyElement& element, std::string_view name) {
    return std::any_of(element.properties.begin(), element.properties.end(),
                       [&](const PlyProperty& p) { return p.name == name && !p.isList; });
}

VertexLayout layoutOf(const PlyElement& element, PlyInput& input) {
    VertexLayout layout;
    if (!has(element, "x") || !has(element, "y") || !has(element, "z"))
        throw input.error("the vertices have no properties x, y, z");
    layout.hasNormals = has(element, "nx") && has(element, "ny") && has(element, "nz");
    std::pair<std::string_view, std::string_view> uvNames;
    for (const auto& names : kUvNames) {
        layout.hasUvs = has(element, names.first) && has(element, names.second);
        uvNames = names;
        if (layout.hasUvs) break;
    }
    for (const PlyProperty& property : element.properties) {
        int field = -1;
        for (int i = 0; i < (layout.hasNormals ? 6 : 3); ++i)
            if (property.name == kFieldNames[i]) field = i;
        if (layout.hasUvs && property.name == uvNames.first) field = u;
        if (layout.hasUvs && property.name == uvNames.second) field = v;
        layout.fields.push_back(property.isList ? -1 : field);
    }
    return layout;
}

bool isFinite(double value) {
    return std::abs(value) <= double(std::numeric_limits<float>::max());
}

/// All vertices; the indices stay empty.
Mesh readVertices(const PlyElement& element, PlyInput& input, std::size_t& lostNormals) {
    if (element.count > kMaxVertices)
        throw input.error(fmt::format("{} vertices are too many", element.count));
    const VertexLayout layout = layoutOf(element, input);
    Mesh mesh;
    mesh.positions.reserve(element.count);
    if (layout.hasNormals) mesh.normals.reserve(element.count);
    if (layout.hasUvs) mesh.uvs.reserve(element.count);
    for (std::size_t i = 0; i < element.count; ++i) {
        VertexRow row{};
        for (std::size_t p = 0; p < element.properties.size(); ++p) {
            if (layout.fields[p] >= 0)
                row[layout.fields[p]] = input.scalar(element.properties[p].type);
            else
                input.skip(element.properties[p]);
        }
        if (!(isFinite(row[nx]) && isFinite(row[ny]) && isFinite(row[nz]))) {
            row[nx] = row[ny] = row[nz] = 0;
            ++lostNormals;
        }
        for (const double value : row)
            if (!isFinite(value))
                throw input.error(fmt::format("vertex {} has a number that is not finite", i));
        mesh.positions.emplace_back(row[x], row[y], row[z]);
        if (layout.hasNormals) mesh.normals.emplace_back(row[nx], row[ny], row[nz]);
        if (layout.hasUvs) mesh.uvs.emplace_back(row[u], row[v]);
    }
    return mesh;
}

struct Faces {
    std::vector<std::uint32_t> triangles, patches;
    std::size_t skipped = 0;
};

void readFace(Faces& faces, const PlyProperty& property, std::size_t face, std::size_t vertexCount,
              PlyInput& input) {
    const std::size_t corners = input.listLength(property);
    std::array<std::uint32_t, 4> index{};
    for (std::size_t i = 0; i < corners; ++i) {
        const double value = input.scalar(property.type);
        if (corners != 3 && corners != 4) continue;
        if (!(value >= 0 && value < double(vertexCount) && value == std::floor(value)))
            throw input.error(
                fmt::format("face {} has index {}, but there are {} vertices", face, value, vertexCount));
        index[i] = std::uint32_t(value);
    }
    if (corners == 3)
        faces.triangles.insert(faces.triangles.end(), {index[0], index[1], index[2]});
    else if (corners == 4) // around the rim in the file, by rows in a bilinear patch
        faces.patches.insert(faces.patches.end(), {index[0], index[1], index[3], index[2]});
    else
        ++faces.skipped;
}

Faces readFaces(const PlyElement& element, std::size_t vertexCount, PlyInput& input) {
    const auto isIndices = [](const PlyProperty& p) {
        return p.isList && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    if (std::none_of(element.properties.begin(), element.properties.end(), isIndices))
        throw input.error("the faces have no list property vertex_indices");
    Faces faces;
    for (std::size_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties) {
            if (isIndices(property))
                readFace(faces, property, i, vertexCount, input);
            else
                input.skip(property);
        }
    return faces;
}

void skipElement(const PlyElement& element, PlyInput& input) {
    if (element.properties.empty()) return; // takes no bytes, whatever the count
    for (std::size_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties) input.skip(property);
}

} // namespace

PlyMeshes parsePly(std::string_view bytes, const std::string& name) {
    PlyInput input(bytes, name);
    const auto count = [&](std::string_view element) {
        for (const PlyElement& e : input.elements())
            if (e.name == element) return e.count;
        return std::size_t(0);
    };
    const std::size_t vertexCount = count("vertex");
    if (vertexCount == 0 || count("face") == 0) throw input.error("the file has no vertices or no faces");

    PlyMeshes meshes;
    Mesh vertices;
    Faces faces;
    for (const PlyElement& element : input.elements()) {
        input.checkCount(element);
        if (element.name == "vertex" && vertices.positions.empty())
            vertices = readVertices(element, input, meshes.lostNormals);
        else if (element.name == "face" && faces.triangles.empty() && faces.patches.empty())
            faces = readFaces(element, vertexCount, input);
        else
            skipElement(element, input);
    }
    meshes.skippedFaces = faces.skipped;
    if (faces.triangles.empty() && faces.patches.empty())
        throw input.error("the file has no face of three or four vertices");
    if (!faces.triangles.empty()) {
        meshes.triangles = vertices;
        meshes.triangles->indices = std::move(faces.triangles);
    }
    if (!faces.patches.empty()) {
        meshes.patches = std::move(vertices);
        meshes.patches->kind = Mesh::Kind::bilinearPatches;
        meshes.patches->indices = std::move(faces.patches);
    }
    return meshes;
}

} // namespace slant
