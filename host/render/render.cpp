#include "render/render.h"

#include "reconstruct/plan.h"
#include "render/adaptive.h"
#include "trace/sample_pass.h"

#include <algorithm>

namespace slant {

bool hasSoftShadows(const Scene& scene) {
    const auto isSpread = [](const Light& light) { return light.kind == LightKind::infinite; };
    return !scene.areaLights.empty() || std::ranges::any_of(scene.lights, isSpread);
}

bool hasShadingNoise(const Scene& scene) {
    return hasSoftShadows(scene) || scene.lights.size() > 1 || scene.maxDepth > 1;
}

TracedField traceField(const Tracer& tracer, const Scene& scene, const SampleOptions& options,
                       Monitor& monitor) {
    TracedField traced;
    traced.field = traceLightField(tracer, scene, options, monitor, &traced.misses);
    traced.defects = sanitize(traced.field);
    return traced;
}

FieldMetadata metadataOf(const Scene& scene, const Camera& camera, std::string source, std::uint64_t seed) {
    FieldMetadata metadata;
    metadata.film = {0, 0, scene.film.xResolution, scene.film.yResolution};
    metadata.filter = scene.filter;
    if (const CompoundLens* lens = camera.compoundLens()) {
        constexpr double kMillimetres = 1000; // per metre
        metadata.lensRadius = float(lens->lens().entrancePupil().radius / kMillimetres);
        metadata.focalLength = float(lens->lens().focalLength() / kMillimetres);
        metadata.unit = std::string("m");
    } else {
        metadata.lensRadius = scene.camera.lensRadius;
    }
    metadata.source = std::move(source);
    metadata.seed = seed;
    return metadata;
}

namespace {

/// Passes of samples go on to a target in steps of this part of all samples so far, and at most as many
/// again.
constexpr double kLeastStep = 0.25, kMostStep = 1;

class RenderJob {
public:
    RenderJob(const Scene& scene, const RenderOptions& options, Backend& backend, Monitor& monitor)
        : scene_(scene), options_(options), backend_(backend), monitor_(monitor),
          reconstruction_(options.reconstruction), sampling_(options.sampling) {
        reconstruction_.filter = scene.filter;
        checkBudget(scene.film.crop, sampling_.samplesPerPixel, reconstruction_);
        sampling_.samplesPerPixel = firstPassSamples(sampling_.samplesPerPixel, options.placedShare);
        sampling_.planes.albedo = options.auxiliary;
        if (traitsOf(reconstruction_.method).filtersShading) {
            sampling_.planes.shading = hasShadingNoise(scene);
            sampling_.planes.shadows = hasSoftShadows(scene);
        }
    }

    Rendering run() {
        trace();
        FieldPictures pictures(backend_, result_.traced.field, reconstruction_, options_.compareWithCpu);
        result_.image = pictures.colours({}, monitor_, result_.report);
        if (options_.auxiliary) pictures.addAuxiliary(result_.image, {}, monitor_, result_.report);
        result_.image.displayWindow = {0, 0, scene_.film.xResolution, scene_.film.yResolution};
        for (const Agreement& agreement : pictures.takeAgreements()) result_.agreements.push_back(agreement);
        if (options_.errorChannels) {
            if (!error_) estimate();
            error_->addChannels(result_.image);
        }
        if (error_) result_.estimatedRelMse = error_->relMse();
        return std::move(result_);
    }

private:
    void trace() {
        const Tracer tracer(scene_, monitor_, sampling_.slopes);
        std::optional<SamplePlacement> placement;
        if (options_.placedShare > 0 || options_.targetRelMse)
            placement.emplace(tracer, sampling_, result_.traced, monitor_);
        result_.traced = traceField(tracer, scene_, sampling_, monitor_);
        result_.metadata = metadataOf(scene_, tracer.camera(), scene_.path, sampling_.seed);
        if (options_.placedShare > 0) {
            const std::uint64_t wanted =
                std::uint64_t(options_.sampling.samplesPerPixel) * scene_.film.crop.area();
            estimate();
            placement->add(*error_, wanted - std::min(wanted, placement->samples()));
            error_.reset();
        }
        if (options_.targetRelMse) placeUntil(*options_.targetRelMse, *placement);
    }

    void placeUntil(double target, SamplePlacement& placement) {
        for (estimate(); error_->relMse() > target; estimate()) {
            const double step = std::clamp(error_->relMse() / target - 1, kLeastStep, kMostStep);
            const auto wanted = std::uint64_t(step * double(placement.samples()));
            if (placement.add(*error_, wanted) > 0) continue;
            monitor_.warn(fmt::format(
                "the estimated relMSE is {:.3g} instead of {:.3g}: the memory budget has "
                "no room for more than {:.4g} samples per pixel",
                error_->relMse(), target, double(placement.samples()) / double(scene_.film.crop.area())));
            return;
        }
    }

    /// Of the picture of the samples so far.
    void estimate() {
        error_.emplace(backend_, result_.traced.field, reconstruction_, LensView{}, options_.compareWithCpu,
                       monitor_, result_.report, result_.agreements);
    }

    const Scene& scene_;
    const RenderOptions& options_;
    Backend& backend_;
    Monitor& monitor_;
    ReconstructOptions reconstruction_;
    SampleOptions sampling_;
    Rendering result_;
    std::optional<ErrorEstimate> error_; ///< unset after samples were added
};

} // namespace

Rendering render(const Scene& scene, const RenderOptions& options, Backend& backend, Monitor& monitor) {
    return RenderJob(scene, options, backend, monitor).run();
}

} // namespace slant
