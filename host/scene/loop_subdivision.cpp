#include "scene/loop_subdivision.h"

#include <algorithm>
#include <map>
#include <numbers>

namespace slant {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The neighbours of a vertex, in the order of its triangles' corners; of one on a boundary, from its one end
/// to the other.
struct Ring {
    std::vector<std::uint32_t> vertices;
    bool boundary = false;
};

[[noreturn]] void refuse(const FileLocation& where) {
    throw badInput(where,
                   "the triangles of a loopsubdiv must form a surface: each edge belongs to one or two of "
                   "them that are turned alike, and those around a corner hang together");
}

/// Of one vertex, whose triangles lead from each neighbour to the next.
Ring ringOf(const std::map<std::uint32_t, std::uint32_t>& next, const FileLocation& where) {
    Ring ring;
    std::map<std::uint32_t, int> arrivals;
    for (const auto& [from, to] : next)
        if (++arrivals[to] > 1) refuse(where);
    std::uint32_t at = next.begin()->first;
    for (const auto& [from, to] : next)
        if (!arrivals.contains(from)) {
            at = from;
            ring.boundary = true;
        }
    for (std::size_t i = 0; i < next.size(); ++i) {
        ring.vertices.push_back(at);
        const auto step = next.find(at);
        if (step == next.end()) refuse(where);
        at = step->second;
    }
    if (ring.boundary)
        ring.vertices.push_back(at);
    else if (at != ring.vertices.front())
        refuse(where);
    if (ring.vertices.size() != next.size() + ring.boundary) refuse(where);
    return ring;
}

std::vector<Ring> ringsOf(const Mesh& mesh, const FileLocation& where) {
    std::vector<std::map<std::uint32_t, std::uint32_t>> next(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto corner = [&](std::size_t j) { return mesh.indices[i + (k + j) % 3]; };
            if (!next[corner(0)].try_emplace(corner(1), corner(2)).second) refuse(where);
        }
    std::vector<Ring> rings(next.size());
    for (std::size_t i = 0; i < next.size(); ++i)
        if (!next[i].empty()) rings[i] = ringOf(next[i], where);
    return rings;
}

/// The vertex and its ring, each neighbour (on a boundary: the two at its ends) with weight `weight`.
glm::vec3 weighted(const Mesh& mesh, std::size_t vertex, const Ring& ring, float weight) {
    const auto at = [&](std::uint32_t i) { return mesh.positions[i]; };
    if (ring.boundary)
        return (1 - 2 * weight) * mesh.positions[vertex] +
               weight * (at(ring.vertices.front()) + at(ring.vertices.back()));
    glm::vec3 sum = (1 - float(ring.vertices.size()) * weight) * mesh.positions[vertex];
    for (const std::uint32_t i : ring.vertices) sum += weight * at(i);
    return sum;
}

/// Of each neighbour in a step.
float stepWeight(const Ring& ring) {
    if (ring.boundary) return 1.f / 8;
    const auto valence = float(ring.vertices.size());
    return valence == 3 ? 3.f / 16 : 3 / (8 * valence);
}

Mesh subdivided(const Mesh& mesh, const FileLocation& where) {
    const std::vector<Ring> rings = ringsOf(mesh, where);
    Mesh result;
    for (std::size_t i = 0; i < rings.size(); ++i)
        result.positions.push_back(rings[i].vertices.empty()
                                       ? mesh.positions[i]
                                       : weighted(mesh, i, rings[i], stepWeight(rings[i])));
    struct Middle {
        std::uint32_t vertex, opposite;
    };
    std::map<Edge, Middle> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t opposite) {
        const auto [found, isNew] =
            middles.try_emplace(std::minmax(a, b), Middle{std::uint32_t(result.positions.size()), opposite});
        const glm::vec3 ends = mesh.positions[a] + mesh.positions[b];
        if (isNew)
            result.positions.push_back(0.5f * ends);
        else
            result.positions[found->second.vertex] =
                3.f / 8 * ends +
                1.f / 8 * (mesh.positions[opposite] + mesh.positions[found->second.opposite]);
        return found->second.vertex;
    };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const std::uint32_t ab = middle(a, b, c), bc = middle(b, c, a), ca = middle(c, a, b);
        result.indices.insert(result.indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    return result;
}

/// Tangents of the limit surface, in double precision: the sums cancel.
glm::vec3 normalAt(const Mesh& mesh, std::size_t vertex, const Ring& ring) {
    const std::size_t valence = ring.vertices.size();
    const auto at = [&](std::size_t k) { return glm::dvec3(mesh.positions[ring.vertices[k]]); };
    const glm::dvec3 here(mesh.positions[vertex]);
    glm::dvec3 along(0), across(0);
    if (!ring.boundary) {
        for (std::size_t k = 0; k < valence; ++k) {
            const double angle = 2 * std::numbers::pi * double(k) / double(valence);
            along += std::cos(angle) * at(k);
            across += std::sin(angle) * at(k);
        }
        return glm::cross(across, along);
    }
    along = at(valence - 1) - at(0);
    if (valence == 2) {
        across = at(0) + at(1) - 2.0 * here;
    } else if (valence == 3) {
        across = at(1) - here;
    } else if (valence == 4) {
        across = 2.0 * (at(1) + at(2)) - at(0) - at(3) - 2.0 * here;
    } else {
        const double angle = std::numbers::pi / double(valence - 1);
        across = -std::sin(angle) * (at(0) + at(valence - 1));
        for (std::size_t k = 1; k + 1 < valence; ++k)
            across += (2 - 2 * std::cos(angle)) * std::sin(double(k) * angle) * at(k);
    }
    return glm::cross(along, across);
}

} // namespace

Mesh loopSubdivided(const Mesh& control, int levels, const FileLocation& where) {
    Mesh mesh{Mesh::Kind::triangles, control.positions, {}, {}, control.indices};
    for (int i = 0; i < levels; ++i) mesh = subdivided(mesh, where);
    const std::vector<Ring> rings = ringsOf(mesh, where);
    Mesh limit = mesh;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        if (rings[i].vertices.empty()) continue;
        const float weight = rings[i].boundary
                                 ? 1.f / 5
                                 : 1 / (float(rings[i].vertices.size()) + 3 / (8 * stepWeight(rings[i])));
        limit.positions[i] = weighted(mesh, i, rings[i], weight);
    }
    for (std::size_t i = 0; i < rings.size(); ++i)
        limit.normals.push_back(rings[i].vertices.empty() ? glm::vec3(0, 0, 1)
                                                          : normalAt(limit, i, rings[i]));
    return limit;
}

} // namespace slant
