// Handles of Embree's objects, and its errors as ours.
#pragma once
#include "base/monitor.h"
#include "trace/embree.h"

#include <cstddef>
#include <memory>

namespace slant::embree {

struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct GeometryDeleter {
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using DevicePointer = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;
using ScenePointer = std::unique_ptr<RTCSceneTy, SceneDeleter>;
using GeometryPointer = std::unique_ptr<RTCGeometryTy, GeometryDeleter>;

/// Throws the error that Embree has recorded since the last call.
void check(RTCDevice device);

/// Each throws Error(resources) where Embree fails.
ScenePointer newScene(RTCDevice device);
GeometryPointer newGeometry(RTCDevice device, RTCGeometryType type);
/// Adds a finished geometry under the number `id`.
void attach(RTCDevice device, RTCScene scene, RTCGeometry geometry, std::size_t id);
/// Builds the scene; throws also what the monitor throws.
void commit(RTCDevice device, RTCScene scene, Monitor& monitor);

} // namespace slant::embree
