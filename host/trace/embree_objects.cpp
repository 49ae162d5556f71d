#include "trace/embree_objects.h"

#include "base/error.h"

#include <exception>
#include <mutex>

namespace slant::embree {
namespace {

/// Lets the monitor stop a build: Embree's callback may not throw, so the exception waits.
struct BuildWatch {
    Monitor& monitor;
    std::mutex mutex;
    std::exception_ptr stopped;

    static bool goOn(void* self, double) {
        auto& watch = *static_cast<BuildWatch*>(self);
        try {
            watch.monitor.advance(0);
            return true;
        } catch (...) {
            const std::lock_guard lock(watch.mutex);
            watch.stopped = std::current_exception();
            return false;
        }
    }
};

} // namespace

void check(RTCDevice device) {
    RTCError code = rtcGetDeviceError(device);
    if (code == RTC_ERROR_NONE) return;
    if (code == RTC_ERROR_OUT_OF_MEMORY)
        throw Error(ErrorCode::resources, "out of memory while building the ray tracing structure");
    throw Error(ErrorCode::resources, fmt::format("Embree failed with error {}", int(code)));
}

ScenePointer newScene(RTCDevice device) {
    ScenePointer scene(rtcNewScene(device));
    check(device);
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    return scene;
}

GeometryPointer newGeometry(RTCDevice device, RTCGeometryType type) {
    GeometryPointer geometry(rtcNewGeometry(device, type));
    check(device);
    return geometry;
}

void attach(RTCDevice device, RTCScene scene, RTCGeometry geometry, std::size_t id) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, unsigned(id));
    check(device);
}

void commit(RTCDevice device, RTCScene scene, Monitor& monitor) {
    BuildWatch watch{monitor, {}, nullptr};
    rtcSetSceneProgressMonitorFunction(scene, BuildWatch::goOn, &watch);
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    if (watch.stopped) std::rethrow_exception(watch.stopped);
    check(device);
}

} // namespace slant::embree
