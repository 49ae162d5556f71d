#include "scene/shape_reader.h"

#include "base/suggest.h"
#include "scene/loop_subdivision.h"
#include "scene/scene_files.h"
#include "scene/spelling.h"
#include "scene/texture_table.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

/// Triangles that a loopsubdiv may come to.
constexpr double kMaxSubdivided = 1 << 26;

/// A texture, or -1 where all rays are stopped.
int readAlpha(ParameterList& parameters, TextureTable& textures) {
    const Parameter* alpha = parameters.find("alpha", {"float", "texture"});
    if (!alpha || (alpha->type == "float" && alpha->numbers[0] >= 1)) return -1;
    return textures.floatTexture(parameters, "alpha", std::nullopt);
}

void checkSize(ParameterList& parameters, std::string_view name, std::size_t count, std::size_t vertices) {
    if (count != 0 && count != vertices)
        throw badInput(parameters.positionOf(name), "'{}' has {} items, but there are {} vertices", name,
                       count, vertices);
}

std::vector<std::uint32_t> readIndices(ParameterList& parameters, std::size_t perFace, std::size_t vertices) {
    const std::vector<int> given = parameters.integers("indices");
    if (given.empty()) {
        if (vertices != perFace)
            throw badInput(parameters.position(), "{} needs \"integer indices\"", parameters.subject());
        return perFace == 3 ? std::vector<std::uint32_t>{0, 1, 2} : std::vector<std::uint32_t>{0, 1, 2, 3};
    }
    const Position where = parameters.positionOf("indices");
    if (given.size() % perFace != 0)
        throw badInput(where, "'indices' has {} numbers, not a multiple of {}", given.size(), perFace);
    for (std::size_t i = 0; i < given.size(); ++i)
        if (given[i] < 0 || std::size_t(given[i]) >= vertices)
            throw badInput(where, "number {} of 'indices' is {}, but there are {} vertices", i + 1, given[i],
                           vertices);
    return {given.begin(), given.end()};
}

int readMesh(Mesh::Kind kind, ParameterList& parameters, Scene& scene) {
    Mesh mesh;
    mesh.kind = kind;
    mesh.positions = parameters.triples("P", "point3");
    if (mesh.positions.empty())
        throw badInput(parameters.position(), "{} needs \"point3 P\"", parameters.subject());
    mesh.normals = parameters.triples("N", "normal");
    mesh.uvs = parameters.pairs("uv", "point2");
    mesh.indices = readIndices(parameters, kind == Mesh::Kind::triangles ? 3 : 4, mesh.positions.size());
    checkSize(parameters, "N", mesh.normals.size(), mesh.positions.size());
    checkSize(parameters, "uv", mesh.uvs.size(), mesh.positions.size());
    parameters.ignore({"faceIndices"}); // of Ptex textures only
    if (!parameters.triples("S", "vector3").empty())
        parameters.note("S", "tangents 'S' are ignored; they only turn highlights that are not round");
    scene.meshes.push_back(std::move(mesh));
    return int(scene.meshes.size()) - 1;
}

std::vector<Shape> readPlyShapes(ParameterList& parameters, SceneFiles& files) {
    const std::optional<std::string> filename = parameters.text("filename");
    if (!filename)
        throw badInput(parameters.position(), "{} needs \"string filename\"", parameters.subject());
    std::vector<Shape> shapes;
    for (const int mesh : files.plyMeshes(*filename, parameters.positionOf("filename"))) {
        shapes.emplace_back();
        shapes.back().meshIndex = mesh;
    }
    return shapes;
}

int readSubdivision(ParameterList& parameters, Scene& scene) {
    const int mesh = readMesh(Mesh::Kind::triangles, parameters, scene);
    Mesh& control = scene.meshes[std::size_t(mesh)];
    const int levels = parameters.integer("levels", 3, 0, 30);
    parameters.choice("scheme", "loop", {"loop"});
    if (std::ldexp(double(control.indices.size() / 3), 2 * levels) > kMaxSubdivided)
        throw badInput(parameters.positionOf("levels"), "{} triangles cut {} times are too many",
                       control.indices.size() / 3, levels);
    control = loopSubdivided(control, levels, parameters.position());
    return mesh;
}

/// The line or curve between two points as it turns about the z axis.
Shape turned(ShapeKind kind, glm::vec3 from, glm::vec3 to, ParameterList& parameters) {
    Shape shape;
    shape.kind = kind;
    shape.ends = {from, to};
    shape.phiMaxDegrees = std::clamp(parameters.number("phimax", 360), 0.f, 360.f);
    const bool isOnAxis = glm::vec2(from) == glm::vec2(0) && glm::vec2(to) == glm::vec2(0);
    if (isOnAxis || from.z == to.z || shape.phiMaxDegrees == 0)
        throw badInput(parameters.position(), "nothing is left of this shape between its ends, 0 and phimax");
    return shape;
}

Shape readCylinder(ParameterList& parameters) {
    const float radius = parameters.number("radius", 1, kPositive);
    const float low = parameters.number("zmin", -1), high = parameters.number("zmax", 1);
    return turned(ShapeKind::hyperboloid, {radius, 0, std::min(low, high)}, {radius, 0, std::max(low, high)},
                  parameters);
}

Shape readCone(ParameterList& parameters) {
    const float radius = parameters.number("radius", 1, kPositive);
    return turned(ShapeKind::hyperboloid, {radius, 0, 0}, {0, 0, parameters.number("height", 1, kPositive)},
                  parameters);
}

Shape readHyperboloid(ParameterList& parameters) {
    glm::vec3 from = parameters.triple("p1", "point3", glm::vec3(0)),
              to = parameters.triple("p2", "point3", glm::vec3(1));
    if (to.z == 0) std::swap(from, to); // so it is in pbrt, and v with it
    return turned(ShapeKind::hyperboloid, from, to, parameters);
}

Shape readParaboloid(ParameterList& parameters) {
    const float radius = parameters.number("radius", 1, kPositive);
    const float a = parameters.number("zmin", 0, kNonNegative),
                b = parameters.number("zmax", 1, kNonNegative);
    const float low = std::min(a, b), high = std::max(a, b);
    return turned(ShapeKind::paraboloid, {radius * std::sqrt(low / high), 0, low}, {radius, 0, high},
                  parameters);
}

Shape readSphere(ParameterList& parameters) {
    Shape shape;
    shape.kind = ShapeKind::sphere;
    shape.radius = parameters.number("radius", 1, kPositive);
    const float low = parameters.number("zmin", -shape.radius),
                high = parameters.number("zmax", shape.radius);
    shape.zMin = std::clamp(std::min(low, high), -shape.radius, shape.radius);
    shape.zMax = std::clamp(std::max(low, high), -shape.radius, shape.radius);
    shape.phiMaxDegrees = std::clamp(parameters.number("phimax", 360), 0.f, 360.f);
    if (shape.zMin == shape.zMax || shape.phiMaxDegrees == 0)
        throw badInput(parameters.position(),
                       "nothing is left of this sphere between zmin and zmax, 0 and phimax");
    return shape;
}

Shape readDisk(ParameterList& parameters) {
    Shape shape;
    shape.kind = ShapeKind::disk;
    shape.height = parameters.number("height", 0);
    shape.radius = parameters.number("radius", 1, kPositive);
    shape.innerRadius = parameters.number("innerradius", 0, kNonNegative);
    shape.phiMaxDegrees = std::clamp(parameters.number("phimax", 360), 0.f, 360.f);
    if (shape.innerRadius >= shape.radius || shape.phiMaxDegrees == 0)
        throw badInput(parameters.position(), "nothing is left of this disk between its radii, 0 and phimax");
    return shape;
}

/// Shapes that their parameters describe alone.
struct Quadric {
    std::string_view name;
    Shape (*read)(ParameterList&);
};
constexpr Quadric kQuadrics[] = {{"sphere", readSphere},         {"disk", readDisk},
                                 {"cylinder", readCylinder},     {"cone", readCone},
                                 {"paraboloid", readParaboloid}, {"hyperboloid", readHyperboloid}};

} // namespace

std::vector<Shape> readShapes(const std::string& kind, ParameterList& parameters, Scene& scene,
                              SceneFiles& files, TextureTable& textures) {
    const int alpha = readAlpha(parameters, textures);
    std::vector<Shape> shapes;
    if (kind == "trianglemesh" || kind == "bilinearmesh") {
        shapes.emplace_back();
        shapes.back().meshIndex = readMesh(
            kind == "trianglemesh" ? Mesh::Kind::triangles : Mesh::Kind::bilinearPatches, parameters, scene);
    } else if (kind == "plymesh") {
        shapes = readPlyShapes(parameters, files);
    } else if (kind == "loopsubdiv") {
        shapes.emplace_back();
        shapes.back().meshIndex = readSubdivision(parameters, scene);
    } else if (const auto* quadric = std::ranges::find(kQuadrics, kind, &Quadric::name);
               quadric != std::end(kQuadrics)) {
        shapes = {quadric->read(parameters)};
    } else if (kind == "curve") {
        throw unsupported(parameters.position(),
                          "curves are not supported: a sample has one depth, and strands"
                          " thinner than a pixel have many");
    } else {
        std::vector<std::string_view> names{"trianglemesh", "bilinearmesh", "plymesh", "loopsubdiv"};
        for (const Quadric& each : kQuadrics) names.push_back(each.name);
        throw unsupported(parameters.position(), "shape \"{}\" is not supported{}", printable(kind),
                          didYouMean(kind, names));
    }
    parameters.finish();
    for (Shape& shape : shapes) {
        shape.location = parameters.position();
        shape.alpha = alpha;
    }
    return shapes;
}

} // namespace slant
