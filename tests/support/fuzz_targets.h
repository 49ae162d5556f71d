// Readers of untrusted bytes as fuzz targets: they succeed or throw Error, and nothing else.
#pragma once
#include "scene/ply.h"
#include "support/scene_text.h"

#include <string>

namespace slant::test {

/// Both return whether the bytes were accepted.
inline bool fuzzScene(const std::string& bytes) {
    try {
        sceneOf(bytes);
        return true;
    } catch (const Error&) {
        return false;
    }
}

inline bool fuzzPly(const std::string& bytes) {
    try {
        parsePly(bytes, "fuzz.ply");
        return true;
    } catch (const Error&) {
        return false;
    }
}

} // namespace slant::test
