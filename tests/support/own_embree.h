// For a program that plays a host with an Embree of its own and exports its functions, as Blender does. Here they are
// traps: radvor must find the functions of the library that it loaded, and that library must not fall into them either.
// Once in a program, which is linked with ENABLE_EXPORTS.
#pragma once

#include <cstdio>
#include <cstdlib>

#define TRAP(name)                                                                   \
  extern "C" __attribute__((visibility("default"))) void name() {                    \
    std::fputs("the host's own " #name " was called instead of Embree's\n", stderr); \
    std::abort();                                                                    \
  }

TRAP(rtcNewDevice)
TRAP(rtcRetainDevice)
TRAP(rtcReleaseDevice)
TRAP(rtcGetDeviceProperty)
TRAP(rtcGetDeviceError)
TRAP(rtcSetDeviceErrorFunction)
TRAP(rtcSetDeviceMemoryMonitorFunction)
TRAP(rtcNewScene)
TRAP(rtcRetainScene)
TRAP(rtcReleaseScene)
TRAP(rtcSetSceneFlags)
TRAP(rtcSetSceneBuildQuality)
TRAP(rtcAttachGeometry)
TRAP(rtcCommitScene)
TRAP(rtcJoinCommitScene)
TRAP(rtcNewGeometry)
TRAP(rtcRetainGeometry)
TRAP(rtcReleaseGeometry)
TRAP(rtcSetGeometryBuffer)
TRAP(rtcSetSharedGeometryBuffer)
TRAP(rtcSetNewGeometryBuffer)
TRAP(rtcCommitGeometry)
TRAP(rtcIntersect1)
TRAP(rtcIntersect4)
TRAP(rtcIntersect8)
TRAP(rtcIntersect16)
TRAP(rtcOccluded1)
TRAP(rtcOccluded4)
TRAP(rtcOccluded8)
TRAP(rtcOccluded16)

#undef TRAP
