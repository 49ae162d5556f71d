// What a sweep of speed against error found, and its JSON and CSV files.
#pragma once
#include "report/curves.h"

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace slant {

/// The name of brute force among the methods.
inline constexpr const char* kReference = "reference";

/// The relMSE at which gains are stated.
inline constexpr double kGainErrors[] = {1e-3, 3e-4};

/// One setting on one scene. Errors are against the scene's ground truth; NaN if the picture is not finite.
struct Point {
    std::string key; ///< digest of all that decides the point
    std::string scene, method;
    int spp = 0;
    int outputs = 0;    ///< per pixel; 0 if the method has none
    std::string device; ///< name, or "cpu"
    int runs = 0;       ///< timed runs that the medians are of
    double traceSeconds = 0, reconstructSeconds = 0;
    double mse = 0, relMse = 0, flip = 0, drift = 0;
    std::string picture; ///< PNG in the folder of the results; empty if there is none
    std::string map;     ///< FLIP of each pixel as a PNG, where there is a picture

    double seconds() const { return traceSeconds + reconstructSeconds; }
    bool isReference() const { return method == kReference; }
};

struct SceneSummary {
    std::string name, path;
    int width = 0, height = 0;
    int truthSpp = 0;
    std::string truthPicture;
};

/// Where and how it was measured, in words.
struct Circumstances {
    std::string date, command, program, machine, settings;
};

struct Results {
    Circumstances circumstances;
    std::vector<SceneSummary> scenes;
    std::vector<Point> points;

    std::vector<Point> of(const SceneSummary& scene) const;
};

/// One method on one device, all its settings together, against the reference.
struct MethodGain {
    std::string method, device;
    double error = 0; ///< relMSE, of kGainErrors
    Gain gain;
};

/// `points` of one scene; by method and device in their order, each at every error of kGainErrors.
std::vector<MethodGain> gainsOf(std::span<const Point> points);

/// Upper bound of the relMSE that the noise of the ground truth adds to every figure: extrapolated from the
/// reference's error at its most samples, as if it fell as one over the samples (with a good pattern it falls
/// faster); 0 without a reference.
double truthNoise(std::span<const Point> points, int truthSpp);

nlohmann::ordered_json toJson(const Results& results);
/// The points of a results file; throws nlohmann::json::exception if it is none.
std::vector<Point> pointsFromJson(const nlohmann::ordered_json& json);

/// One row per point, after a row of names; comma-separated (RFC 4180), seconds and errors with 6 digits.
std::string toCsv(std::span<const Point> points);

} // namespace slant
