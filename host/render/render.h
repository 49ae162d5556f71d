// From a scene to its picture in one call.
#pragma once
#include "base/monitor.h"
#include "lightfield/field_metadata.h"
#include "render/field_pictures.h"
#include "trace/sample_motion.h"
#include "trace/sample_options.h"

#include <optional>

namespace slant {

class Camera;
class Tracer;

/// A light field as reconstruction takes it.
struct TracedField {
    LightField field; ///< sanitized
    FieldDefects defects;
    MotionMisses misses; ///< of the samples' motion, where anything moves
};

/// What a file says about the light field of a scene; `source` names the scene.
FieldMetadata metadataOf(const Scene& scene, const Camera& camera, std::string source, std::uint64_t seed);

/// Whether samples of equal places differ in their light: all is lit by one point or direction alone
/// otherwise. Only then they need the parts of their radiance (SamplePlanes::shading).
bool hasShadingNoise(const Scene& scene);
/// Whether some light has an extent: then they need the rays to lights, too (SamplePlanes::shadows).
bool hasSoftShadows(const Scene& scene);

/// Throws what traceLightField throws.
TracedField traceField(const Tracer& tracer, const Scene& scene, const SampleOptions& options,
                       Monitor& monitor);

struct RenderOptions {
    SampleOptions sampling; ///< with guides if `auxiliary`
    double placedShare = 0; ///< of the samples, in [0, 1): where the error of the others is largest
    /// More samples are traced, where the error is largest, until the estimated relMSE is as low as this.
    std::optional<double> targetRelMse = {};
    ReconstructOptions reconstruction; ///< the filter is the scene's
    bool auxiliary = false;            ///< with the channels of render/auxiliary.h
    bool errorChannels = false;        ///< with error.R, .G, .B (ErrorEstimate::addChannels)
    bool compareWithCpu = false;       ///< see FieldPictures
};

struct Rendering {
    Image image; ///< of scene.film.crop, channels R, G, B (and auxiliary ones)
    TracedField traced;
    FieldMetadata metadata; ///< of the traced field
    ReconstructReport report;
    std::vector<Agreement> agreements;
    std::optional<double> estimatedRelMse; ///< of the picture; where a target or error channels are asked for
};

/// Traces, reconstructs and filters the picture of a scene. It warns where a target is not reached within the
/// memory budget of the samples. Throws Error(resources) for a memory budget that is too small, before
/// tracing; Error(usage) where samples cannot be placed (SamplePlacement); and whatever Tracer,
/// traceLightField and FieldPictures throw.
Rendering render(const Scene& scene, const RenderOptions& options, Backend& backend, Monitor& monitor);

} // namespace slant
