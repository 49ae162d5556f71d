// Readers of untrusted bytes as fuzz targets: they succeed or throw Error, and nothing else.
#pragma once
#include "camera/aperture.h"
#include "camera/lens_system.h"
#include "image/picture.h"
#include "lightfield/deep_exr.h"
#include "lightfield/summary.h"
#include "lightfield/tlfr.h"
#include "reconstruct/cpu_reconstructor.h"
#include "scene/lens_file.h"
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

/// A lens file, as far as the lens focused at a distance.
inline bool fuzzLens(const std::string& bytes) {
    return accepts([&] {
        const LensPrescription lens = parseLens(bytes, "fuzz.dat");
        LensSystem(lens, lens.surfaces[lens.stop].diameter);
    });
}

/// The name of an aperture, as options and scenes give it.
inline bool fuzzAperture(const std::string& bytes) {
    return accepts([&] {
        if (const auto shape = parseAperture(bytes, {})) Aperture(*shape).at({0.3f, -0.9f});
    });
}

/// A sampled spectrum of light, of a reflectance and of a metal.
inline bool fuzzSpd(const std::string& bytes) {
    static const TempDir dir;
    writeText(dir.file("a.spd"), bytes);
    const std::string file = "[\"" + dir.file("a.spd") + "\"]";
    return accepts([&] {
        sceneOf("WorldBegin LightSource \"point\" \"spectrum I\" " + file +
                " Material \"diffuse\" \"spectrum reflectance\" " + file +
                " Material \"conductor\" \"spectrum eta\" " + file + " \"spectrum k\" " + file);
    });
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
