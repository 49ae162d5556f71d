#include "scene/lens_file.h"

#include "scene/scene_files.h"
#include "scene/tokenizer.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slant {
namespace {

constexpr std::size_t kMaxSurfaces = 1000;
constexpr double kMaxMillimetres = 1e6;
constexpr double kMaxIndex = 10;
constexpr int kHeights = 64; ///< at which neighbouring surfaces are compared

/// How far a surface at height h lies behind its vertex, towards the film.
double sag(const LensSurface& surface, double h) {
    if (surface.radius == 0) return 0;
    const double r = std::abs(surface.radius);
    const double depth = h * h / (r + std::sqrt(std::max(r * r - h * h, 0.0)));
    return surface.radius > 0 ? depth : -depth;
}

std::vector<LensSurface> readTable(Tokenizer& tokens) {
    std::vector<LensSurface> surfaces;
    while (tokens.peek().kind != TokenKind::end) {
        const int line = tokens.peek().position.line;
        std::array<double, 4> row{};
        for (double& number : row) {
            const Token& token = tokens.peek();
            if (token.kind == TokenKind::end)
                throw badInput(token.position, "the last surface is incomplete: a surface has four numbers, "
                                               "radius, thickness, index and diameter");
            const Position where = token.position;
            number = numberOf(tokens.next());
            if (std::abs(number) > kMaxMillimetres)
                throw badInput(where, "{} is out of range: a lens has at most {} mm", number,
                               kMaxMillimetres);
        }
        surfaces.push_back({row[0], row[1], row[2] == 0 ? 1 : row[2], row[3], line});
        if (surfaces.size() > kMaxSurfaces)
            throw badInput(tokens.peek().position, "a lens of more than {} surfaces", kMaxSurfaces);
    }
    return surfaces;
}

void checkSurface(const LensSurface& surface, const FileLocation& where) {
    if (surface.thickness < 0)
        throw badInput(where, "the distance to the next surface is {}, but must not be below 0",
                       surface.thickness);
    if (!(surface.index >= 1 && surface.index <= kMaxIndex))
        throw badInput(where, "the index of refraction is {}, but must be from 1 to {}, or 0 for air",
                       surface.index, kMaxIndex);
    if (surface.diameter <= 0)
        throw badInput(where, "the clear diameter is {}, but must be above 0", surface.diameter);
    if (surface.radius != 0 && surface.diameter > 2 * std::abs(surface.radius))
        throw badInput(where, "a surface of radius {} cannot have a clear diameter of {}", surface.radius,
                       surface.diameter);
}

void checkGap(const LensSurface& front, const LensSurface& rear, const FileLocation& where) {
    const double rim = std::min(front.diameter, rear.diameter) / 2;
    for (int i = 1; i <= kHeights; ++i) {
        const double h = rim * i / kHeights;
        if (front.thickness + sag(rear, h) - sag(front, h) < 0)
            throw badInput(where,
                           "this surface meets the one before it, {:.4g} mm from the axis: the distance of "
                           "{} mm between them is too short",
                           h, front.thickness);
    }
}

} // namespace

LensPrescription parseLens(const std::string& text, const std::string& name) {
    Tokenizer tokens(text, &name);
    LensPrescription lens{name, readTable(tokens)};
    if (lens.surfaces.empty()) throw badInput({name}, "the file has no lens surface");
    const auto at = [&](std::size_t i) { return FileLocation{name, lens.surfaces[i].line}; };
    for (std::size_t i = 0; i < lens.surfaces.size(); ++i) checkSurface(lens.surfaces[i], at(i));

    const auto isStop = [](const LensSurface& s) { return s.radius == 0; };
    const auto stop = std::find_if(lens.surfaces.begin(), lens.surfaces.end(), isStop);
    if (stop == lens.surfaces.end())
        throw badInput({name}, "the lens has no aperture stop: a surface of radius 0");
    lens.stop = std::size_t(stop - lens.surfaces.begin());
    if (const auto second = std::find_if(stop + 1, lens.surfaces.end(), isStop);
        second != lens.surfaces.end())
        throw badInput({name, second->line}, "a second aperture stop: the first is in line {}", stop->line);
    if (stop->index != 1 || (lens.stop > 0 && lens.surfaces[lens.stop - 1].index != 1))
        throw badInput(at(lens.stop), "the aperture stop must stand in air");

    if (lens.surfaces.back().index != 1)
        throw badInput(at(lens.surfaces.size() - 1), "behind the last surface must be air");

    const auto isThin = [](const LensSurface& s) { return s.thickness == 0; };
    if (std::all_of(lens.surfaces.begin(), lens.surfaces.end() - 1, isThin))
        throw badInput({name}, "all surfaces lie in one place: every thickness is 0");
    for (std::size_t i = 1; i < lens.surfaces.size(); ++i)
        checkGap(lens.surfaces[i - 1], lens.surfaces[i], at(i));
    return lens;
}

LensPrescription readLens(const std::string& path, const FileLocation& where) {
    return parseLens(readBytes(path, where), path);
}

} // namespace slant
