// Reads pbrt-v4 scene text of the supported subset (scenes/README.md).
#pragma once
#include "scene/scene.h"

#include <string>

namespace slant {

class Monitor;

struct ReadOptions {
    /// What is not supported does not end in an error, but in a warning and a stand-in (scenes/README.md).
    bool lenient = false;
};

/// The scene of a file, plain or gzip. Names of other files in it are relative to its directory. Throws
/// InvalidScene (scene/issues.h) with file, line and column of whatever is malformed or outside the subset;
/// what cannot change the picture is ignored, what might surprise goes to `monitor.warn`.
Scene readScene(const std::string& path, Monitor& monitor, const ReadOptions& options = {});

/// The same for text in memory; `name` replaces the file name in messages and gives the directory.
Scene readSceneText(const std::string& text, const std::string& name, Monitor& monitor,
                    const ReadOptions& options = {});

} // namespace slant
