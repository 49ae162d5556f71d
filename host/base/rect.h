// Half-open pixel rectangles.
#pragma once
#include <algorithm>
#include <cstddef>

namespace slant {

/// Pixels [x0, x1) x [y0, y1); pixel (i, j) covers the raster area [i, i+1) x [j, j+1), y downwards.
struct Rect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    int width() const { return std::max(0, x1 - x0); }
    int height() const { return std::max(0, y1 - y0); }
    std::size_t area() const { return std::size_t(width()) * std::size_t(height()); }
    bool empty() const { return area() == 0; }
    bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
    Rect intersect(const Rect& o) const {
        return {std::max(x0, o.x0), std::max(y0, o.y0), std::min(x1, o.x1), std::min(y1, o.y1)};
    }
    Rect expand(int pixels) const { return {x0 - pixels, y0 - pixels, x1 + pixels, y1 + pixels}; }
    bool operator==(const Rect&) const = default;
};

} // namespace slant
