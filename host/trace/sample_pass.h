// The sample pass: traces the light field of a scene's frame and of as much overscan as its blur needs.
#pragma once
#include "trace/sample_options.h"
#include "trace/tracer.h"

namespace slant {

/// Traces Film::crop, then an overscan on each side as wide as any seen sample's trajectory reaches beyond
/// it, plus the reach of the pixel filter and the reconstruction radius; at most half of the film's longer
/// side (then it warns). Where anything moves, samples have their motion, and `misses`, if not null, receives
/// how far off straight lines are for those of the frame (it warns if that is seen). Throws Error(resources)
/// when the samples do not fit the budget or memory, before tracing them.
LightField traceLightField(const Tracer& tracer, const Scene& scene, const SampleOptions& options,
                           Monitor& monitor, MotionMisses* misses = nullptr);

/// How many more samples the budget has room for.
std::uint64_t roomForMore(const LightField& field, const SampleOptions& options);

/// Traces counts[k] more samples of each pixel k of field.frame, row by row, at least one in all, and puts
/// them behind those that are there, sanitized; returns what was mended. They are the first of a pattern of
/// their own, which options.seed and `pass` >= 1 name. Throws Error(resources) when the samples do not fit
/// the budget or memory, before tracing them.
FieldDefects traceMore(const Tracer& tracer, const SampleOptions& options,
                       std::span<const std::uint32_t> counts, int pass, LightField& field, Monitor& monitor);

/// The bounds for a frame whose samples are given (any order), with their motion or without, seen through a
/// pixel filter that reaches `filterReach` pixels to each side; sides of the overscan are at most `limitPx`.
/// Sets `wantedPx` to the widest side that would be needed.
Rect boundsWithOverscan(Rect frame, glm::ivec2 filterReach, std::span<const LightFieldSample> samples,
                        std::span<const glm::vec3> motion, SlopeModel slopeModel, int samplesPerPixel,
                        int limitPx, int& wantedPx, const LensMap& lens = {});

} // namespace slant
