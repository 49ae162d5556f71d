// Options of `reconstruct` that look through another lens than the traced one, or at another time.
#pragma once
#include "lightfield/field_file.h"
#include "reconstruct/prepared_field.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace slant::commands {

/// Part of the traced shutter, 0 <= open <= close <= 1; equal: one instant.
struct Shutter {
    float open = 0, close = 1;
    bool isTraced() const { return open == 0 && close == 1; }
};

struct ViewOptions {
    std::optional<double> distance;             ///< of the focus, in the unit of w
    std::optional<double> focusFrom, focusTo;   ///< of a focus pull
    Shutter shutter;                            ///< of every picture, unless an instant is asked for
    std::optional<double> freeze;               ///< the instant of every picture
    std::optional<double> freezeFrom, freezeTo; ///< first and last instant of slow motion
    int frames = 0;                             ///< of both; 0: a single picture
    std::optional<float> apertureScale;         ///< of the traced lens radius
    std::optional<float> fStop;
    std::string aperture; ///< name or image file of its shape; empty: as traced

    bool refocuses() const { return distance || focusFrom; }
    bool changesTime() const { return freeze || freezeFrom || !shutter.isTraced(); }
};

/// --focus-distance, --focus-from, --focus-to, --shutter, --freeze, --freeze-from, --freeze-to, --frames,
/// --aperture-scale, --f-stop, --pinhole, --aperture
void addViewOptions(CLI::App& command, ViewOptions& options);

/// Throws Error(usage) for options that do not go together, and for a method that cannot do it.
void checkViewOptions(const ViewOptions& options, Method method);

/// The lens radius over the traced one. Throws Error(usage) for an f-number where the file does not say what
/// it takes.
float apertureScale(const ViewOptions& options, const FieldMetadata& details);

/// What differs from picture to picture.
struct ViewStep {
    std::optional<double> focusDistance; ///< unset: as traced
    Shutter shutter;
};
/// One of each picture. A focus pull takes even steps of 1/distance, so that blur changes evenly; slow motion
/// takes even steps of time.
std::vector<ViewStep> viewSteps(const ViewOptions& options);

/// "pull.exr" -> "pull-0007.exr"; an empty path stays empty.
std::string numbered(const std::string& path, std::size_t number);

} // namespace slant::commands
