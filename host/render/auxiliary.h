// Auxiliary images: what the samples hold besides radiance, for denoisers and compositors. They are planes of
// values that are reconstructed like colours, with exactly the same weights.
//
// Channels, all of them averages over the rays of a pixel under its filter:
// - A: the share of rays that hit something;
// - Z: mean depth of those that did; 0 where none did;
// - albedo.R, .G, .B and N.X, .Y, .Z: means over all rays, 0 for those that hit nothing, so that they are
//   premultiplied by A. Mean normals are shorter than 1 where normals differ.
#pragma once
#include "image/image.h"
#include "lightfield/value_plane.h"

#include <span>

namespace slant {

struct AuxiliarySet {
    ValuePlane plane;
    std::vector<std::string> channels;
    float (*finish)(float mean, float coverage); ///< makes a channel of a pixel from the mean of its values
};

/// A, Z; and albedo and normal, where samples have them; in the order in which they are added to a picture.
std::span<const AuxiliarySet> auxiliarySets(bool withGuides);

/// Adds the channels of a set to a picture, from `means`, R, G, B of the same pixels.
void addChannels(Image& image, const AuxiliarySet& set, const Image& means);

} // namespace slant
