#include "render/render.h"

#include "reconstruct/plan.h"
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

Rendering render(const Scene& scene, const RenderOptions& options, Backend& backend, Monitor& monitor) {
    ReconstructOptions reconstruction = options.reconstruction;
    reconstruction.filter = scene.filter;
    checkBudget(scene.film.crop, options.sampling.samplesPerPixel, reconstruction);
    SampleOptions sampling = options.sampling;
    sampling.planes.albedo = options.auxiliary;
    if (traitsOf(reconstruction.method).filtersShading) {
        sampling.planes.shading = hasShadingNoise(scene);
        sampling.planes.shadows = hasSoftShadows(scene);
    }

    Rendering result;
    {
        const Tracer tracer(scene, monitor, sampling.slopes);
        result.traced = traceField(tracer, scene, sampling, monitor);
        result.metadata = metadataOf(scene, tracer.camera(), scene.path, sampling.seed);
    }
    FieldPictures pictures(backend, result.traced.field, reconstruction, options.compareWithCpu);
    result.image = pictures.colours({}, monitor, result.report);
    if (options.auxiliary) pictures.addAuxiliary(result.image, {}, monitor, result.report);
    result.image.displayWindow = {0, 0, scene.film.xResolution, scene.film.yResolution};
    result.agreements = pictures.takeAgreements();
    return result;
}

} // namespace slant
