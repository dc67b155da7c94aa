#pragma once
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
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

// Embree 4 takes a query's context with its arguments.
#if RTC_VERSION_MAJOR >= 4
using RayContext = RTCRayQueryContext;
inline void begin_query(RayContext& context) { rtcInitRayQueryContext(&context); }
inline void find_first(RTCScene scene, RayContext& context, RTCRayHit& hit)
{
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &hit, &arguments);
}
inline void find_first_of(RTCScene scene, RayContext& context, const int* valid, RTCRayHit8& hits)
{
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect8(valid, scene, &hits, &arguments);
}
inline void find_any(RTCScene scene, RayContext& context, RTCRay& ray)
{
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded1(scene, &ray, &arguments);
}
#else
using RayContext = RTCIntersectContext;
inline void begin_query(RayContext& context) { rtcInitIntersectContext(&context); }
inline void find_first(RTCScene scene, RayContext& context, RTCRayHit& hit) { rtcIntersect1(scene, &context, &hit); }
inline void find_first_of(RTCScene scene, RayContext& context, const int* valid, RTCRayHit8& hits)
{
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect8(valid, scene, &context, &hits);
}
inline void find_any(RTCScene scene, RayContext& context, RTCRay& ray) { rtcOccluded1(scene, &context, &ray); }
#endif

} // namespace starbow
