// Options of `reconstruct` that look through another lens than the traced one.
#pragma once
#include "lightfield/field_file.h"
#include "reconstruct/prepared_field.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace slant::commands {

struct FocusOptions {
    std::optional<double> distance;     ///< in the unit of w
    std::optional<double> from, to;     ///< of a focus pull
    int frames = 0;                     ///< of the pull; 0: a single picture
    std::optional<float> apertureScale; ///< of the traced lens radius
    std::optional<float> fStop;
    std::string aperture; ///< name or image file of its shape; empty: as traced

    bool refocuses() const { return distance || frames > 0; }
};

/// --focus-distance, --focus-from, --focus-to, --frames, --aperture-scale, --f-stop, --pinhole, --aperture
void addFocusOptions(CLI::App& command, FocusOptions& options);

/// Throws Error(usage) for options that do not go together, and for a method that cannot do it.
void checkFocusOptions(const FocusOptions& options, Method method);

/// The lens radius over the traced one. Throws Error(usage) for an f-number where the file does not say what
/// it takes.
float apertureScale(const FocusOptions& options, const FieldMetadata& details);

/// Focus distance of each picture; unset: as traced. A pull takes even steps of 1/distance, so that blur
/// changes evenly.
std::vector<std::optional<double>> focusDistances(const FocusOptions& options);

/// "pull.exr" -> "pull-0007.exr"; an empty path stays empty.
std::string numbered(const std::string& path, std::size_t number);

} // namespace slant::commands
