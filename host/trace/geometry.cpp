#include "trace/geometry.h"

#include "trace/body.h"
#include "trace/instance.h"
#include "trace/pattern.h"
#include "trace/textures.h"

#include <algorithm>
#include <deque>

namespace slant {

struct Geometry::Impl {
    embree::DevicePointer device;
    BodyGroup world;
    std::deque<BodyGroup> objects;
    struct Placed {
        Instance instance;
        int mover; ///< index in `movers`; -1: it keeps still
    };
    std::deque<Placed> instances; ///< geomID = world.still.entries.size() + index
    std::vector<const Placement*> movers;
    std::unique_ptr<Textures> textures; ///< of alphas; null if there is none

    Impl(const Scene& scene, Monitor& monitor);
    void place(const Body& body, const Placement& placement);
    void place(const ObjectInstance& instance);
    void resolve(const Ray& ray, unsigned instanceId, unsigned geometryId, const FoundHit& found,
                 SurfaceHit& hit) const;
};

namespace {

embree::DevicePointer newDevice() {
    embree::DevicePointer device(rtcNewDevice(nullptr));
    if (!device)
        throw Error(ErrorCode::resources, rtcGetDeviceError(nullptr) == RTC_ERROR_UNSUPPORTED_CPU
                                              ? "Embree cannot start on this processor"
                                              : "Embree cannot start: out of memory or threads");
    return device;
}

void commitMoving(const BodyGroup& group, RTCDevice device, Monitor& monitor) {
    for (const MovingBody& moving : group.moving) embree::commit(device, moving.body.scene.get(), monitor);
}

} // namespace

Geometry::Impl::Impl(const Scene& scene, Monitor& monitor) : device(newDevice()), world(device.get()) {
    int emitters = 0;
    for (const Shape& shape : scene.shapes)
        world.add(shape, scene.meshes, shape.areaLightIndex >= 0 ? emitters++ : -1, device.get());
    commitMoving(world, device.get(), monitor);
    for (const ObjectDefinition& definition : scene.objects) {
        BodyGroup& object = objects.emplace_back(device.get());
        for (const Shape& shape : definition.shapes) object.add(shape, scene.meshes, -1, device.get());
        embree::commit(device.get(), object.still.scene.get(), monitor);
        commitMoving(object, device.get(), monitor);
    }
    for (const MovingBody& moving : world.moving) place(moving.body, Placement(moving.placement));
    for (const ObjectInstance& instance : scene.instances) place(instance);
    embree::commit(device.get(), world.still.scene.get(), monitor);
    const auto isMasked = [](const Shape& shape) { return shape.alpha >= 0; };
    if (std::ranges::any_of(scene.shapes, isMasked) ||
        std::ranges::any_of(scene.objects, [&](const ObjectDefinition& object) {
            return std::ranges::any_of(object.shapes, isMasked);
        }))
        textures = std::make_unique<Textures>(scene);
}

/// Every body of the object is placed on its own, so that Embree has no instances within instances.
void Geometry::Impl::place(const ObjectInstance& instance) {
    const BodyGroup& object = objects.at(std::size_t(instance.objectIndex));
    place(object.still, Placement(instance.worldFromInstance));
    for (const MovingBody& moving : object.moving)
        place(moving.body, Placement(instance.worldFromInstance, moving.placement));
}

void Geometry::Impl::place(const Body& body, const Placement& placement) {
    if (body.entries.empty() && placement.moves()) return; // no box that could move
    const Instance& instance = instances.emplace_back(Placed{Instance(body, placement), -1}).instance;
    if (instance.motion()) {
        instances.back().mover = int(movers.size());
        movers.push_back(instance.motion());
    }
    embree::attach(device.get(), world.still.scene.get(), instance.makeGeometry(device.get()).get(),
                   world.still.entries.size() + instances.size() - 1);
}

void Geometry::Impl::resolve(const Ray& ray, unsigned instanceId, unsigned geometryId, const FoundHit& found,
                             SurfaceHit& hit) const {
    const auto fill = [&](const Body& body, const SurfaceRay& local) {
        const Entry& entry = body.entries[geometryId];
        const SurfaceLocation location = entry.surface->locate(found, local);
        const std::uint32_t primitive = entry.surface->meshPrimitive(found.primitive);
        entry.surface->describe(primitive, location, hit);
        hit.t = float(location.t);
        hit.materialIndex = entry.materialIndex;
        hit.alpha = entry.alpha;
        hit.emitter = {entry.emitter, entry.emitter < 0 ? 0 : int(primitive)};
    };
    hit.time = ray.time;
    const SurfaceRay exact{ray.origin, ray.direction};
    if (instanceId == RTC_INVALID_GEOMETRY_ID) {
        fill(world.still, exact);
        return;
    }
    const Placed& placed = instances[instanceId - world.still.entries.size()];
    hit.mover = placed.mover;
    placed.instance.withFrame(ray.time, [&](const PlacedFrame& frame) {
        fill(placed.instance.body(), frame.toBody(exact));
        frame.toWorld(hit);
    });
}

namespace {

constexpr int kPacket = 16;

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

void intersectPacket(RTCScene scene, std::span<const Ray> rays, RTCRayHit16& query) {
    alignas(64) int valid[kPacket];
    fillPacket(rays, query.ray, valid);
    std::fill_n(query.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(query.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
    embree::intersect(scene, valid, query);
}

} // namespace

Geometry::Geometry(const Scene& scene, Monitor& monitor) : impl_(std::make_unique<Impl>(scene, monitor)) {}
Geometry::~Geometry() = default;

bool Geometry::intersect(const Ray& ray, SurfaceHit& hit) const {
    if (!nearest(ray, hit)) return false;
    if (hit.alpha >= 0) passMasked(ray, hit);
    return hit.hit();
}

/// Takes `hit`, the nearest one, on to the first that stops the ray.
void Geometry::passMasked(const Ray& ray, SurfaceHit& hit) const {
    Ray rest = ray;
    float passed = 0; // of the ray's parameter
    const float length2 = glm::dot(ray.direction, ray.direction);
    while (hit.hit() && hit.alpha >= 0) {
        const float alpha =
            impl_->textures
                ->evaluate(hit.alpha, {hit.position, hit.uv, hit.geometricNormal}, TextureUse::number)
                .x;
        if (alpha >= 1) break;
        const std::uint32_t hash = hashWords(hashVector(rest.origin), hashVector(rest.direction));
        if (alpha > 0 && unitFloat(hash) <= alpha) break;
        rest.origin = offsetRayOrigin(hit.position, hit.positionError, hit.geometricNormal, ray.direction);
        passed = std::max(passed + hit.t, glm::dot(rest.origin - ray.origin, ray.direction) / length2);
        rest.tMax = ray.tMax - passed;
        if (!(rest.tMax > 0) || !nearest(rest, hit)) hit = SurfaceHit();
    }
    hit.t += passed;
}

bool Geometry::nearest(const Ray& ray, SurfaceHit& hit) const {
    RTCRayHit query;
    query.ray = singleRay(ray);
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    hit = SurfaceHit();
    embree::intersect(impl_->world.still.scene.get(), query);
    const RTCHit& h = query.hit;
    if (h.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    impl_->resolve(ray, h.instID[0], h.geomID,
                   {h.primID, query.ray.tfar, {h.u, h.v}, {h.Ng_x, h.Ng_y, h.Ng_z}}, hit);
    return true;
}

bool Geometry::occluded(const Ray& ray) const {
    if (impl_->textures) {
        SurfaceHit hit;
        return intersect(ray, hit);
    }
    RTCRay query = singleRay(ray);
    embree::occluded(impl_->world.still.scene.get(), query);
    return query.tfar < 0;
}

void Geometry::intersect(std::span<const Ray> rays, std::span<SurfaceHit> hits) const {
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        auto part = rays.subspan(first, std::min<std::size_t>(kPacket, rays.size() - first));
        RTCRayHit16 query;
        intersectPacket(impl_->world.still.scene.get(), part, query);
        const RTCHit16& h = query.hit;
        for (std::size_t i = 0; i < part.size(); ++i) {
            SurfaceHit& hit = hits[first + i] = SurfaceHit();
            if (h.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
            FoundHit found{
                h.primID[i], query.ray.tfar[i], {h.u[i], h.v[i]}, {h.Ng_x[i], h.Ng_y[i], h.Ng_z[i]}};
            impl_->resolve(part[i], h.instID[0][i], h.geomID[i], found, hit);
            if (hit.alpha >= 0) passMasked(part[i], hit);
        }
    }
}

void Geometry::occluded(std::span<const Ray> rays, std::span<std::uint8_t> occluded) const {
    if (impl_->textures) {
        for (std::size_t i = 0; i < rays.size(); ++i)
            occluded[i] = rays[i].tMax > 0 && this->occluded(rays[i]);
        return;
    }
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        auto part = rays.subspan(first, std::min<std::size_t>(kPacket, rays.size() - first));
        RTCRay16 query;
        alignas(64) int valid[kPacket];
        fillPacket(part, query, valid);
        embree::occluded(impl_->world.still.scene.get(), valid, query);
        for (std::size_t i = 0; i < part.size(); ++i) occluded[first + i] = valid[i] && query.tfar[i] < 0;
    }
}

void Geometry::distances(std::span<const Ray> rays, std::span<float> distances) const {
    if (impl_->textures) {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            SurfaceHit hit;
            distances[i] =
                rays[i].tMax > 0 && intersect(rays[i], hit) ? hit.t : std::numeric_limits<float>::infinity();
        }
        return;
    }
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        auto part = rays.subspan(first, std::min<std::size_t>(kPacket, rays.size() - first));
        RTCRayHit16 query;
        intersectPacket(impl_->world.still.scene.get(), part, query);
        for (std::size_t i = 0; i < part.size(); ++i)
            distances[first + i] = query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                                       ? std::numeric_limits<float>::infinity()
                                       : query.ray.tfar[i];
    }
}

Box Geometry::bounds() const {
    return impl_->world.still.bounds();
}

std::size_t Geometry::moverCount() const {
    return impl_->movers.size();
}

const Placement& Geometry::placement(int mover) const {
    return *impl_->movers[std::size_t(mover)];
}

} // namespace slant
