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

constexpr std::string_view kKinds[] = {"trianglemesh", "bilinearmesh", "plymesh", "loopsubdiv",
                                       "sphere",       "disk",         "cylinder"};

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

Shape readCylinder(ParameterList& parameters) {
    Shape shape;
    shape.kind = ShapeKind::cylinder;
    shape.radius = parameters.number("radius", 1, kPositive);
    const float low = parameters.number("zmin", -1), high = parameters.number("zmax", 1);
    shape.zMin = std::min(low, high);
    shape.zMax = std::max(low, high);
    shape.phiMaxDegrees = std::clamp(parameters.number("phimax", 360), 0.f, 360.f);
    if (shape.zMin == shape.zMax || shape.phiMaxDegrees == 0)
        throw badInput(parameters.position(),
                       "nothing is left of this cylinder between zmin and zmax, 0 and phimax");
    return shape;
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
    } else if (kind == "cylinder") {
        shapes = {readCylinder(parameters)};
    } else if (kind == "sphere") {
        shapes = {readSphere(parameters)};
    } else if (kind == "disk") {
        shapes = {readDisk(parameters)};
    } else {
        throw unsupported(parameters.position(), "shape \"{}\" is not supported{}", printable(kind),
                          didYouMean(kind, kKinds));
    }
    parameters.finish();
    for (Shape& shape : shapes) {
        shape.location = parameters.position();
        shape.alpha = alpha;
    }
    return shapes;
}

} // namespace slant
