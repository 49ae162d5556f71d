// The direct light of samples, their shadows seen past the shadow rays of their neighbours.
//
// Rays from receivers q to places z on lights are a light field with two planes, as those through a lens are
// (Lehtinen et al. 2011, section 5): the ray of a neighbour passes the line from a sample's point p to a
// place y at the distance |(1 - s) (q - p) + s (z - y)|, a share s of the way to the light. Blockers around
// are between two shares, so whether something is in the way of the line is taken from the ray that passes
// nearest to it at both. A sample looks along several lines, to the places on lights of rays around it.
//
// Needs, declared before the include: texelStartAt(int), the first record of each texel and of one more; of
// the i-th record in the order of texels rayAt(uint), position and how far along the shadow ray something is
// in the way, as a share (0: there is no ray; kUnblocked), lightPlaceAt(uint), directAt(uint),
// normalAt(uint) and halfAt(uint), of which half of the samples it is; raysOf(int), what the rays of a texel
// are. In C++ it is included in a struct that has these, after lib/shading.glsl.
#include "lib/shading.glsl"

/// What is known of the rays in a window.
struct ShadowRays {
    float count, blocked, nearest, farthest; // shares of those blocked
    /// The squared distance of two rays at both shares is x |q - p|^2 + 2 y (q - p)(z - y) + z |z - y|^2,
    /// where at either share 1 is how far the rays around are apart there.
    vec3 metric;
    bool isWide; // kWidePenumbra: the halves of the samples, halfAt, are kept apart
};

/// The texels around one, and the plane of the sample for which their rays were looked at last.
struct ShadowWindow {
    ivec2 first, last;
    int width;    // of all texels
    uint records; // in the window; 0: all rays tell the same, or there are too many
    vec4 receiver, normal;
    ShadowRays rays;
};

/// The ends of lines from a sample, seen from that of its own ray, and what is nearest to them.
struct ShadowLines {
    float x[kShadowLines], y[kShadowLines], z[kShadowLines];
    float nearest[kShadowLines], open[kShadowLines];
};

KERNEL float productOf(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

KERNEL uint rowBegin(IN(ShadowWindow) window, int row) {
    return texelStartAt(row * window.width + window.first.x);
}
KERNEL uint rowEnd(IN(ShadowWindow) window, int row) {
    return texelStartAt(row * window.width + window.last.x + 1);
}

KERNEL uint recordsIn(IN(ShadowWindow) window) {
    uint records = 0u;
    for (int row = window.first.y; row <= window.last.y; ++row)
        records += rowEnd(window, row) - rowBegin(window, row);
    return records;
}

/// The record of a number below window.records.
KERNEL uint recordOf(IN(ShadowWindow) window, uint number) {
    for (int row = window.first.y; row < window.last.y; ++row) {
        const uint begin = rowBegin(window, row), length_ = rowEnd(window, row) - begin;
        if (number < length_) return begin + number;
        number -= length_;
    }
    return rowBegin(window, window.last.y) + number;
}

/// Whether some rays in a window are blocked and some are not.
KERNEL bool isPenumbra(IN(ShadowWindow) window) {
    uint rays = 0u;
    for (int y = window.first.y; y <= window.last.y; ++y)
        for (int x = window.first.x; x <= window.last.x; ++x) rays |= raysOf(y * window.width + x);
    return rays == (kSomeBlocked | kSomeUnblocked);
}

KERNEL ShadowWindow windowAround(int texel, ivec2 size) {
    const ivec2 place = ivec2(texel % size.x, texel / size.x);
    ShadowWindow window = {
        place, place, size.x, 0u, vec4(0.0f), vec4(0.0f), {0.0f, 0.0f, 1.0f, 0.0f, vec3(0.0f), false}};
    bool fits = false;
    for (int reach = kShadowReach; reach >= 0 && !fits; --reach) {
        window.first = max(place - ivec2(reach), ivec2(0));
        window.last = min(place + ivec2(reach), size - ivec2(1));
        window.records = recordsIn(window);
        fits = window.records <= (reach > 0 ? kMaxShadowRays : kMaxOwnShadowRays);
    }
    if (!fits || !isPenumbra(window)) window.records = 0u;
    return window;
}

/// Whether the way from one place to another lies in a surface.
KERNEL bool isWithin(vec3 way, IN(vec4) normal) {
    const float rise = productOf(way, vec3(normal));
    return rise * rise <= kShadowSine * kShadowSine * productOf(way, way);
}

/// Looks at the rays in the window from a record.
KERNEL void lookAround(INOUT(ShadowWindow) window, uint from) {
    window.receiver = rayAt(from);
    window.normal = normalAt(from);
    const vec3 ownLight = lightPlaceAt(from);
    ShadowRays rays = {0.0f, 0.0f, 1.0f, 0.0f, vec3(0.0f), false};
    vec3 mean = vec3(0.0f);
    float receivers = 0.0f, lights = 0.0f;
    for (int row = window.first.y; row <= window.last.y; ++row) {
        const uint end = rowEnd(window, row);
        for (uint i = rowBegin(window, row); i < end; ++i) {
            IN(vec4) ray = rayAt(i);
            const vec3 away = vec3(ray) - vec3(window.receiver);
            if (!(ray.w > 0.0f && isWithin(away, window.normal))) continue;
            const vec3 light = lightPlaceAt(i) - ownLight;
            rays.count += 1.0f;
            receivers += productOf(away, away);
            mean += light;
            lights += productOf(light, light);
            if (!(ray.w < kUnblocked)) continue;
            rays.blocked += 1.0f;
            rays.nearest = min(rays.nearest, ray.w);
            rays.farthest = max(rays.farthest, ray.w);
        }
    }
    mean = mean / max(rays.count, 1.0f);
    receivers = receivers / max(rays.count, 1.0f);
    lights = 2.0f * max(lights / max(rays.count, 1.0f) - productOf(mean, mean), 0.0f);
    for (int i = 0; i < 2; ++i) {
        const float s = i == 0 ? rays.nearest : rays.farthest, r = 1.0f - s;
        const float apart = r * r * receivers + s * s * lights;
        if (apart > 0.0f) rays.metric += vec3(r * r, r * s, s * s) / apart;
    }
    const float s = rays.nearest, r = 1.0f - s;
    rays.isWide = r * r * receivers < kWidePenumbra * s * s * lights;
    window.rays = rays;
}

/// Which of the lines from a record are open: those of the nearest rays.
KERNEL void followLines(IN(ShadowWindow) window, uint from, INOUT(ShadowLines) lines) {
    const vec3 receiver = vec3(rayAt(from)), ownLight = lightPlaceAt(from), metric = window.rays.metric;
    const uint half_ = halfAt(from);
    for (int row = window.first.y; row <= window.last.y; ++row) {
        const uint end = rowEnd(window, row);
        for (uint i = rowBegin(window, row); i < end; ++i) {
            IN(vec4) ray = rayAt(i);
            const vec3 away = vec3(ray) - receiver;
            if (!(ray.w > 0.0f && isWithin(away, window.normal))) continue;
            if (window.rays.isWide && halfAt(i) != half_) continue;
            const vec3 light = lightPlaceAt(i) - ownLight, slant = (2.0f * metric.y) * away;
            const float near_ = metric.x * productOf(away, away), open = ray.w < kUnblocked ? 0.0f : 1.0f;
            for (int k = 0; k < kShadowLines; ++k) {
                const float x = light.x - lines.x[k], y = light.y - lines.y[k], z = light.z - lines.z[k];
                const float far_ = slant.x * x + slant.y * y + slant.z * z;
                const float distance2 = near_ + far_ + metric.z * (x * x + y * y + z * z);
                const bool isNearer = distance2 < lines.nearest[k];
                lines.nearest[k] = isNearer ? distance2 : lines.nearest[k];
                lines.open[k] = isNearer ? open : lines.open[k];
            }
        }
    }
}

/// Share of the direct light that arrives at a record along the lines; the first of them is its own ray, the
/// others are spread over the window. `random`: which others.
KERNEL vec3 arrivingShare(IN(ShadowWindow) window, uint from, uint random) {
    ShadowLines lines;
    vec3 direct[kShadowLines];
    const vec3 ownLight = lightPlaceAt(from);
    const uint others = uint(kShadowLines - 1), offset = random % max(window.records / others, 1u);
    for (int k = 0; k < kShadowLines; ++k) {
        uint other = from;
        if (k > 0) {
            const uint number = uint(k - 1) * window.records / others + offset;
            other = recordOf(window, number % window.records);
            if (window.rays.isWide && halfAt(other) != halfAt(from))
                other = recordOf(window, (number + 1u) % window.records);
        }
        IN(vec4) ray = rayAt(other);
        const bool isLine = ray.w > 0.0f && isWithin(vec3(ray) - vec3(window.receiver), window.normal) &&
                            !(window.rays.isWide && halfAt(other) != halfAt(from));
        const vec3 light = lightPlaceAt(other) - ownLight;
        lines.x[k] = light.x;
        lines.y[k] = light.y;
        lines.z[k] = light.z;
        lines.nearest[k] = kInfinity;
        lines.open[k] = 0.0f;
        direct[k] = isLine ? directAt(other) : vec3(0.0f);
    }
    followLines(window, from, lines);
    vec3 arrives = vec3(0.0f), all = vec3(0.0f);
    for (int k = 0; k < kShadowLines; ++k) {
        all += direct[k];
        arrives += lines.open[k] * direct[k];
    }
    return vec3(all.x > 0.0f ? arrives.x / all.x : 0.0f, all.y > 0.0f ? arrives.y / all.y : 0.0f,
                all.z > 0.0f ? arrives.z / all.z : 0.0f);
}

/// Illumination of a record in the middle of a window, with the shadow that its neighbours see.
KERNEL vec3 withSoftShadow(vec3 illumination, INOUT(ShadowWindow) window, uint record, uint random) {
    IN(vec4) ray = rayAt(record);
    if (window.records == 0u || !(ray.w > 0.0f)) return illumination;
    const bool isKnown = window.rays.count > 0.0f &&
                         productOf(vec3(normalAt(record)), vec3(window.normal)) > kShadowCosine &&
                         isWithin(vec3(ray) - vec3(window.receiver), window.normal);
    if (!isKnown) lookAround(window, record);
    if (window.rays.count < kFewestShadowRays * float(window.records) || window.rays.blocked == 0.0f ||
        window.rays.blocked == window.rays.count)
        return illumination;
    const vec3 direct = directAt(record);
    const vec3 arrived = ray.w < kUnblocked ? vec3(0.0f) : direct;
    return max(illumination - arrived, vec3(0.0f)) + arrivingShare(window, record, random) * direct;
}
