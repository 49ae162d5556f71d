#include "trace/light_tree.h"

#include <numeric>

namespace slant {
namespace {

float sineOf(float cosine) {
    return std::sqrt(std::max(0.f, 1 - cosine * cosine));
}

/// cos(max(0, a - b)) from the cosines and sines of a and b.
float cosineOfDifference(float cosA, float sinA, float cosB, float sinB) {
    return cosA > cosB ? 1.f : cosA * cosB + sinA * sinB;
}

/// sin(max(0, a - b)).
float sineOfDifference(float cosA, float sinA, float cosB, float sinB) {
    return cosA > cosB ? 0.f : sinA * cosB - cosA * sinB;
}

} // namespace

LightBounds LightBounds::join(const LightBounds& a, const LightBounds& b) {
    LightBounds r;
    r.low = glm::min(a.low, b.low);
    r.high = glm::max(a.high, b.high);
    r.twoSided = a.twoSided || b.twoSided;
    r.intensity = a.intensity + b.intensity;
    // Cone around both cones.
    float spreadA = std::acos(a.cosineSpread), spreadB = std::acos(b.cosineSpread);
    float between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.f, 1.f));
    if (std::min(between + spreadB, kPi) <= spreadA) {
        r.axis = a.axis;
        r.cosineSpread = a.cosineSpread;
        return r;
    }
    if (std::min(between + spreadA, kPi) <= spreadB) {
        r.axis = b.axis;
        r.cosineSpread = b.cosineSpread;
        return r;
    }
    float spread = (spreadA + between + spreadB) / 2;
    glm::vec3 across = b.axis - glm::dot(a.axis, b.axis) * a.axis;
    float length2 = glm::dot(across, across);
    r.axis = a.axis;
    r.cosineSpread = -1;
    if (spread >= kPi || !(length2 > 1e-12f)) return r;
    float turn = spread - spreadA;
    r.axis = glm::normalize(std::cos(turn) * a.axis + std::sin(turn) / std::sqrt(length2) * across);
    r.cosineSpread = std::cos(spread);
    return r;
}

LightTree::LightTree(const std::vector<LightBounds>& bounds) : leafOf_(bounds.size()) {
    if (bounds.empty()) return;
    nodes_.reserve(2 * bounds.size());
    std::vector<int> order(bounds.size());
    std::iota(order.begin(), order.end(), 0);
    build(bounds, order.data(), order.data() + order.size(), -1);
}

int LightTree::build(const std::vector<LightBounds>& bounds, int* first, int* last, int parent) {
    LightBounds all = bounds[std::size_t(*first)];
    auto centre = [&](int i) { return 0.5f * (bounds[std::size_t(i)].low + bounds[std::size_t(i)].high); };
    glm::vec3 low = centre(*first), high = low;
    for (int* i = first + 1; i < last; ++i) {
        all = LightBounds::join(all, bounds[std::size_t(*i)]);
        low = glm::min(low, centre(*i));
        high = glm::max(high, centre(*i));
    }
    int index = int(nodes_.size());
    Node node{0.5f * (all.low + all.high),
              0.5f * glm::length(all.high - all.low),
              all.axis,
              all.cosineSpread,
              sineOf(all.cosineSpread),
              all.intensity,
              all.twoSided,
              -1,
              0,
              parent};
    if (last - first == 1) {
        node.emitter = *first;
        leafOf_[std::size_t(*first)] = index;
    }
    nodes_.push_back(node);
    if (last - first == 1) return index;
    glm::vec3 extent = high - low;
    int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    int* middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, [&](int a, int b) {
        float ca = centre(a)[axis], cb = centre(b)[axis];
        return ca != cb ? ca < cb : a < b;
    });
    build(bounds, first, middle, index);
    nodes_[std::size_t(index)].second = build(bounds, middle, last, index);
    return index;
}

float LightTree::importance(const Node& node, const Receiver& receiver) {
    glm::vec3 d = node.centre - receiver.position;
    float distance2 = glm::dot(d, d), radius2 = node.radius * node.radius;
    if (distance2 <= radius2) return node.intensity / radius2;
    float inverse = 1 / std::sqrt(distance2);
    glm::vec3 w = d * inverse;
    // The group is seen within this angle around w.
    float sinBounds = node.radius * inverse, cosBounds = std::sqrt(std::max(0.f, 1 - sinBounds * sinBounds));
    float cosReceiver = glm::dot(receiver.normal, w);
    float cosIncident = cosineOfDifference(cosReceiver, sineOf(cosReceiver), cosBounds, sinBounds);
    if (!(cosIncident > 0)) return 0;
    float cosEmitted = 1;
    if (node.cosineSpread > -1) {
        float cosAxis = -glm::dot(node.axis, w);
        if (node.twoSided) cosAxis = std::abs(cosAxis);
        float sinAxis = sineOf(cosAxis);
        float cosLess = cosineOfDifference(cosAxis, sinAxis, node.cosineSpread, node.sineSpread);
        float sinLess = sineOfDifference(cosAxis, sinAxis, node.cosineSpread, node.sineSpread);
        cosEmitted = cosineOfDifference(cosLess, sinLess, cosBounds, sinBounds);
        if (!(cosEmitted > 0)) return 0;
    }
    return node.intensity * cosIncident * cosEmitted * inverse * inverse;
}

int LightTree::sample(const Receiver& receiver, float& u, float& chance) const {
    chance = 1;
    if (nodes_.empty()) return -1;
    std::size_t at = 0;
    while (nodes_[at].emitter < 0) {
        std::size_t second = std::size_t(nodes_[at].second);
        float a = importance(nodes_[at + 1], receiver), b = importance(nodes_[second], receiver);
        if (!(a + b > 0)) return -1;
        float p = a / (a + b);
        if (u < p) {
            u = std::min(u / p, 0x1.fffffep-1f);
            chance *= p;
            at = at + 1;
        } else {
            u = std::min((u - p) / (1 - p), 0x1.fffffep-1f);
            chance *= 1 - p;
            at = second;
        }
    }
    return nodes_[at].emitter;
}

float LightTree::chance(const Receiver& receiver, int emitter) const {
    float chance = 1;
    int at = leafOf_[std::size_t(emitter)];
    for (int parent = nodes_[std::size_t(at)].parent; parent >= 0;
         at = parent, parent = nodes_[std::size_t(at)].parent) {
        const Node& node = nodes_[std::size_t(parent)];
        float a = importance(nodes_[std::size_t(parent) + 1], receiver);
        float b = importance(nodes_[std::size_t(node.second)], receiver);
        if (!(a + b > 0)) return 0;
        float p = a / (a + b);
        chance *= at == parent + 1 ? p : 1 - p;
    }
    return chance;
}

} // namespace slant
