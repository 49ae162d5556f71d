#include "trace/instance.h"

#include <algorithm>

namespace slant {
namespace {

/// Boxes are to leave their true places by no more than this part of their size, with at most so many steps.
constexpr double kTolerance = 1.0 / 16;
constexpr int kMaxSteps = 64;

glm::dmat3 absolute(const glm::dmat3& m) {
    return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

struct Corners {
    glm::dvec3 at[8];
};

Corners cornersAt(const Placement& placement, const Box& box, double time) {
    const glm::dmat4 matrix = placement.at(time);
    Corners corners;
    for (int k = 0; k < 8; ++k) {
        const glm::dvec4 corner(k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y,
                                k & 4 ? box.max.z : box.min.z, 1);
        corners.at[k] = glm::dvec3(matrix * corner);
    }
    return corners;
}

/// How far corners leave the straight way from one time to another, along any axis. Motion is smooth but for
/// its beginning and its end: three places show at least half of it.
double straying(const Placement& placement, const Box& box, double from, double to) {
    const Corners first = cornersAt(placement, box, from), last = cornersAt(placement, box, to);
    double most = 0;
    for (const double part : {0.25, 0.5, 0.75}) {
        const Corners here = cornersAt(placement, box, glm::mix(from, to, part));
        for (int k = 0; k < 8; ++k) {
            const glm::dvec3 off = glm::abs(here.at[k] - glm::mix(first.at[k], last.at[k], part));
            most = std::max({most, off.x, off.y, off.z});
        }
    }
    return 2 * most;
}

/// Boxes at `steps` + 1 times of the shutter, before they are widened by what lies between.
std::vector<Box> boxesAtSteps(const Placement& placement, const Box& box, int steps) {
    std::vector<Box> boxes(std::size_t(steps) + 1);
    for (int i = 0; i <= steps; ++i)
        for (const glm::dvec3& corner : cornersAt(placement, box, double(i) / steps).at)
            boxes[std::size_t(i)].extend(glm::vec3(corner));
    return boxes;
}

std::vector<Box> movingBounds(const Placement& placement, const Box& box) {
    for (int steps = 1;; steps *= 2) {
        std::vector<Box> boxes = boxesAtSteps(placement, box, steps);
        double most = 0, size = 0;
        for (int i = 0; i < steps; ++i)
            most = std::max(most, straying(placement, box, double(i) / steps, double(i + 1) / steps));
        for (const Box& each : boxes) {
            const glm::vec3 extent = each.max - each.min;
            size = std::max(size, double(std::max({extent.x, extent.y, extent.z})));
        }
        if (most > kTolerance * size && steps < kMaxSteps) continue;
        for (Box& each : boxes) {
            // What rounding to floats may add, here and in the rays.
            const glm::vec3 slack =
                float(most) + 8 * gammaBound(8) * glm::max(glm::abs(each.min), glm::abs(each.max));
            each.min -= slack;
            each.max += slack;
        }
        return boxes;
    }
}

// ---------------------------------------------------------------- callbacks of moving bodies

void boundsOfMoving(const RTCBoundsFunctionArguments* arguments) {
    const auto& instance = *static_cast<const Instance*>(arguments->geometryUserPtr);
    const Box& box = instance.stepBounds()[arguments->timeStep];
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = box.min.x, out.lower_y = box.min.y, out.lower_z = box.min.z;
    out.upper_x = box.max.x, out.upper_y = box.max.y, out.upper_z = box.max.z;
}

/// Ray i of a packet, in the body's space at the ray's time; its parameter stays what it is.
RTCRay rayInBody(const Instance& instance, RTCRayN* rays, unsigned size, unsigned i) {
    RTCRay ray = rtcGetRayFromRayN(rays, size, i);
    instance.withFrame(ray.time, [&](const PlacedFrame& frame) {
        const SurfaceRay local =
            frame.toBody({{ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}});
        ray.org_x = float(local.origin.x), ray.org_y = float(local.origin.y),
        ray.org_z = float(local.origin.z);
        ray.dir_x = float(local.direction.x), ray.dir_y = float(local.direction.y),
        ray.dir_z = float(local.direction.z);
    });
    return ray;
}

void intersectMoving(const RTCIntersectFunctionNArguments* arguments) {
    const auto& instance = *static_cast<const Instance*>(arguments->geometryUserPtr);
    const unsigned size = arguments->N;
    RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, size);
    RTCHitN* hits = RTCRayHitN_HitN(arguments->rayhit, size);
    for (unsigned i = 0; i < size; ++i) {
        if (!arguments->valid[i]) continue;
        RTCRayHit query;
        query.ray = rayInBody(instance, rays, size, i);
        query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        embree::searchInside(instance.body().scene.get(), arguments->context, arguments->geomID, query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
        RTCRayN_tfar(rays, size, i) = query.ray.tfar;
        rtcCopyHitToHitN(hits, &query.hit, size, i);
    }
}

void occludedMoving(const RTCOccludedFunctionNArguments* arguments) {
    const auto& instance = *static_cast<const Instance*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (!arguments->valid[i]) continue;
        RTCRay query = rayInBody(instance, arguments->ray, arguments->N, i);
        embree::searchInside(instance.body().scene.get(), arguments->context, arguments->geomID, query);
        if (query.tfar < 0) RTCRayN_tfar(arguments->ray, arguments->N, i) = query.tfar;
    }
}

glm::dmat4 checked(const glm::dmat4& matrix) {
    requireInvertible(matrix, {});
    return matrix;
}

} // namespace

PlacedFrame::PlacedFrame(const glm::dmat4& worldFromBody)
    : linear(worldFromBody), inverseLinear(glm::inverse(linear)), normalMatrix(glm::transpose(inverseLinear)),
      offset(worldFromBody[3]) {}

void PlacedFrame::toWorld(SurfaceHit& hit) const {
    glm::dvec3 local(hit.position), world = linear * local + offset;
    // Rays come to the body's space in float: the error of that, in world space.
    glm::dvec3 sizes = absolute(inverseLinear) * (glm::abs(world) + glm::abs(offset));
    glm::dvec3 localError = glm::dvec3(hit.positionError) + double(gammaBound(5)) * sizes;
    hit.position = world;
    hit.positionError = absolute(linear) * localError + double(gammaBound(2)) * glm::abs(world);
    hit.geometricNormal = glm::normalize(normalMatrix * glm::dvec3(hit.geometricNormal));
    hit.shadingNormal = glm::normalize(normalMatrix * glm::dvec3(hit.shadingNormal));
    hit.dpdu = linear * glm::dvec3(hit.dpdu);
    hit.dpdv = linear * glm::dvec3(hit.dpdv);
}

Instance::Instance(const Body& body, const Placement& placement)
    : body_(&body), still_(checked(placement.at(0))) {
    checked(placement.at(1));
    if (placement.moves())
        moving_ = std::make_unique<Moving>(Moving{placement, movingBounds(placement, body.bounds())});
}

embree::GeometryPointer Instance::makeGeometry(RTCDevice device) const {
    if (moving_) return makeMoving(device);
    auto geometry = embree::newGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry.get(), body_->scene.get());
    glm::mat4 single(glm::mat3(still_.linear));
    single[3] = glm::vec4(glm::vec3(still_.offset), 1);
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &single[0][0]);
    return geometry;
}

embree::GeometryPointer Instance::makeMoving(RTCDevice device) const {
    auto geometry = embree::newGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry.get(), 1);
    rtcSetGeometryTimeStepCount(geometry.get(), unsigned(moving_->stepBounds.size()));
    rtcSetGeometryUserData(geometry.get(), const_cast<Instance*>(this));
    rtcSetGeometryBoundsFunction(geometry.get(), boundsOfMoving, nullptr);
    rtcSetGeometryIntersectFunction(geometry.get(), intersectMoving);
    rtcSetGeometryOccludedFunction(geometry.get(), occludedMoving);
    return geometry;
}

} // namespace slant
