#include "camera/aperture.h"

#include "camera/disc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slant {
namespace {

using glm::vec2;

constexpr int kSide = ApertureShape::kSide;
constexpr float kLastBelowOne = 0x1.fffffep-1f;

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
    const std::vector<double> weights(shape.weights.begin(), shape.weights.end());
    const auto row = [&](int y) { return std::span(&weights[std::size_t(y) * kSide], kSide); };
    std::vector<double> rows;
    for (int y = 0; y < kSide; ++y) {
        double sum = 0;
        for (const double weight : row(y)) sum += weight;
        rows.push_back(sum);
    }
    std::vector<float> table{-1};
    appendCumulative(table, rows);
    for (int y = 0; y < kSide; ++y) appendCumulative(table, row(y));
    return table;
}

/// The entry of a cumulative table that a number in [0, 1) falls into.
int entryAt(std::span<const float> cumulative, float s) {
    int low = 0;
    for (int step = kSide / 2; step > 0; step /= 2)
        if (cumulative[std::size_t(low + step)] <= s) low += step;
    return low;
}

/// Where in [-1, 1] it falls.
float placeAt(std::span<const float> cumulative, int entry, float s) {
    const float begin = cumulative[std::size_t(entry)], end = cumulative[std::size_t(entry) + 1];
    return (float(entry) + (s - begin) / (end - begin)) * (2.f / float(kSide)) - 1.f;
}

std::span<const float> cumulativeOf(std::span<const float> table, int list) {
    return table.subspan(std::size_t(1 + list * (kSide + 1)), kSide + 1);
}

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
    const float kind = data_->table[0];
    if (kind == 0) return concentricDisc(square);
    return kind > 0 ? onOutline(square) : onImage(square);
}

vec2 Aperture::onOutline(vec2 square) const {
    const bool wide = glm::abs(square.x) > glm::abs(square.y);
    const float radius = wide ? square.x : square.y;
    if (radius == 0) return vec2(0);
    float turn = wide ? square.y / square.x * 0.125f : 0.25f - square.x / square.y * 0.125f;
    if (radius < 0) turn += 0.5f;
    if (turn < 0) turn += 1.f;
    const int corners = int(data_->table[0]);
    const float sector = turn * float(corners);
    const int i = glm::min(int(sector), corners - 1);
    const vec2 begin = corner(i), end = corner(i + 1);
    return glm::abs(radius) * (begin + (sector - float(i)) * (end - begin));
}

vec2 Aperture::onImage(vec2 square) const {
    const vec2 s = glm::min(0.5f * square + 0.5f, vec2(kLastBelowOne));
    const std::span<const float> rows = cumulativeOf(table(), 0);
    const int row = entryAt(rows, s.y);
    const std::span<const float> columns = cumulativeOf(table(), 1 + row);
    return {placeAt(columns, entryAt(columns, s.x), s.x), placeAt(rows, row, s.y)};
}

float Aperture::transmission(vec2 lens) const {
    const ApertureShape& shape = data_->shape;
    if (!shape.weights.empty()) {
        const glm::ivec2 pixel(glm::floor((lens + 1.f) * float(kSide / 2)));
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= kSide || pixel.y >= kSide) return 0;
        return float(shape.weights[std::size_t(pixel.y * kSide + pixel.x)]) / 255;
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
        area = 0;
        for (const std::uint8_t weight : shape.weights) area += weight / 255.0 * 4 / (kSide * kSide);
    }
    return area / std::numbers::pi;
}

double shareOutside(const Aperture& aperture, float scale, const Aperture& other) {
    constexpr int kSteps = 200;
    constexpr float kInwards = 0.999f; // the rim of a shape is in the shape itself, whatever rounding does
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
    if (kind < 0) return imageBox(squareMin, squareMax);
    // Curved sides are sampled, and the box padded by more than what lies between two samples.
    constexpr int steps = 32;
    LensBox box{vec2(2), vec2(-2)};
    for (int j = 0; j <= steps; ++j)
        for (int i = 0; i <= steps; ++i)
            add(box, concentricDisc(glm::mix(squareMin, squareMax, vec2(float(i), float(j)) / float(steps))));
    const vec2 pad = (box.max - box.min) * 0.01f;
    return {box.min - pad, box.max + pad};
}

/// The map is linear between the rays of the square on which its triangles meet or its diagonals lie, so that
/// extremes are at corners of the rectangle and where such a ray enters or leaves it.
LensBox Aperture::outlineBox(vec2 squareMin, vec2 squareMax) const {
    LensBox box{vec2(2), vec2(-2)};
    for (const float x : {squareMin.x, squareMax.x})
        for (const float y : {squareMin.y, squareMax.y}) add(box, at({x, y}));
    const auto follow = [&](double turn) {
        const int side = int(std::floor(4 * turn + 0.5)) % 4; // of the square: right, top, left, bottom
        const double along = 8 * turn - 2 * std::floor(4 * turn + 0.5);
        constexpr std::array<glm::dvec2, 4> outwards{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
        const glm::dvec2 out = outwards[std::size_t(side)], ray = out + along * glm::dvec2(-out.y, out.x);
        double enter = 0, leave = 1;
        for (int axis = 0; axis < 2; ++axis) {
            const double low = squareMin[axis], high = squareMax[axis];
            if (ray[axis] == 0) {
                if (low > 0 || high < 0) leave = -1;
                continue;
            }
            enter = std::max(enter, std::min(low / ray[axis], high / ray[axis]));
            leave = std::min(leave, std::max(low / ray[axis], high / ray[axis]));
        }
        if (enter > leave) return;
        add(box, at(vec2(enter * ray)));
        add(box, at(vec2(leave * ray)));
    };
    const int corners = int(data_->table[0]);
    for (int i = 0; i < corners; ++i) follow(double(i) / corners);
    for (int i = 1; i < 8; i += 2) follow(i / 8.0);
    constexpr float kRounding = 1e-6f;
    return {box.min - kRounding, box.max + kRounding};
}

/// Both places grow with their number, but each row has columns of its own.
LensBox Aperture::imageBox(vec2 squareMin, vec2 squareMax) const {
    const vec2 from = glm::min(0.5f * squareMin + 0.5f, vec2(kLastBelowOne));
    const vec2 to = glm::min(0.5f * squareMax + 0.5f, vec2(kLastBelowOne));
    const std::span<const float> rows = cumulativeOf(table(), 0);
    const int first = entryAt(rows, from.y), last = entryAt(rows, to.y);
    LensBox box{vec2(2, placeAt(rows, first, from.y)), vec2(-2, placeAt(rows, last, to.y))};
    for (int row = first; row <= last; ++row) {
        if (rows[std::size_t(row)] == rows[std::size_t(row) + 1]) continue; // never chosen
        const std::span<const float> columns = cumulativeOf(table(), 1 + row);
        box.min.x = std::min(box.min.x, placeAt(columns, entryAt(columns, from.x), from.x));
        box.max.x = std::max(box.max.x, placeAt(columns, entryAt(columns, to.x), to.x));
    }
    return box;
}

} // namespace slant
