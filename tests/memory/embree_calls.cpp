// SPDX-License-Identifier: Apache-2.0
// Compiled alone: it defines functions that other sources take from Embree.
// Embree 3.13 does not survive its own want of memory: the build that follows a failed one reads and writes what that
// one freed. So memory does not run out within it; what we take between its calls does. In place of Embree's functions
// a binary that links this calls those here, which call Embree's.
#include "allocation_count.h"

#include <embree3/rtcore.h>

#include <cstdlib>
#include <dlfcn.h>

namespace {

/// Embree's function of this name.
template <class Function>
Function* real(const char* name)
{
    void* const found = dlsym(RTLD_NEXT, name);
    if (found == nullptr) {
        std::abort();
    }
    return reinterpret_cast<Function*>(found);
}

} // namespace

#define GNOMON_SPARED(result, name, parameters, names)                                                                 \
    RTC_API result name parameters                                                                                     \
    {                                                                                                                  \
        static auto* const next = real<decltype(name)>(#name);                                                         \
        const gnomon::test::SpareHeap spare;                                                                           \
        return next names;                                                                                             \
    }

// clang-format off
GNOMON_SPARED(RTCDevice, rtcNewDevice, (const char* config), (config))
GNOMON_SPARED(void, rtcReleaseDevice, (RTCDevice d), (d))
GNOMON_SPARED(RTCError, rtcGetDeviceError, (RTCDevice d), (d))
GNOMON_SPARED(ssize_t, rtcGetDeviceProperty, (RTCDevice d, RTCDeviceProperty p), (d, p))
GNOMON_SPARED(RTCScene, rtcNewScene, (RTCDevice d), (d))
GNOMON_SPARED(void, rtcReleaseScene, (RTCScene s), (s))
GNOMON_SPARED(void, rtcSetSceneFlags, (RTCScene s, RTCSceneFlags f), (s, f))
GNOMON_SPARED(void, rtcSetSceneProgressMonitorFunction, (RTCScene s, RTCProgressMonitorFunction f, void* p), (s, f, p))
GNOMON_SPARED(void, rtcCommitScene, (RTCScene s), (s))
GNOMON_SPARED(unsigned, rtcAttachGeometry, (RTCScene s, RTCGeometry g), (s, g))
GNOMON_SPARED(void, rtcAttachGeometryByID, (RTCScene s, RTCGeometry g, unsigned id), (s, g, id))
GNOMON_SPARED(RTCGeometry, rtcNewGeometry, (RTCDevice d, RTCGeometryType t), (d, t))
GNOMON_SPARED(void, rtcReleaseGeometry, (RTCGeometry g), (g))
GNOMON_SPARED(void, rtcCommitGeometry, (RTCGeometry g), (g))
GNOMON_SPARED(void*, rtcSetNewGeometryBuffer,
              (RTCGeometry g, RTCBufferType t, unsigned slot, RTCFormat f, std::size_t stride, std::size_t count),
              (g, t, slot, f, stride, count))
GNOMON_SPARED(void, rtcSetSharedGeometryBuffer,
              (RTCGeometry g, RTCBufferType t, unsigned slot, RTCFormat f, const void* from, std::size_t offset,
               std::size_t stride, std::size_t count), (g, t, slot, f, from, offset, stride, count))
GNOMON_SPARED(void, rtcSetGeometryInstancedScene, (RTCGeometry g, RTCScene s), (g, s))
GNOMON_SPARED(void, rtcSetGeometryTransform, (RTCGeometry g, unsigned step, RTCFormat f, const void* from),
              (g, step, f, from))
GNOMON_SPARED(void, rtcIntersect1, (RTCScene s, RTCIntersectContext* c, RTCRayHit* r), (s, c, r))
GNOMON_SPARED(void, rtcOccluded8, (const int* valid, RTCScene s, RTCIntersectContext* c, RTCRay8* r), (valid, s, c, r))
// clang-format on
