#include "trace/emitter.h"

namespace slant {
namespace {

/// Triangles are sampled by solid angle where it lies in this range and the receiver is near; else by area.
constexpr float kMinSolidAngle = 1e-3f, kMaxSolidAngle = 6.2f;

/// The triangle as seen from a point: unit vectors to its corners and its solid angle.
struct SphericalTriangle {
    glm::vec3 a, b, c;
    float solidAngle;
};

/// False if the triangle is to be sampled by area from here.
bool seenNearby(const Emitter& e, glm::vec3 from, SphericalTriangle& t) {
    glm::vec3 a = e.origin - from;
    glm::vec3 centroid = a + (e.edge1 + e.edge2) / 3.f;
    if (glm::dot(centroid, centroid) > e.size2) return false;
    t.a = glm::normalize(a);
    t.b = glm::normalize(a + e.edge1);
    t.c = glm::normalize(a + e.edge2);
    // Van Oosterom and Strackee 1983, "The Solid Angle of a Plane Triangle".
    float volume = std::abs(glm::dot(t.a, glm::cross(t.b, t.c)));
    float denominator = 1 + glm::dot(t.a, t.b) + glm::dot(t.b, t.c) + glm::dot(t.c, t.a);
    t.solidAngle = 2 * std::atan2(volume, denominator);
    return t.solidAngle > kMinSolidAngle && t.solidAngle < kMaxSolidAngle;
}

float angleBetween(glm::vec3 a, glm::vec3 b) {
    return std::acos(std::clamp(glm::dot(a, b) / std::sqrt(glm::dot(a, a) * glm::dot(b, b)), -1.f, 1.f));
}

/// Arvo 1995, "Stratified Sampling of Spherical Triangles".
glm::vec3 sampleSphericalTriangle(const SphericalTriangle& t, glm::vec2 u) {
    float alpha = angleBetween(glm::cross(t.a, t.b), glm::cross(t.a, t.c));
    float cosAlpha = std::cos(alpha), sinAlpha = std::sin(alpha), cosC = glm::dot(t.a, t.b);
    float phi = u.x * t.solidAngle - alpha;
    float s = std::sin(phi), k = std::cos(phi);
    float p = k - cosAlpha, q = s + sinAlpha * cosC;
    float denominator = (q * s + p * k) * sinAlpha;
    float cosB =
        denominator == 0 ? 1.f : std::clamp(((q * k - p * s) * cosAlpha - q) / denominator, -1.f, 1.f);
    glm::vec3 acrossA = glm::normalize(t.c - glm::dot(t.c, t.a) * t.a);
    glm::vec3 corner = cosB * t.a + std::sqrt(std::max(0.f, 1 - cosB * cosB)) * acrossA;
    float z = 1 - u.y * (1 - glm::dot(corner, t.b));
    glm::vec3 acrossB = corner - glm::dot(corner, t.b) * t.b;
    float length2 = glm::dot(acrossB, acrossB);
    if (length2 == 0) return t.b;
    return glm::normalize(z * t.b + std::sqrt(std::max(0.f, 1 - z * z)) / std::sqrt(length2) * acrossB);
}

/// Fills `sample` for a point of the emitter that was chosen with density `areaPdf` over its area.
bool towards(const Emitter& e, const Receiver& receiver, glm::vec3 point, glm::vec3 normal, float areaPdf,
             LightSample& sample) {
    glm::vec3 d = point - receiver.position;
    float distance2 = glm::dot(d, d);
    if (!(distance2 > 0)) return false;
    sample.distance = std::sqrt(distance2);
    sample.direction = d / sample.distance;
    float cosine = -glm::dot(sample.direction, normal);
    if (e.twoSided) cosine = std::abs(cosine);
    if (!(cosine > 0)) return false;
    sample.pdf = areaPdf * distance2 / cosine;
    sample.radiance = e.radiance;
    sample.delta = false;
    sample.bounded = e.bounded();
    return true;
}

bool samplePoint(const Emitter& e, const Receiver& receiver, LightSample& sample) {
    glm::vec3 d = e.origin - receiver.position;
    float distance2 = glm::dot(d, d);
    if (!(distance2 > 0)) return false;
    sample.distance = std::sqrt(distance2);
    sample.direction = d / sample.distance;
    sample.radiance = e.radiance / distance2;
    if (e.profile) sample.radiance *= e.profile->intensity(-sample.direction);
    sample.pdf = 1;
    sample.delta = sample.bounded = true;
    return true;
}

bool sampleTriangle(const Emitter& e, const Receiver& receiver, glm::vec2 u, LightSample& sample) {
    SphericalTriangle seen;
    if (!seenNearby(e, receiver.position, seen)) {
        glm::vec2 b = warpToTriangle(u);
        return towards(e, receiver, e.origin + b.x * e.edge1 + b.y * e.edge2, e.normal, 1 / e.area, sample);
    }
    float height = glm::dot(e.origin - receiver.position, e.normal);
    if (height >= 0 && !e.twoSided) return false;
    sample.direction = sampleSphericalTriangle(seen, u);
    float cosine = glm::dot(sample.direction, e.normal);
    sample.distance = height / cosine;
    if (!(sample.distance > 0)) return false;
    sample.radiance = e.radiance;
    sample.pdf = 1 / seen.solidAngle;
    sample.delta = false;
    sample.bounded = true;
    return true;
}

glm::vec3 patchCross(const Emitter& e, glm::vec2 uv) {
    return glm::cross(e.edge1 + uv.y * e.twist, e.edge2 + uv.x * e.twist);
}

/// (u, v) of a point of the patch, by Gauss-Newton iteration.
glm::vec2 patchCoordinates(const Emitter& e, glm::vec3 point) {
    glm::vec2 uv(0.5f);
    for (int i = 0; i < 6; ++i) {
        glm::vec3 du = e.edge1 + uv.y * e.twist, dv = e.edge2 + uv.x * e.twist;
        glm::vec3 rest = point - (e.origin + uv.x * e.edge1 + uv.y * e.edge2 + uv.x * uv.y * e.twist);
        float a = glm::dot(du, du), b = glm::dot(du, dv), c = glm::dot(dv, dv), determinant = a * c - b * b;
        if (!(determinant > 0)) break;
        float p = glm::dot(du, rest), q = glm::dot(dv, rest);
        uv = glm::clamp(uv + glm::vec2(c * p - b * q, a * q - b * p) / determinant, 0.f, 1.f);
    }
    return uv;
}

bool samplePatch(const Emitter& e, const Receiver& receiver, glm::vec2 u, LightSample& sample) {
    glm::vec3 n = patchCross(e, u);
    float areaElement = glm::length(n);
    if (!(areaElement > 0)) return false;
    glm::vec3 point = e.origin + u.x * e.edge1 + u.y * e.edge2 + u.x * u.y * e.twist;
    return towards(e, receiver, point, e.side * n / areaElement, 1 / areaElement, sample);
}

/// The cone of directions in which a sphere is seen from outside: 1 - cos of its half angle.
float coneHeight(float sin2) {
    return sin2 / (1 + std::sqrt(std::max(0.f, 1 - sin2)));
}

bool sampleSphere(const Emitter& e, const Receiver& receiver, glm::vec2 u, LightSample& sample) {
    glm::vec3 d = e.origin - receiver.position;
    float distance2 = glm::dot(d, d), radius2 = e.radius * e.radius;
    bool outside = distance2 > radius2;
    if (!e.twoSided && outside != (e.side > 0)) return false;
    if (outside) {
        float sin2Max = radius2 / distance2, height = coneHeight(sin2Max);
        float below = u.x * height, cosine = 1 - below, sin2 = below * (2 - below);
        float sine = std::sqrt(std::max(0.f, sin2)), phi = 2 * kPi * u.y, distance = std::sqrt(distance2);
        Frame frame = Frame::around(d / distance);
        sample.direction =
            glm::normalize(frame.toWorld({sine * std::cos(phi), sine * std::sin(phi), cosine}));
        sample.distance = distance * (cosine - std::sqrt(std::max(0.f, sin2Max - sin2)));
        sample.pdf = 1 / (2 * kPi * height);
    } else { // every direction meets it
        sample.direction = warpToSphere(u);
        float along = glm::dot(d, sample.direction);
        sample.distance = along + std::sqrt(std::max(0.f, radius2 - distance2 + along * along));
        sample.pdf = 1 / (4 * kPi);
    }
    sample.radiance = e.radiance;
    sample.delta = false;
    sample.bounded = true;
    return sample.distance > 0;
}

/// World-space normal (of length |det| |M^-T n|) and with it the area element of a unit of object-space area.
glm::vec3 worldNormal(const EmitterQuadric& q, glm::vec3 objectNormal) {
    glm::mat3 m(q.worldFromObject);
    return std::abs(glm::determinant(m)) * (glm::transpose(glm::mat3(q.objectFromWorld)) * objectNormal);
}

/// Of length 1, but 0 at the tip of a cone.
glm::vec3 objectNormalAt(const EmitterQuadric& q, glm::vec3 objectPoint) {
    if (!q.profile) return {0, 0, 1};
    const glm::vec3 n(q.profile->normalAt(glm::dvec3(objectPoint)));
    const float length = glm::length(n);
    return length > 0 ? n / length : n;
}

/// Of objectPoint, over the area in object space.
float objectPdf(const EmitterQuadric& q, glm::vec3 objectPoint) {
    if (!q.profile) return 2 / (q.phiMax * (q.radius * q.radius - q.innerRadius * q.innerRadius));
    const Profile& f = *q.profile;
    return float(1 / (f.phiMax * (f.highZ() - f.lowZ()) * f.areaElement(double(objectPoint.z))));
}

/// Evenly over a disk, and over the z and the angles of what turns, so evenly over spheres and cylinders.
glm::vec3 objectPoint(const EmitterQuadric& q, glm::vec2 u) {
    if (q.profile)
        return q.profile->point(glm::mix(q.profile->lowZ(), q.profile->highZ(), double(u.x)),
                                q.profile->phiMax * double(u.y));
    const float phi = q.phiMax * u.y;
    const float r = std::sqrt(glm::mix(q.innerRadius * q.innerRadius, q.radius * q.radius, u.x));
    return {r * std::cos(phi), r * std::sin(phi), q.height};
}

bool sampleQuadric(const Emitter& e, const EmitterQuadric& q, const Receiver& receiver, glm::vec2 u,
                   LightSample& sample) {
    glm::vec3 local = objectPoint(q, u);
    glm::vec3 n = worldNormal(q, objectNormalAt(q, local));
    float areaElement = glm::length(n);
    if (!(areaElement > 0)) return false;
    return towards(e, receiver, glm::vec3(q.worldFromObject * glm::vec4(local, 1)), e.side * n / areaElement,
                   objectPdf(q, local) / areaElement, sample);
}

} // namespace

float quadricArea(const EmitterQuadric& q) {
    constexpr int kSteps = 64;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const glm::vec3 local = objectPoint(q, (glm::vec2(i, j) + 0.5f) / float(kSteps));
            sum += double(glm::length(worldNormal(q, objectNormalAt(q, local))) / objectPdf(q, local));
        }
    return float(sum / (kSteps * kSteps));
}

bool sampleEmitter(const Emitter& e, std::span<const EmitterQuadric> quadrics, const Receiver& receiver,
                   glm::vec2 u, LightSample& sample) {
    switch (e.shape) {
    case Emitter::Shape::point:
        return samplePoint(e, receiver, sample);
    case Emitter::Shape::triangle:
        return sampleTriangle(e, receiver, u, sample);
    case Emitter::Shape::patch:
        return samplePatch(e, receiver, u, sample);
    case Emitter::Shape::sphere:
        return sampleSphere(e, receiver, u, sample);
    case Emitter::Shape::quadric:
        return sampleQuadric(e, quadrics[std::size_t(e.quadric)], receiver, u, sample);
    }
    return false;
}

float emitterPdf(const Emitter& e, std::span<const EmitterQuadric> quadrics, const Receiver& receiver,
                 glm::vec3 direction, glm::vec3 position, glm::vec3 normal) {
    glm::vec3 d = position - receiver.position;
    float fromArea = glm::dot(d, d) / std::max(std::abs(glm::dot(direction, normal)), 1e-12f);
    switch (e.shape) {
    case Emitter::Shape::point:
        return 0;
    case Emitter::Shape::triangle: {
        SphericalTriangle seen;
        return seenNearby(e, receiver.position, seen) ? 1 / seen.solidAngle : fromArea / e.area;
    }
    case Emitter::Shape::patch:
        return fromArea / glm::length(patchCross(e, patchCoordinates(e, position)));
    case Emitter::Shape::sphere: {
        glm::vec3 toCentre = e.origin - receiver.position;
        float distance2 = glm::dot(toCentre, toCentre), radius2 = e.radius * e.radius;
        return distance2 > radius2 ? 1 / (2 * kPi * coneHeight(radius2 / distance2)) : 1 / (4 * kPi);
    }
    case Emitter::Shape::quadric: {
        const EmitterQuadric& q = quadrics[std::size_t(e.quadric)];
        glm::vec3 local(q.objectFromWorld * glm::vec4(position, 1));
        return fromArea * objectPdf(q, local) / glm::length(worldNormal(q, objectNormalAt(q, local)));
    }
    }
    return 0;
}

} // namespace slant
