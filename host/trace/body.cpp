#include "trace/body.h"

#include "trace/mesh_surface.h"
#include "trace/quadric_surface.h"

namespace slant {
namespace {

// ---------------------------------------------------------------- user geometries

void userBounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& surface = *static_cast<const UserSurface*>(arguments->geometryUserPtr);
    Box box = surface.bounds(arguments->primID);
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = box.min.x, out.lower_y = box.min.y, out.lower_z = box.min.z;
    out.upper_x = box.max.x, out.upper_y = box.max.y, out.upper_z = box.max.z;
}

std::optional<SurfaceLocation> meetRay(const UserSurface& surface, unsigned primitive, RTCRayN* rays,
                                       unsigned size, unsigned i) {
    SurfaceRay ray{
        {RTCRayN_org_x(rays, size, i), RTCRayN_org_y(rays, size, i), RTCRayN_org_z(rays, size, i)},
        {RTCRayN_dir_x(rays, size, i), RTCRayN_dir_y(rays, size, i), RTCRayN_dir_z(rays, size, i)}};
    return surface.intersect(primitive, ray, RTCRayN_tfar(rays, size, i));
}

void userIntersect(const RTCIntersectFunctionNArguments* arguments) {
    const auto& surface = *static_cast<const UserSurface*>(arguments->geometryUserPtr);
    const unsigned size = arguments->N;
    RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, size);
    RTCHitN* hits = RTCRayHitN_HitN(arguments->rayhit, size);
    for (unsigned i = 0; i < size; ++i) {
        if (!arguments->valid[i]) continue;
        auto location = meetRay(surface, arguments->primID, rays, size, i);
        if (!location) continue;
        RTCRayN_tfar(rays, size, i) = float(location->t);
        RTCHitN_Ng_x(hits, size, i) = float(location->local.x);
        RTCHitN_Ng_y(hits, size, i) = float(location->local.y);
        RTCHitN_Ng_z(hits, size, i) = float(location->local.z);
        RTCHitN_geomID(hits, size, i) = arguments->geomID;
        RTCHitN_primID(hits, size, i) = arguments->primID;
        RTCHitN_instID(hits, size, i, 0) = arguments->context->instID[0];
    }
}

void userOccluded(const RTCOccludedFunctionNArguments* arguments) {
    const auto& surface = *static_cast<const UserSurface*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i)
        if (arguments->valid[i] && meetRay(surface, arguments->primID, arguments->ray, arguments->N, i))
            RTCRayN_tfar(arguments->ray, arguments->N, i) = -std::numeric_limits<float>::infinity();
}

embree::GeometryPointer makeUserGeometry(RTCDevice device, const UserSurface& surface) {
    auto geometry = embree::newGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry.get(), surface.primitiveCount());
    rtcSetGeometryUserData(geometry.get(), const_cast<UserSurface*>(&surface));
    rtcSetGeometryBoundsFunction(geometry.get(), userBounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry.get(), userIntersect);
    rtcSetGeometryOccludedFunction(geometry.get(), userOccluded);
    return geometry;
}

embree::GeometryPointer makeTriangleGeometry(RTCDevice device, const MeshSurface& surface) {
    auto geometry = embree::newGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto& positions = surface.paddedPositions();
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(),
                               0, sizeof(glm::vec3), positions.size() - 1);
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               surface.triangles().data(), 0, 3 * sizeof(std::uint32_t),
                               surface.triangles().size() / 3);
    return geometry;
}

struct MadeSurface {
    std::unique_ptr<Surface> surface;
    embree::GeometryPointer geometry; ///< uses the surface's memory
};

MadeSurface makeSurface(const Shape& shape, const std::vector<Mesh>& meshes, RTCDevice device) {
    auto user = [&](auto surface) {
        auto geometry = makeUserGeometry(device, *surface);
        return MadeSurface{std::move(surface), std::move(geometry)};
    };
    auto triangles = [&](auto surface) {
        auto geometry = makeTriangleGeometry(device, *surface);
        return MadeSurface{std::move(surface), std::move(geometry)};
    };
    if (shape.kind != ShapeKind::mesh) return user(std::make_unique<QuadricSurface>(shape));
    const Mesh& mesh = meshes.at(std::size_t(shape.meshIndex));
    if (mesh.kind == Mesh::Kind::triangles) return triangles(std::make_unique<TriangleSurface>(shape, mesh));
    auto patches = std::make_unique<BilinearSurface>(shape, mesh);
    return patches->flat() ? triangles(std::move(patches)) : user(std::move(patches));
}

bool sameMotion(const MovingTransform& a, const MovingTransform& b) {
    return a.at == b.at && a.times == b.times;
}

/// The shape in its own space, with the normals that its placement gives it.
Shape unplaced(const Shape& shape) {
    Shape result = shape;
    result.worldFromObject = {};
    // A placement turns the cross products of mirrored meshes by itself, but not the normals of quadrics.
    if (shape.kind != ShapeKind::mesh) result.reverseOrientation = flipsNormals(shape);
    return result;
}

} // namespace

void Body::add(const Shape& shape, const std::vector<Mesh>& meshes, int emitter, RTCDevice device) {
    MadeSurface made = makeSurface(shape, meshes, device);
    entries.push_back({std::move(made.surface), shape.materialIndex, emitter, shape.alpha});
    embree::attach(device, scene.get(), made.geometry.get(), entries.size() - 1);
}

Box Body::bounds() const {
    RTCBounds b;
    rtcGetSceneBounds(scene.get(), &b);
    Box box;
    if (b.lower_x <= b.upper_x) {
        box.min = {b.lower_x, b.lower_y, b.lower_z};
        box.max = {b.upper_x, b.upper_y, b.upper_z};
    }
    return box;
}

void BodyGroup::add(const Shape& shape, const std::vector<Mesh>& meshes, int emitter, RTCDevice device) {
    if (!shape.worldFromObject.moves()) {
        still.add(shape, meshes, emitter, device);
        return;
    }
    for (const glm::dmat4& matrix : shape.worldFromObject.at) requireInvertible(matrix, shape.location);
    if (moving.empty() || !sameMotion(moving.back().placement, shape.worldFromObject))
        moving.push_back({Body(device), shape.worldFromObject});
    moving.back().body.add(unplaced(shape), meshes, emitter, device);
}

} // namespace slant
