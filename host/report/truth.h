// The ground truth of a scene, kept between runs.
#pragma once
#include "base/monitor.h"
#include "image/image.h"
#include "scene/scene.h"
#include "trace/tracer.h"

#include <cstdint>
#include <string>

namespace slant {

/// A digest of all that determines the picture of a scene: the contents of its files, its film and filter,
/// and the result of this tracer for some of its pixels, so that a changed tracer has another key. Throws
/// Error(badInput) if a file of the scene cannot be read any more.
std::string contentKey(const Scene& scene, const Tracer& tracer);

/// Brute force at `spp` samples per pixel: read from `directory` if an earlier run has left it there, else
/// made (one stage of the monitor) and kept there as an EXR of 32-bit floats. Its samples share nothing with
/// those of any run whose seed is `seed`. A damaged file is made again, with a warning. Throws
/// Error(resources) if the directory cannot be written.
Image groundTruth(Scene scene, const Tracer& tracer, const std::string& contentKey, int spp,
                  std::uint64_t seed, const std::string& directory, Monitor& monitor);

/// "slant" in the user's cache directory (XDG Base Directory Specification). Throws Error(usage) if the
/// environment names neither that nor a home.
std::string defaultCacheDirectory();

/// Makes the directory where it is missing. Throws Error(resources) if that fails.
void makeDirectory(const std::string& path);

} // namespace slant
