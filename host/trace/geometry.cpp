#include "trace/geometry.h"

#include "trace/embree.h"
#include "trace/mesh_surface.h"
#include "trace/quadric_surface.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <vector>

namespace slant {
namespace {

constexpr int kPacket = 16;

struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct GeometryDeleter {
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using DevicePointer = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;
using ScenePointer = std::unique_ptr<RTCSceneTy, SceneDeleter>;
using GeometryPointer = std::unique_ptr<RTCGeometryTy, GeometryDeleter>;

/// Throws the error that Embree has recorded since the last call.
void check(RTCDevice device) {
    RTCError code = rtcGetDeviceError(device);
    if (code == RTC_ERROR_NONE) return;
    if (code == RTC_ERROR_OUT_OF_MEMORY)
        throw Error(ErrorCode::resources, "out of memory while building the ray tracing structure");
    throw Error(ErrorCode::resources, fmt::format("Embree failed with error {}", int(code)));
}

/// A shape as Embree's geometry `geomID` of its group, and what hits on it carry.
struct Entry {
    std::unique_ptr<Surface> surface;
    int materialIndex;
    int emitter;
};

/// The world's own shapes, or those of one object definition.
struct Group {
    std::vector<Entry> entries;
    ScenePointer scene;
};

struct Instance {
    const Group* group;
    glm::dmat3 linear, inverseLinear, normalMatrix;
    glm::dvec3 offset;
};

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

GeometryPointer makeUserGeometry(RTCDevice device, const UserSurface& surface) {
    GeometryPointer geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
    check(device);
    rtcSetGeometryUserPrimitiveCount(geometry.get(), surface.primitiveCount());
    rtcSetGeometryUserData(geometry.get(), const_cast<UserSurface*>(&surface));
    rtcSetGeometryBoundsFunction(geometry.get(), userBounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry.get(), userIntersect);
    rtcSetGeometryOccludedFunction(geometry.get(), userOccluded);
    return geometry;
}

GeometryPointer makeTriangleGeometry(RTCDevice device, const MeshSurface& surface) {
    GeometryPointer geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    check(device);
    const auto& positions = surface.paddedPositions();
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(),
                               0, sizeof(glm::vec3), positions.size() - 1);
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               surface.triangles().data(), 0, 3 * sizeof(std::uint32_t),
                               surface.triangles().size() / 3);
    return geometry;
}

/// Lets the monitor stop a build: Embree's callback may not throw, so the exception waits.
struct BuildWatch {
    Monitor& monitor;
    std::mutex mutex;
    std::exception_ptr stopped;

    static bool goOn(void* self, double) {
        auto& watch = *static_cast<BuildWatch*>(self);
        try {
            watch.monitor.advance(0);
            return true;
        } catch (...) {
            const std::lock_guard lock(watch.mutex);
            watch.stopped = std::current_exception();
            return false;
        }
    }
};

void commit(RTCDevice device, RTCScene scene, Monitor& monitor) {
    BuildWatch watch{monitor, {}, nullptr};
    rtcSetSceneProgressMonitorFunction(scene, BuildWatch::goOn, &watch);
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    if (watch.stopped) std::rethrow_exception(watch.stopped);
    check(device);
}

struct MadeSurface {
    std::unique_ptr<Surface> surface;
    GeometryPointer geometry; ///< uses the surface's memory
};

MadeSurface makeSurface(const Shape& shape, const std::vector<Mesh>& meshes, RTCDevice device) {
    if (shape.worldFromObject.moves()) throw badInput(shape.location, "moving shapes are not supported");
    auto user = [&](auto surface) {
        GeometryPointer geometry = makeUserGeometry(device, *surface);
        return MadeSurface{std::move(surface), std::move(geometry)};
    };
    auto triangles = [&](auto surface) {
        GeometryPointer geometry = makeTriangleGeometry(device, *surface);
        return MadeSurface{std::move(surface), std::move(geometry)};
    };
    if (shape.kind != ShapeKind::mesh) return user(std::make_unique<QuadricSurface>(shape));
    const Mesh& mesh = meshes.at(std::size_t(shape.meshIndex));
    if (mesh.kind == Mesh::Kind::triangles) return triangles(std::make_unique<TriangleSurface>(shape, mesh));
    auto patches = std::make_unique<BilinearSurface>(shape, mesh);
    return patches->flat() ? triangles(std::move(patches)) : user(std::move(patches));
}

void attach(RTCDevice device, RTCScene scene, RTCGeometry geometry, std::size_t id) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, unsigned(id));
    check(device);
}

} // namespace

// ---------------------------------------------------------------- the whole

struct Geometry::Impl {
    DevicePointer device;
    Group world;
    std::vector<Group> objects;
    std::vector<Instance> instances; ///< geomID = world.entries.size() + index

    Impl(const Scene& scene, Monitor& monitor);
    void build(Group& group, const std::vector<Shape>& shapes, const std::vector<Mesh>& meshes, bool emits);
    void addInstance(const ObjectInstance& instance);
    void resolve(const Ray& ray, unsigned instanceId, unsigned geometryId, const FoundHit& found,
                 SurfaceHit& hit) const;
};

Geometry::Impl::Impl(const Scene& scene, Monitor& monitor) : device(rtcNewDevice(nullptr)) {
    if (!device) throw Error(ErrorCode::resources, "Embree cannot start on this processor");
    build(world, scene.shapes, scene.meshes, true);
    objects.resize(scene.objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
        build(objects[i], scene.objects[i].shapes, scene.meshes, false);
        commit(device.get(), objects[i].scene.get(), monitor);
    }
    for (const ObjectInstance& instance : scene.instances) addInstance(instance);
    commit(device.get(), world.scene.get(), monitor);
}

void Geometry::Impl::build(Group& group, const std::vector<Shape>& shapes, const std::vector<Mesh>& meshes,
                           bool emits) {
    group.scene.reset(rtcNewScene(device.get()));
    check(device.get());
    rtcSetSceneFlags(group.scene.get(), RTC_SCENE_FLAG_ROBUST);
    group.entries.reserve(shapes.size());
    int emitters = 0;
    for (const Shape& shape : shapes) {
        int emitter = emits && shape.areaLightIndex >= 0 ? emitters++ : -1;
        MadeSurface made = makeSurface(shape, meshes, device.get());
        group.entries.push_back({std::move(made.surface), shape.materialIndex, emitter});
        attach(device.get(), group.scene.get(), made.geometry.get(), group.entries.size() - 1);
    }
}

void Geometry::Impl::addInstance(const ObjectInstance& instance) {
    if (instance.worldFromInstance.moves()) throw badInput({}, "moving instances are not supported");
    const glm::dmat4& matrix = instance.worldFromInstance.at[0];
    requireInvertible(matrix, {});
    const Group& group = objects.at(std::size_t(instance.objectIndex));
    GeometryPointer geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    check(device.get());
    rtcSetGeometryInstancedScene(geometry.get(), group.scene.get());
    glm::mat4 single(matrix);
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &single[0][0]);
    attach(device.get(), world.scene.get(), geometry.get(), world.entries.size() + instances.size());
    glm::dmat3 linear(matrix), inverse = glm::inverse(linear);
    instances.push_back({&group, linear, inverse, glm::transpose(inverse), glm::dvec3(matrix[3])});
}

namespace {

glm::dmat3 absolute(const glm::dmat3& m) {
    return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

/// From the instance's space to the world.
void transformHit(const Instance& instance, SurfaceHit& hit) {
    glm::dvec3 local(hit.position), world = instance.linear * local + instance.offset;
    // Embree transforms rays to the instance's space in float: the error of that, in world space.
    glm::dvec3 sizes = absolute(instance.inverseLinear) * (glm::abs(world) + glm::abs(instance.offset));
    glm::dvec3 localError = glm::dvec3(hit.positionError) + double(gammaBound(5)) * sizes;
    hit.position = world;
    hit.positionError = absolute(instance.linear) * localError + double(gammaBound(2)) * glm::abs(world);
    hit.geometricNormal = glm::normalize(instance.normalMatrix * glm::dvec3(hit.geometricNormal));
    hit.shadingNormal = glm::normalize(instance.normalMatrix * glm::dvec3(hit.shadingNormal));
    hit.dpdu = instance.linear * glm::dvec3(hit.dpdu);
}

} // namespace

void Geometry::Impl::resolve(const Ray& ray, unsigned instanceId, unsigned geometryId, const FoundHit& found,
                             SurfaceHit& hit) const {
    const Instance* instance =
        instanceId == RTC_INVALID_GEOMETRY_ID ? nullptr : &instances[instanceId - world.entries.size()];
    const Entry& entry = (instance ? *instance->group : world).entries[geometryId];
    SurfaceRay local{ray.origin, ray.direction};
    if (instance)
        local = {instance->inverseLinear * (local.origin - instance->offset),
                 instance->inverseLinear * local.direction};
    const SurfaceLocation location = entry.surface->locate(found, local);
    const std::uint32_t primitive = entry.surface->meshPrimitive(found.primitive);
    entry.surface->describe(primitive, location, hit);
    hit.t = float(location.t);
    hit.materialIndex = entry.materialIndex;
    hit.emitter = {entry.emitter, entry.emitter < 0 ? 0 : int(primitive)};
    if (instance) transformHit(*instance, hit);
}

namespace {

RTCRay singleRay(const Ray& ray) {
    RTCRay out;
    out.org_x = ray.origin.x, out.org_y = ray.origin.y, out.org_z = ray.origin.z;
    out.dir_x = ray.direction.x, out.dir_y = ray.direction.y, out.dir_z = ray.direction.z;
    out.tnear = 0, out.tfar = ray.tMax, out.time = ray.time;
    out.mask = ~0u, out.id = 0, out.flags = 0;
    return out;
}

/// Lanes without a ray, or with a ray to skip, are not valid.
void fillPacket(std::span<const Ray> rays, RTCRay16& packet, int* valid) {
    for (std::size_t i = 0; i < kPacket; ++i) {
        const Ray& ray = rays[i < rays.size() ? i : 0];
        packet.org_x[i] = ray.origin.x, packet.org_y[i] = ray.origin.y, packet.org_z[i] = ray.origin.z;
        packet.dir_x[i] = ray.direction.x, packet.dir_y[i] = ray.direction.y,
        packet.dir_z[i] = ray.direction.z;
        packet.tnear[i] = 0, packet.tfar[i] = ray.tMax, packet.time[i] = ray.time;
        packet.mask[i] = ~0u, packet.id[i] = unsigned(i), packet.flags[i] = 0;
        valid[i] = i < rays.size() && ray.tMax > 0 ? -1 : 0;
    }
}

} // namespace

Geometry::Geometry(const Scene& scene, Monitor& monitor) : impl_(std::make_unique<Impl>(scene, monitor)) {}
Geometry::~Geometry() = default;

bool Geometry::intersect(const Ray& ray, SurfaceHit& hit) const {
    RTCRayHit query;
    query.ray = singleRay(ray);
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    hit = SurfaceHit();
    embree::intersect(impl_->world.scene.get(), query);
    const RTCHit& h = query.hit;
    if (h.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    impl_->resolve(ray, h.instID[0], h.geomID,
                   {h.primID, query.ray.tfar, {h.u, h.v}, {h.Ng_x, h.Ng_y, h.Ng_z}}, hit);
    return true;
}

bool Geometry::occluded(const Ray& ray) const {
    RTCRay query = singleRay(ray);
    embree::occluded(impl_->world.scene.get(), query);
    return query.tfar < 0;
}

void Geometry::intersect(std::span<const Ray> rays, std::span<SurfaceHit> hits) const {
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        auto part = rays.subspan(first, std::min<std::size_t>(kPacket, rays.size() - first));
        RTCRayHit16 query;
        alignas(64) int valid[kPacket];
        fillPacket(part, query.ray, valid);
        std::fill_n(query.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(query.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
        embree::intersect(impl_->world.scene.get(), valid, query);
        const RTCHit16& h = query.hit;
        for (std::size_t i = 0; i < part.size(); ++i) {
            SurfaceHit& hit = hits[first + i] = SurfaceHit();
            if (h.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
            FoundHit found{
                h.primID[i], query.ray.tfar[i], {h.u[i], h.v[i]}, {h.Ng_x[i], h.Ng_y[i], h.Ng_z[i]}};
            impl_->resolve(part[i], h.instID[0][i], h.geomID[i], found, hit);
        }
    }
}

void Geometry::occluded(std::span<const Ray> rays, std::span<std::uint8_t> occluded) const {
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        auto part = rays.subspan(first, std::min<std::size_t>(kPacket, rays.size() - first));
        RTCRay16 query;
        alignas(64) int valid[kPacket];
        fillPacket(part, query, valid);
        embree::occluded(impl_->world.scene.get(), valid, query);
        for (std::size_t i = 0; i < part.size(); ++i) occluded[first + i] = valid[i] && query.tfar[i] < 0;
    }
}

Box Geometry::bounds() const {
    RTCBounds b;
    rtcGetSceneBounds(impl_->world.scene.get(), &b);
    Box box;
    if (b.lower_x <= b.upper_x) {
        box.min = {b.lower_x, b.lower_y, b.lower_z};
        box.max = {b.upper_x, b.upper_y, b.upper_z};
    }
    return box;
}

} // namespace slant
