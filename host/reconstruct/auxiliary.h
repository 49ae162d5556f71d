// Auxiliary images: what the samples know beside their radiance, for denoisers and compositors. They are
// reconstructed as colours are, up to three values at a time in the place of r, g, b, so that each has the
// very weights that the picture's colours had. In that place none is negative, as no colour is, and those of
// a set are of one order of magnitude: the layer map keeps them with a common exponent.
//
// Channels, all of them averages over the rays of a pixel under its filter:
// - A: the share of rays that hit something;
// - Z: mean depth of those that did; 0 where none did;
// - albedo.R, .G, .B and N.X, .Y, .Z: means over all rays, 0 for those that hit nothing, so that they are
//   premultiplied by A. Mean normals are shorter than 1 where normals differ.
#pragma once
#include "image/image.h"
#include "lightfield/lightfield.h"

#include <span>

namespace slant {

struct AuxiliarySet {
    std::vector<std::string> channels;
    glm::vec3 (*valuesOf)(const LightFieldSample& sample, const AuxiliarySample& auxiliary);
    float (*finish)(float mean, float coverage); ///< a channel of a pixel from the mean of its values
};

/// A, Z; and albedo and normal, where samples have them; in the order in which they are added to a picture.
std::span<const AuxiliarySet> auxiliarySets(bool withAlbedoAndNormals);

/// Puts the values in the place of r, g, b; 0 for those that are negative or not finite, and
/// for normals that are not.
void takeValues(LightField& field, const AuxiliarySet& set);

/// The radiances of the samples, to be put back after other values were in their place.
std::vector<glm::vec3> radiancesOf(const LightField& field);
void putRadiances(LightField& field, std::span<const glm::vec3> radiances);

/// Adds the channels of a set to a picture, from `means`, R, G, B of the same pixels.
void addChannels(Image& image, const AuxiliarySet& set, const Image& means);

} // namespace slant
