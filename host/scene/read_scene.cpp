#include "scene/read_scene.h"

#include "base/monitor.h"
#include "scene/interpreter.h"

#include <filesystem>

namespace slant {

Scene readScene(const std::string& path, Monitor& monitor, const ReadOptions& options) {
    Scene scene = readSceneText(readBytes(path, {}), path, monitor, options);
    scene.files.insert(scene.files.begin(), path);
    return scene;
}

Scene readSceneText(const std::string& text, const std::string& name, Monitor& monitor,
                    const ReadOptions& options) {
    Scene scene;
    scene.path = name;
    Issues issues(options.lenient);
    try {
        Interpreter interpreter(std::filesystem::path(name).parent_path().string(), scene, issues, monitor);
        interpreter.run(name, text);
        interpreter.finish();
    } catch (const Error& error) {
        if (error.code() != ErrorCode::badInput) throw;
        issues.finish(monitor, error);
    }
    issues.finish(monitor);
    return scene;
}

} // namespace slant
