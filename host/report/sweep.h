// Measures speed against error: every method at every setting on every scene, beside brute force at rising
// sample counts, each timed and compared with the ground truth in one run.
#pragma once
#include "base/monitor.h"
#include "reconstruct/method.h"
#include "report/results.h"
#include "scene/read_scene.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace slant {

/// Lists are not empty and have no duplicates; numbers ascend.
struct SweepOptions {
    ReadOptions reading;             ///< of the scenes
    std::vector<std::string> scenes; ///< pbrt files; their names without folder and extension differ
    std::vector<Method> methods;
    std::vector<int> samples;         ///< input samples per pixel
    std::vector<int> outputs;         ///< output samples per pixel, powers of two
    std::vector<std::string> devices; ///< as Backend takes them
    double placedShare = 0;           ///< if > 0, methods are measured with that share of samples placed, too
    int repeat = 3;                   ///< timed runs per point
    int truthSpp = 4096;              ///< at least 64
    bool halfSize = false;            ///< half the resolution in both directions
    std::uint64_t seed = 0;
    int threads = 0;    ///< 0 = all cores
    float exposure = 0; ///< stops, of FLIP and the pictures
    std::string cacheDirectory;
    std::string pictureDirectory; ///< where PNGs of some points are written, as "images/NAME.png"
};

/// `known` are points of earlier runs: those of equal key are taken over as they are. `onPoint` is called
/// after each measured point with all results so far, so that an interrupted run can go on. The caller fills
/// in the circumstances. One stage of the monitor. Throws Error as readScene, Backend, Tracer, groundTruth
/// and the reconstruction do.
Results runSweep(const SweepOptions& options, const std::vector<Point>& known,
                 const std::function<void(const Results&)>& onPoint, Monitor& monitor);

/// Sample counts of the reference's curve: powers of four from 4 to a quarter of the ground truth's.
std::vector<int> referenceSamples(int truthSpp);

} // namespace slant
