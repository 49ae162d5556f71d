#include "scene/read_scene.h"

#include "base/monitor.h"
#include "scene/interpreter.h"

#include <filesystem>

namespace slant {

Scene readScene(const std::string& path, Monitor& monitor) {
    Scene scene = readSceneText(readBytes(path, {}), path, monitor);
    scene.files.insert(scene.files.begin(), path);
    return scene;
}

Scene readSceneText(const std::string& text, const std::string& name, Monitor& monitor) {
    Scene scene;
    scene.path = name;
    Interpreter interpreter(std::filesystem::path(name).parent_path().string(), scene, monitor);
    interpreter.run(name, text);
    interpreter.finish();
    return scene;
}

} // namespace slant
