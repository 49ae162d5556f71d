#include "camera/lens_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace slant {
namespace {

constexpr int kRays = 9; ///< of each bundle
constexpr double kWidthPx = 960;
constexpr double kMarginMm = 3;
constexpr int kArcPoints = 24;

/// Lens space to the picture: the scene to the left, x upwards.
class Sheet {
public:
    Sheet(double front, double rear, double halfHeight)
        : front_(front), top_(halfHeight), scale_(kWidthPx / (front - rear)) {
        text_ = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\">\n"
                            "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                            kWidthPx, 2 * halfHeight * scale_);
    }
    void path(const std::vector<glm::dvec2>& points, std::string_view style) {
        text_ += "<path d=\"";
        for (std::size_t i = 0; i < points.size(); ++i)
            text_ += fmt::format("{}{:.2f} {:.2f}", i == 0 ? "M" : " L", (front_ - points[i].x) * scale_,
                                 (top_ - points[i].y) * scale_);
        text_ += fmt::format("\" {}/>\n", style);
    }
    std::string finish() { return text_ + "</svg>\n"; }

private:
    double front_, top_, scale_;
    std::string text_;
};

/// Points (z, x) of a surface from its lower to its upper rim, and straight on to the edge of its glass.
std::vector<glm::dvec2> profile(const LensSystem::Outline& surface, double edge) {
    std::vector<glm::dvec2> points;
    for (int i = 0; i <= kArcPoints; ++i) {
        const double x = surface.clearRadius * (2.0 * i / kArcPoints - 1), r = surface.radius;
        const double root = std::sqrt(std::max(r * r - x * x, 0.0));
        points.emplace_back(surface.vertex - (r > 0 ? r - root : r + root), x);
    }
    points.insert(points.begin(), {points.front().x, -edge});
    points.emplace_back(points.back().x, edge);
    return points;
}

void drawGlass(Sheet& sheet, const std::vector<LensSystem::Outline>& surfaces) {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const LensSystem::Outline& s = surfaces[i];
        if (s.radius == 0) {
            for (const int side : {-1, 1})
                sheet.path({{s.vertex, side * s.clearRadius}, {s.vertex, side * (s.clearRadius + 3)}},
                           "stroke=\"black\" stroke-width=\"3\"");
        } else if (s.glassBehind && i + 1 < surfaces.size()) {
            const LensSystem::Outline& next = surfaces[i + 1];
            const double edge = std::max(s.clearRadius, next.clearRadius);
            std::vector<glm::dvec2> outline = profile(s, edge), rear = profile(next, edge);
            outline.insert(outline.end(), rear.rbegin(), rear.rend());
            outline.push_back(outline.front());
            sheet.path(outline, "fill=\"#d5e6f3\" stroke=\"#4a6a85\" stroke-width=\"1\"");
        }
    }
}

/// Rays of the meridional plane that end at height `film`, from far in front.
void drawRays(Sheet& sheet, const CompoundLens& camera, double film, double front, const char* colour) {
    const double r = std::abs(film);
    for (int i = 0; i < kRays; ++i) {
        // Along the line through the pupil's centre that the film radius lies on.
        const double place = 2 * (i + 0.5) / kRays - 1;
        if (!(camera.pupil().irradiance(r) > 0)) continue;
        const double along = camera.pupil().at(r, {place, 0}).x, pupil = film > 0 ? -along : along;
        const glm::dvec3 from(film, 0, camera.filmZ());
        const glm::dvec3 to(pupil, 0, camera.pupil().planeZ());
        const std::vector<glm::dvec3> corners =
            camera.lens().corners({from, glm::normalize(to - from)}, front);
        std::vector<glm::dvec2> points;
        for (const glm::dvec3& p : corners) points.emplace_back(p.z, p.x);
        if (!points.empty())
            sheet.path(points, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"0.8\"", colour));
    }
}

} // namespace

std::string drawLens(const CompoundLens& camera, double filmWidthMm) {
    const std::vector<LensSystem::Outline> surfaces = camera.lens().outline();
    double halfHeight = filmWidthMm / 2;
    for (const LensSystem::Outline& s : surfaces) halfHeight = std::max(halfHeight, s.clearRadius + 3);
    const double depth = camera.lens().frontVertex() - camera.filmZ();
    const double front = camera.lens().frontVertex() + 0.4 * depth;
    Sheet sheet(front, camera.filmZ() - kMarginMm, halfHeight + kMarginMm);
    sheet.path({{front, 0}, {camera.filmZ(), 0}}, "stroke=\"#bbb\" stroke-dasharray=\"8 4 2 4\"");
    drawGlass(sheet, surfaces);
    drawRays(sheet, camera, 0, front, "#c0392b");
    drawRays(sheet, camera, -filmWidthMm / 2, front, "#2471a3");
    sheet.path({{camera.filmZ(), -filmWidthMm / 2}, {camera.filmZ(), filmWidthMm / 2}},
               "stroke=\"black\" stroke-width=\"2\"");
    return sheet.finish();
}

} // namespace slant
