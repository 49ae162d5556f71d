// Scenes from text, for tests of the reader.
#pragma once
#include "base/error.h"
#include "base/monitor.h"
#include "scene/read_scene.h"

#include <string>
#include <vector>

namespace slant::test {

/// Keeps what it is warned of.
class RecordingMonitor final : public Monitor {
public:
    void beginStage(std::string_view, std::uint64_t, std::string_view) override {}
    void advance(std::uint64_t) override {}
    void endStage() override {}
    void warn(std::string_view message) override { warnings.emplace_back(message); }

    std::vector<std::string> warnings;
};

inline Scene sceneOf(const std::string& text) {
    SilentMonitor monitor;
    return readSceneText(text, "s.pbrt", monitor);
}

/// The scene of what stands after WorldBegin.
inline Scene worldOf(const std::string& text) {
    return sceneOf("WorldBegin\n" + text);
}

/// The message that reading ends with; "" if there is none.
inline std::string errorOf(const std::string& text) {
    try {
        sceneOf(text);
    } catch (const Error& error) {
        return error.code() == ErrorCode::badInput ? error.what()
                                                   : "not badInput: " + std::string(error.what());
    }
    return "";
}

} // namespace slant::test
