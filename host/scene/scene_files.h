// The files that a scene names: where they are, and that each is read once.
#pragma once
#include "scene/position.h"
#include "scene/scene.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace slant {

class Monitor;

/// The whole of a file, unpacked if it is gzip (by content). Throws Error as base/read_file.h, at the place
/// `where` that names the file if there is one, and if more than `kMaxUnpackedBytes` come out.
std::string readBytes(const std::string& path, const FileLocation& where);
inline constexpr std::size_t kMaxUnpackedBytes = std::size_t(1) << 31;

/// How the numbers of an image file are to be read.
struct ColourEncoding {
    enum class Kind {
        automatic,
        linear,
        srgb,
        gamma
    } kind = Kind::automatic; ///< automatic: integers sRGB, floats linear
    float exponent = 1;       ///< gamma
    auto operator<=>(const ColourEncoding&) const = default;
};

/// Loads images and PLY meshes into a Scene; one path is read once. Errors are at the place in the scene
/// text that names the file, or at the place in the file.
class SceneFiles {
public:
    /// Relative paths start at `directory`, that of the main scene file (also within included files, as in
    /// pbrt). All must outlive this.
    SceneFiles(std::string directory, Scene& scene, Monitor& monitor)
        : directory_(std::move(directory)), scene_(scene), monitor_(monitor) {}

    std::string resolve(const std::string& filename) const;

    /// Index of the image in Scene::images: linear, RGB, or with `average` the mean of the channels.
    int image(const std::string& filename, ColourEncoding encoding, bool average, const Position& where);

    /// Index of the image of an infinite light: equal-area octahedral, made so if it is twice as wide as
    /// high.
    int environment(const std::string& filename, const Position& where);

    /// The shape of that name, or that of an image file.
    ApertureShape aperture(const std::string& text, const Position& where) const;

    /// Indices in Scene::meshes: triangles, bilinear patches, or both.
    std::vector<int> plyMeshes(const std::string& filename, const Position& where);

private:
    using ImageKey = std::pair<std::string, std::pair<ColourEncoding, bool>>;

    std::string directory_;
    Scene& scene_;
    Monitor& monitor_;
    std::map<ImageKey, int> images_;
    std::map<std::string, int> environments_;
    std::map<std::string, std::vector<int>> meshes_;
};

} // namespace slant
