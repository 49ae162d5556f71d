// Spectra over wavelength, and what the eye and our RGB make of them.
#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace slant {

inline constexpr int kVisibleFirst = 360, kVisibleLast = 830; ///< nm, pbrt's range

/// Wavelength-value pairs (nm, ascending), straight lines between them and 0 outside, as in pbrt.
class SampledSpectrum {
public:
    /// `pairs` are wavelength, value, wavelength, value, ...
    explicit SampledSpectrum(const std::vector<double>& pairs);

    double at(double nm) const;
    /// Whether it has one value over all that is visible.
    bool isConstant() const;

private:
    std::vector<std::pair<double, double>> points_;
};

using SpectrumFunction = std::function<double(double nm)>;

/// CIE XYZ by the fit of Wyman, Sloan and Shirley (JCGT 2(2), 2013, the multi-lobe fit), not normalised.
glm::dvec3 xyzOf(const SpectrumFunction& spectrum);

/// Rec.709 of light of that spectrum with luminance 1, which may be negative outside the colour space; 0 for
/// no light.
glm::vec3 lightRgb(const SpectrumFunction& spectrum);

/// Rec.709 of a surface that reflects so under D65, exact where it is constant. Off the true matching
/// functions by at most 0.005 on the 24 patches of a ColorChecker.
glm::vec3 reflectanceRgb(const SpectrumFunction& reflectance);

/// Planck's law relative to 560 nm, which does not overflow for any temperature from 500 to 1e6 K.
double blackbody(double nm, double kelvin);

struct Metal {
    glm::vec3 eta, k;
};

/// The RGB indices of refraction and absorption whose Fresnel reflectance follows, over all angles, that of
/// the spectra under D65.
Metal metalOf(const SpectrumFunction& eta, const SpectrumFunction& k);

/// Reflectance of a conductor in air, unpolarised.
double fresnelReflectance(double cosTheta, double eta, double k);

} // namespace slant
