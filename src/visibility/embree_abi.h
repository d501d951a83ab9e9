// What radvor needs of Embree's C interface, declared here because no Embree is needed to build radvor: facts of the
// binary interface, from the API references of 3.13 and 4.x. The only file that knows them.
//
// The two differ in three ways that matter here:
// - 3 takes (valid, scene, context, rays), 4 takes (valid, scene, rays, arguments). Called the other way round a packet
//   hits nothing, silently: never call without having asked for the version.
// - 3 demands the context; 4 takes NULL for its arguments and means their defaults.
// - 3 has ray streams, 4 has none: not used.
// Layouts of the context, the arguments and the hit depend on how an Embree was built (instance levels, instance
// arrays, minimal width). All are padded here for the largest, and 0 is right for every field that is not named.
#pragma once

#include <cstddef>
#include <cstdint>

namespace radvor::embree {

struct Device;
struct Scene;
struct Geometry;

// Numbers of RTC_* enumerators, equal in 3 and 4.
constexpr int k_property_version = 0;  ///< major * 10000 + minor * 100 + patch
constexpr int k_property_native_ray4 = 32;
constexpr int k_property_native_ray8 = 33;
constexpr int k_property_native_ray16 = 34;
constexpr int k_property_backface_culling = 65;
constexpr int k_property_triangles = 96;
constexpr int k_property_tasking_system = 128;
constexpr std::ptrdiff_t k_tasking_internal = 0;
constexpr int k_error_out_of_memory = 4;
constexpr int k_geometry_triangles = 0;
constexpr int k_buffer_indices = 0;
constexpr int k_buffer_vertices = 1;
constexpr int k_format_uint3 = 0x5003;
constexpr int k_format_float3 = 0x9003;
constexpr int k_quality_medium = 1;
constexpr int k_scene_robust = 1 << 2;
constexpr std::uint32_t k_no_geometry = 0xffffffffu;

/// RTCRay, RTCRay4, RTCRay8, RTCRay16. A ray covers origin + t * direction, t_near <= t <= t_far; of an occluded one
/// t_far becomes -infinity, of an intersected one the distance.
template <int N>
struct alignas(N == 1 ? 16 : 4 * N) Rays {
  float origin_x[N], origin_y[N], origin_z[N], t_near[N];
  float direction_x[N], direction_y[N], direction_z[N], time[N];
  float t_far[N];
  std::uint32_t mask[N], id[N], flags[N];
};
static_assert(sizeof(Rays<1>) == 48 && sizeof(Rays<4>) == 192 && sizeof(Rays<8>) == 384 && sizeof(Rays<16>) == 768);

/// RTCRayHit, RTCRayHit4, RTCRayHit8, RTCRayHit16.
template <int N>
struct RayHits {
  Rays<N> ray;
  float normal_x[N], normal_y[N], normal_z[N];  // orientation and length are Embree's own: not used
  float u[N], v[N];
  std::uint32_t primitive[N], geometry[N];
  std::uint32_t instances[33 * N];  // N or more are written
};
static_assert(offsetof(RayHits<1>, normal_x) == 48 && offsetof(RayHits<1>, instances) == 76);
static_assert(offsetof(RayHits<16>, normal_x) == 768 && offsetof(RayHits<16>, instances) == 1216);

/// RTCIntersectContext of Embree 3: flags, then filter (none), instance stack and minimal width, which are all 0.
struct alignas(16) Context3 {
  static constexpr std::uint32_t k_coherent = 1;

  std::uint32_t flags = 0;
  std::uint32_t zero[63] = {};
};

/// RTCOccludedArguments and RTCIntersectArguments of Embree 4: flags, feature mask (all), then context (its default),
/// callbacks (none) and minimal width, which are all 0.
struct alignas(16) Arguments4 {
  static constexpr std::uint32_t k_coherent = 1u << 16;

  std::uint32_t flags = 0;
  std::uint32_t features = 0xffffffffu;
  std::uint32_t zero[62] = {};
};

// Signatures equal in 3 and 4.
using NewDevice = Device* (*)(const char* configuration);
using ReleaseDevice = void (*)(Device*);
using GetDeviceProperty = std::ptrdiff_t (*)(Device*, int property);
using GetDeviceError = int (*)(Device*);
using ErrorFunction = void (*)(void* user, int code, const char* text);
using SetDeviceErrorFunction = void (*)(Device*, ErrorFunction, void* user);
using MemoryMonitor = bool (*)(void* user, std::ptrdiff_t bytes, bool post);
using SetDeviceMemoryMonitorFunction = void (*)(Device*, MemoryMonitor, void* user);
using NewScene = Scene* (*)(Device*);
using ReleaseScene = void (*)(Scene*);
using SetSceneFlags = void (*)(Scene*, int flags);
using SetSceneBuildQuality = void (*)(Scene*, int quality);
using AttachGeometry = unsigned (*)(Scene*, Geometry*);
using CommitScene = void (*)(Scene*);
using NewGeometry = Geometry* (*)(Device*, int type);
using ReleaseGeometry = void (*)(Geometry*);
using SetSharedGeometryBuffer = void (*)(Geometry*, int type, unsigned slot, int format, const void* data,
                                         std::size_t offset, std::size_t stride, std::size_t count);
using CommitGeometry = void (*)(Geometry*);

// Signatures that differ. valid: -1 for a lane that takes part, 0 for one that doesn't; aligned like the rays.
using Intersect1In3 = void (*)(Scene*, Context3*, RayHits<1>*);
using Intersect1In4 = void (*)(Scene*, RayHits<1>*, Arguments4*);
template <int N>
using IntersectIn3 = void (*)(const int* valid, Scene*, Context3*, RayHits<N>*);
template <int N>
using IntersectIn4 = void (*)(const int* valid, Scene*, RayHits<N>*, Arguments4*);
using Occluded1In3 = void (*)(Scene*, Context3*, Rays<1>*);
using Occluded1In4 = void (*)(Scene*, Rays<1>*, Arguments4*);
template <int N>
using OccludedIn3 = void (*)(const int* valid, Scene*, Context3*, Rays<N>*);
template <int N>
using OccludedIn4 = void (*)(const int* valid, Scene*, Rays<N>*, Arguments4*);

}  // namespace radvor::embree
