// Auxiliary images: what the samples hold besides radiance, for denoisers and compositors. They are planes of
// values that are reconstructed like colours, with exactly the same weights.
//
// Channels, all of them averages over the rays of a pixel under its filter:
// - A: the share of rays that hit something;
// - Z: mean depth of those that did; 0 where none did;
// - albedo.R, .G, .B and N.X, .Y, .Z: means over all rays, 0 for those that hit nothing, so that they are
//   premultiplied by A. Mean normals are shorter than 1 where normals differ;
// - forward.u, .v: mean over all rays, background included, of how far what they hit moves on the picture
// from
//   the opening of the traced shutter to its closing, in pixels, to the right and upwards.
#pragma once
#include "image/image.h"
#include "lightfield/value_plane.h"

#include <string>
#include <vector>

namespace slant {

struct AuxiliarySet {
    ValuePlane plane;
    std::vector<std::string> channels;
    /// Makes the channels of a pixel, of which there are `channels`, from the mean of its values.
    glm::vec3 (*finish)(glm::vec3 mean, float coverage);
};

/// A, Z; and albedo, normal and motion where samples have them; in the order in which they are added to a
/// picture.
std::vector<AuxiliarySet> auxiliarySets(bool withGuides, bool withMotion);

/// Adds the channels of a set to a picture, from `means`, R, G, B of the same pixels.
void addChannels(Image& image, const AuxiliarySet& set, const Image& means);

} // namespace slant
