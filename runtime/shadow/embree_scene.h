#pragma once
#include <embree3/rtcore.h>
#include <stdexcept>
#include <string>

namespace starbow {

/// An Embree device with a scene whose rays pass between no two triangles of an edge.
class EmbreeScene {
public:
    EmbreeScene()
        : device(rtcNewDevice(nullptr))
    {
        if (!device)
            throw std::runtime_error("rtcNewDevice: error " + std::to_string(rtcGetDeviceError(nullptr)));
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    }
    ~EmbreeScene()
    {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    EmbreeScene(const EmbreeScene&) = delete;

    /// Commits a geometry, and attaches it with that number. The scene holds it.
    void attach(RTCGeometry geometry, unsigned id)
    {
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, id);
        rtcReleaseGeometry(geometry);
    }
    /// Builds the scene of all attached geometries.
    void commit()
    {
        rtcCommitScene(scene);
        if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
            throw std::runtime_error("rtcCommitScene: error " + std::to_string(error));
    }

    RTCDevice device;
    RTCScene scene = nullptr;
};

} // namespace starbow
