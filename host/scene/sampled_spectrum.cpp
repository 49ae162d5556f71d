#include "scene/sampled_spectrum.h"

#include "scene/colour_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace slant {
namespace {

constexpr int kStepNm = 1;

/// CIE standard illuminant D65 from 360 nm in steps of 10.
constexpr std::array kD65 = {46.64,  52.09,  49.98,  54.65,  82.75,  91.49, 93.43,  86.68,  104.86, 117.01,
                             117.81, 114.86, 115.92, 108.81, 109.35, 107.8, 104.79, 107.69, 104.4,  104.05,
                             100.0,  96.33,  95.79,  88.69,  90.01,  89.6,  87.7,   83.29,  83.7,   80.03,
                             80.21,  82.28,  78.28,  69.72,  71.61,  74.35, 61.6,   69.89,  75.09,  63.59,
                             46.42,  66.81,  63.38,  64.3,   59.45,  51.96, 57.44,  60.31};

double d65(double nm) {
    const double place = (nm - kVisibleFirst) / 10;
    const std::size_t i = std::min(std::size_t(place), kD65.size() - 2);
    return std::lerp(kD65[i], kD65[i + 1], place - double(i));
}

/// Lobe of the fits below: a Gaussian with its own width on either side.
double lobe(double x, double centre, double left, double right) {
    const double t = (x - centre) / (x < centre ? left : right);
    return std::exp(-0.5 * t * t);
}

glm::dvec3 colourMatching(double nm) {
    return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                0.065 * lobe(nm, 501.1, 20.4, 26.2),
            0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
            1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

/// At which reflectances of metals are compared: cosines of the angle of incidence.
constexpr std::array kCosines = {1.0, 0.8, 0.6, 0.4, 0.25, 0.1};
using Reflectances = std::array<double, kCosines.size()>;

double misfit(double eta, double k, const Reflectances& wanted) {
    double sum = 0;
    for (std::size_t i = 0; i < kCosines.size(); ++i) {
        const double difference = fresnelReflectance(kCosines[i], eta, k) - wanted[i];
        sum += difference * difference;
    }
    return sum;
}

/// By a search of ever finer grids around the best pair so far.
glm::dvec2 fittedMetal(const Reflectances& wanted) {
    constexpr int kSteps = 12, kRounds = 40;
    constexpr double kShrink = 0.7;
    glm::dvec2 best(4, 4), reach(4, 4);
    double least = misfit(best.x, best.y, wanted);
    for (int round = 0; round < kRounds; ++round, reach *= kShrink) {
        const glm::dvec2 centre = best;
        for (int i = -kSteps; i <= kSteps; ++i)
            for (int j = -kSteps; j <= kSteps; ++j) {
                const glm::dvec2 place = centre + reach * glm::dvec2(i, j) / double(kSteps);
                if (place.x < 0.01 || place.y < 0) continue;
                if (const double error = misfit(place.x, place.y, wanted); error < least) {
                    least = error;
                    best = place;
                }
            }
    }
    return best;
}

} // namespace

SampledSpectrum::SampledSpectrum(const std::vector<double>& pairs) {
    for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) points_.emplace_back(pairs[i], pairs[i + 1]);
}

double SampledSpectrum::at(double nm) const {
    if (points_.empty() || nm < points_.front().first || nm > points_.back().first) return 0;
    const auto after = std::upper_bound(points_.begin(), points_.end(), nm,
                                        [](double x, const auto& point) { return x < point.first; });
    if (after == points_.end()) return points_.back().second;
    const auto& [x0, y0] = *(after - 1);
    return std::lerp(y0, after->second, (nm - x0) / (after->first - x0));
}

bool SampledSpectrum::isConstant() const {
    return !points_.empty() && points_.front().first <= kVisibleFirst &&
           points_.back().first >= kVisibleLast &&
           std::all_of(points_.begin(), points_.end(),
                       [&](const auto& point) { return point.second == points_.front().second; });
}

glm::dvec3 xyzOf(const SpectrumFunction& spectrum) {
    glm::dvec3 xyz(0);
    for (int nm = kVisibleFirst; nm <= kVisibleLast; nm += kStepNm) xyz += spectrum(nm) * colourMatching(nm);
    return xyz;
}

glm::vec3 lightRgb(const SpectrumFunction& spectrum) {
    const glm::dvec3 xyz = xyzOf(spectrum);
    return xyz.y > 0 ? glm::vec3(rec709FromXyz(xyz / xyz.y)) : glm::vec3(0);
}

glm::vec3 reflectanceRgb(const SpectrumFunction& reflectance) {
    static const glm::dvec3 white = rec709FromXyz(xyzOf(d65));
    return rec709FromXyz(xyzOf([&](double nm) { return reflectance(nm) * d65(nm); })) / white;
}

double blackbody(double nm, double kelvin) {
    constexpr double kSecondRadiation = 1.438776877e7; // h c / k in nm K
    return std::pow(560 / nm, 5) * std::expm1(kSecondRadiation / (560 * kelvin)) /
           std::expm1(kSecondRadiation / (nm * kelvin));
}

double fresnelReflectance(double cosTheta, double eta, double k) {
    const std::complex<double> index(eta, k);
    const std::complex<double> sine = std::sqrt(1 - cosTheta * cosTheta) / index;
    const std::complex<double> cosine = std::sqrt(1.0 - sine * sine);
    const auto parallel = (index * cosTheta - cosine) / (index * cosTheta + cosine);
    const auto across = (cosTheta - index * cosine) / (cosTheta + index * cosine);
    return (std::norm(parallel) + std::norm(across)) / 2;
}

Metal metalOf(const SpectrumFunction& eta, const SpectrumFunction& k) {
    std::array<Reflectances, 3> wanted;
    for (std::size_t i = 0; i < kCosines.size(); ++i) {
        const glm::vec3 rgb = reflectanceRgb([&](double nm) {
            return fresnelReflectance(kCosines[i], std::max(eta(nm), 0.01), std::max(k(nm), 0.0));
        });
        for (int c = 0; c < 3; ++c) wanted[std::size_t(c)][i] = double(glm::clamp(rgb[c], 0.f, 1.f));
    }
    Metal metal{};
    for (int c = 0; c < 3; ++c) {
        const glm::dvec2 fitted = fittedMetal(wanted[std::size_t(c)]);
        metal.eta[c] = float(fitted.x);
        metal.k[c] = float(fitted.y);
    }
    return metal;
}

} // namespace slant
