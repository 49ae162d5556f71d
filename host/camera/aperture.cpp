#include "camera/aperture.h"

#include "lib/disc.glsl"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slant {
namespace {

constexpr int kSectors = ApertureShape::kSectors, kRings = ApertureShape::kRings;
constexpr float kTurn = 2 * std::numbers::pi_v<float>;

void appendCumulative(std::vector<float>& table, std::span<const double> weights) {
    double total = 0, sum = 0;
    for (const double weight : weights) total += weight;
    table.push_back(0);
    for (const double weight : weights) {
        sum += weight;
        table.push_back(total > 0 ? float(sum / total) : 0);
    }
}

std::vector<float> tableOf(const ApertureShape& shape) {
    if (!shape.rim.empty()) {
        std::vector<float> table{float(shape.rim.size())};
        for (std::size_t i = 0; i <= shape.rim.size(); ++i) {
            const glm::dvec2 p = shape.rim[i % shape.rim.size()];
            table.insert(table.end(), {float(p.x), float(p.y)});
        }
        return table;
    }
    if (shape.weights.empty()) return {0};
    std::vector<double> light, sectors;
    for (std::size_t i = 0; i < shape.weights.size(); ++i) {
        const auto ring = double(i % kRings);
        light.push_back(shape.weights[i] * (2 * ring + 1)); // times the area of the cell
        if (i % kRings == 0) sectors.push_back(0);
        sectors.back() += light.back();
    }
    std::vector<float> table{-1};
    appendCumulative(table, sectors);
    for (std::size_t i = 0; i < light.size(); i += kRings)
        appendCumulative(table, std::span(light).subspan(i, kRings));
    return table;
}

/// What lib/aperture.glsl makes of a table.
struct ApertureKernels {
    const float* table;

    float apertureAt(int i) const { return table[i]; }
#include "lib/aperture.glsl"
};

void add(LensBox& box, vec2 p) {
    box.min = glm::min(box.min, p);
    box.max = glm::max(box.max, p);
}

} // namespace

Aperture::Aperture(ApertureShape shape) {
    std::vector<float> table = tableOf(shape);
    data_ = std::make_shared<const Data>(Data{std::move(shape), std::move(table)});
}

vec2 Aperture::at(vec2 square) const {
    return ApertureKernels{data_->table.data()}.lensPosition(square);
}

float Aperture::transmission(vec2 lens) const {
    const ApertureShape& shape = data_->shape;
    if (!shape.weights.empty()) {
        const float radius = glm::length(lens), turn = std::atan2(lens.y, lens.x) / kTurn;
        if (radius > 1) return 0;
        const int sector = glm::min(int((turn < 0 ? turn + 1 : turn) * float(kSectors)), kSectors - 1);
        const int ring = glm::min(int(radius * float(kRings)), kRings - 1);
        return float(shape.weights[std::size_t(sector * kRings + ring)]) / 255;
    }
    if (shape.rim.empty()) return glm::dot(lens, lens) <= 1 ? 1.f : 0.f;
    const auto cross = [](vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; };
    for (int i = 0; i < int(shape.rim.size()); ++i) {
        const vec2 a = corner(i), b = corner(i + 1);
        const float area = cross(a, b), nearA = cross(lens, b) / area, nearB = cross(a, lens) / area;
        if (nearA >= 0 && nearB >= 0 && nearA + nearB <= 1) return 1;
    }
    return 0;
}

double Aperture::meanTransmission() const {
    const ApertureShape& shape = data_->shape;
    double area = std::numbers::pi;
    if (!shape.rim.empty()) {
        const glm::dvec2 a = shape.rim[0], b = shape.rim[1];
        area = std::abs(a.x * b.y - a.y * b.x) / 2 * double(shape.rim.size());
    } else if (!shape.weights.empty()) {
        double sum = 0;
        for (std::size_t i = 0; i < shape.weights.size(); ++i)
            sum += shape.weights[i] / 255.0 * double(2 * (i % kRings) + 1);
        area *= sum / (double(kSectors) * kRings * kRings);
    }
    return area / std::numbers::pi;
}

double shareOutside(const Aperture& aperture, float scale, const Aperture& other) {
    constexpr int kSteps = 200;
    constexpr float kInwards = 0.999f; // keeps the rim of a shape inside it despite rounding
    int outside = 0;
    for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < kSteps; ++i) {
            const vec2 p = aperture.at((vec2(i, j) + 0.5f) * (2.f / kSteps) - 1.f);
            outside += other.transmission(kInwards * scale * p) == 0;
        }
    return double(outside) / (kSteps * kSteps);
}

LensBox Aperture::box(vec2 squareMin, vec2 squareMax) const {
    const float kind = data_->table[0];
    if (kind > 0) return outlineBox(squareMin, squareMax);
    if (kind < 0) return weightsBox(squareMin, squareMax);
    // Curved sides are sampled, and the box is padded by more than the curve deviates between two samples.
    constexpr int steps = 32;
    LensBox box{vec2(2), vec2(-2)};
    for (int j = 0; j <= steps; ++j)
        for (int i = 0; i <= steps; ++i)
            add(box, concentricDisc(glm::mix(squareMin, squareMax, vec2(float(i), float(j)) / float(steps))));
    const vec2 pad = (box.max - box.min) * 0.01f;
    return {box.min - pad, box.max + pad};
}

/// The map is linear between the rays along which its triangles meet or its diagonals lie, so extremes are at
/// corners of the rectangle and where such a ray enters or leaves it.
LensBox Aperture::outlineBox(vec2 squareMin, vec2 squareMax) const {
    LensBox box{vec2(2), vec2(-2)};
    for (const float x : {squareMin.x, squareMax.x})
        for (const float y : {squareMin.y, squareMax.y}) add(box, at({x, y}));
    std::vector<float> turns{0.125f, 0.375f, 0.625f, 0.875f};
    const int corners = int(data_->table[0]);
    for (int i = 0; i < corners; ++i) turns.push_back(float(i) / float(corners));
    for (const float turn : turns) {
        const vec2 ray = squareOf({1, turn});
        float enter = 0, leave = 1;
        for (int axis = 0; axis < 2; ++axis) {
            const float low = squareMin[axis], high = squareMax[axis];
            if (ray[axis] != 0) {
                enter = glm::max(enter, glm::min(low / ray[axis], high / ray[axis]));
                leave = glm::min(leave, glm::max(low / ray[axis], high / ray[axis]));
            } else if (low > 0 || high < 0) {
                leave = -1;
            }
        }
        if (enter > leave) continue;
        add(box, at(enter * ray));
        add(box, at(leave * ray));
    }
    constexpr float kRounding = 1e-6f;
    return {box.min - kRounding, box.max + kRounding};
}

/// Turns and distances grow with those of the square, but each sector has rings of its own.
LensBox Aperture::weightsBox(vec2 squareMin, vec2 squareMax) const {
    const vec2 nearest = glm::max(glm::max(squareMin, -squareMax), vec2(0));
    const vec2 farthest = glm::max(glm::abs(squareMin), glm::abs(squareMax));
    const float distanceMin = glm::max(nearest.x, nearest.y), distanceMax = glm::max(farthest.x, farthest.y);
    const auto lightOf = [](float distance) { return glm::min(distance * distance, kLastBelowOne); };
    float turnMin = 1, turnMax = 0;
    for (const float x : {squareMin.x, squareMax.x})
        for (const float y : {squareMin.y, squareMax.y}) {
            if (x == 0 && y == 0) continue; // of every turn, but its sides are not
            const float turn = polarOf({x, y}).turn;
            const bool whole = turn == 0 && squareMax.y <= 0; // one turn, if the rectangle lies before it
            turnMin = glm::min(turnMin, whole ? kLastBelowOne : turn);
            turnMax = glm::max(turnMax, whole ? kLastBelowOne : turn);
        }
    if (squareMin.y < 0 && squareMax.y > 0 && squareMax.x > 0) turnMin = 0, turnMax = kLastBelowOne;

    ApertureKernels kernels{data_->table.data()};
    const int first = kernels.entryAt(1, kSectors, turnMin), last = kernels.entryAt(1, kSectors, turnMax);
    LensBox box{vec2(2), vec2(-2)};
    for (int sector = first; sector <= last; ++sector) {
        if (kernels.apertureAt(1 + sector) == kernels.apertureAt(2 + sector)) continue; // never chosen
        for (const float distance : {distanceMin, distanceMax})
            for (const int side : {0, 1})
                add(box,
                    concentricDisc(squareOf({kernels.distanceAt(kernels.ringsOf(sector), lightOf(distance)),
                                             float(sector + side) * (1.f / float(kSectors))})));
    }
    constexpr float kSag = 1e-4f; // of an arc of a sector, and rounding
    return {box.min - kSag, box.max + kSag};
}

} // namespace slant
