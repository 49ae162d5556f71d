// Readers of untrusted bytes as fuzz targets: they succeed or throw Error, and nothing else.
#pragma once
#include "image/picture.h"
#include "lightfield/deep_exr.h"
#include "lightfield/summary.h"
#include "lightfield/tlfr.h"
#include "reconstruct/cpu_reconstructor.h"
#include "scene/ply.h"
#include "support/memory_file.h"
#include "support/scene_text.h"
#include "support/temp_dir.h"

#include <string>

namespace slant::test {

/// Whether `read` accepted the bytes.
template <typename Read>
bool accepts(const Read& read) {
    try {
        read();
        return true;
    } catch (const Error&) {
        return false;
    }
}

inline bool fuzzScene(const std::string& bytes) {
    return accepts([&] { sceneOf(bytes); });
}

inline bool fuzzPly(const std::string& bytes) {
    return accepts([&] { parsePly(bytes, "fuzz.ply"); });
}

/// Of any kind; what is none of the others is taken for TGA.
inline bool fuzzPicture(const std::string& bytes) {
    static const TempDir dir;
    writeText(dir.file("a.tga"), bytes);
    return accepts([&] { readPicture(dir.file("a.tga")); });
}

/// What is accepted goes through the next stages, if it is small.
inline void useField(LightField& field) {
    summarize(field);
    sanitize(field);
    if (field.samples.size() > 300) return;
    SilentMonitor monitor;
    ReconstructReport report;
    ReconstructOptions options;
    options.method = Method::full;
    options.outputsPerPixel = 1;
    CpuReconstructor().reconstruct(field, options, monitor, report, nullptr);
}

inline bool fuzzDeepExr(const std::string& bytes) {
    return accepts([&] {
        SilentMonitor monitor;
        FieldFile file = readDeepExr(MemoryFile(bytes).path(), monitor);
        useField(file.field);
    });
}

/// Header and body with a zero byte between.
inline bool fuzzTlfr(const std::string& bytes) {
    const std::size_t end = std::min(bytes.find('\0'), bytes.size());
    return accepts([&] {
        SilentMonitor monitor;
        const MemoryFile header(bytes.substr(0, end)), body(bytes.substr(std::min(end + 1, bytes.size())));
        FieldFile file = readTlfr(body.path(), header.path(), monitor);
        useField(file.field);
    });
}

} // namespace slant::test
