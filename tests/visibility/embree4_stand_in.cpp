// Not Embree: a library with the signatures of Embree 4 that answers by trying every triangle. It stands in for Embree
// 4 where only Embree 3 is installed, and it is strict: a caller who takes it for an Embree 3, or misaligns a packet,
// is aborted. What it says of itself comes from the environment: RADVOR_STAND_IN_VERSION [40301],
// RADVOR_STAND_IN_LANES, the widest packet it takes natively [16], RADVOR_STAND_IN_CULLS [0].
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#define STAND_IN extern "C" __attribute__((visibility("default")))

namespace {

template <int N>
struct alignas(N == 1 ? 16 : 4 * N) RayPacket {
  float origin[3][N], near_t[N], direction[3][N], time[N], far_t[N];
  std::uint32_t mask[N], id[N], flags[N];
};

template <int N>
struct HitPacket {
  RayPacket<N> ray;
  float normal[3][N], u[N], v[N];
  std::uint32_t primitive[N], geometry[N], instance[N];
};

struct Arguments {
  std::uint32_t flags, features;
  void *context, *filter, *occluded;
};

struct Geometry {
  const float* vertices = nullptr;
  const std::uint32_t* indices = nullptr;
  std::size_t triangles = 0;
};

struct Scene {
  std::vector<Geometry> geometries;
  bool committed = false;
};

using ErrorFunction = void (*)(void*, int, const char*);
using MemoryMonitor = bool (*)(void*, std::ptrdiff_t, bool);

struct Device {
  int references = 1;
};

struct Vector {
  double x, y, z;
};
Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

[[noreturn]] void refuse(const char* what) {
  std::fprintf(stderr, "embree4_stand_in: %s\n", what);
  std::abort();
}

std::ptrdiff_t setting(const char* name, std::ptrdiff_t otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atol(text) : otherwise;
}

std::atomic<int> packets[17];  // traced, by lanes

// The nearest triangle with first <= t <= last, whose t last becomes; or -1.
std::ptrdiff_t nearest(const Scene* scene, const Vector& origin, const Vector& direction, double first, double& last) {
  std::ptrdiff_t found = -1;
  if (!scene->committed) {
    refuse("the scene was not committed");
  }
  for (const Geometry& geometry : scene->geometries) {
    for (std::size_t triangle = 0; triangle < geometry.triangles; ++triangle) {
      Vector corner[3];
      for (int i = 0; i < 3; ++i) {
        const std::size_t index = geometry.indices[3 * triangle + static_cast<unsigned>(i)];
        const float* vertex = geometry.vertices + 3 * index;
        corner[i] = Vector{vertex[0], vertex[1], vertex[2]} - origin;
      }
      const double side[3] = {dot(direction, cross(corner[0], corner[1])), dot(direction, cross(corner[1], corner[2])),
                              dot(direction, cross(corner[2], corner[0]))};
      const bool inside =
          (side[0] >= 0 && side[1] >= 0 && side[2] >= 0) || (side[0] <= 0 && side[1] <= 0 && side[2] <= 0);
      const Vector normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
      const double slope = dot(normal, direction);
      const double t = dot(normal, corner[0]) / slope;
      if (inside && slope != 0 && t >= first && t <= last) {
        found = static_cast<std::ptrdiff_t>(triangle);
        last = t;
      }
    }
  }
  return found;
}

// on_hit(lane, triangle, t) for each lane that meets something.
template <int N, class OnHit>
void trace(const int* valid, const Scene* scene, const RayPacket<N>& rays, const Arguments* arguments, OnHit on_hit) {
  if (reinterpret_cast<std::uintptr_t>(&rays) % alignof(RayPacket<N>) != 0 ||
      reinterpret_cast<std::uintptr_t>(valid) % (N == 1 ? 1 : alignof(RayPacket<N>)) != 0) {
    refuse("a misaligned packet");
  }
  if (arguments && (arguments->features != 0xffffffffu || (arguments->flags & ~0x10000u) != 0 || arguments->context ||
                    arguments->filter || arguments->occluded)) {
    refuse("arguments that radvor never passes");
  }
  ++packets[N];
  for (int lane = 0; lane < N; ++lane) {
    if (valid && valid[lane] != -1 && valid[lane] != 0) {
      refuse("a lane neither valid nor not");
    }
    if (valid && valid[lane] == 0) {
      continue;
    }
    double last = rays.far_t[lane];
    const Vector origin{rays.origin[0][lane], rays.origin[1][lane], rays.origin[2][lane]};
    const Vector direction{rays.direction[0][lane], rays.direction[1][lane], rays.direction[2][lane]};
    const std::ptrdiff_t triangle = nearest(scene, origin, direction, rays.near_t[lane], last);
    if (triangle >= 0) {
      on_hit(lane, triangle, last);
    }
  }
}

template <int N>
void occlude(const int* valid, const Scene* scene, RayPacket<N>* rays, const Arguments* arguments) {
  trace<N>(valid, scene, *rays, arguments,
           [&](int lane, std::ptrdiff_t, double) { rays->far_t[lane] = -std::numeric_limits<float>::infinity(); });
}

template <int N>
void intersect(const int* valid, const Scene* scene, HitPacket<N>* rays, const Arguments* arguments) {
  trace<N>(valid, scene, rays->ray, arguments, [&](int lane, std::ptrdiff_t triangle, double t) {
    rays->ray.far_t[lane] = static_cast<float>(t);
    rays->primitive[lane] = static_cast<std::uint32_t>(triangle);
    rays->geometry[lane] = 0;
    rays->instance[lane] = 0xffffffffu;
  });
}

}  // namespace

/// Packets of that many lanes traced so far.
STAND_IN int stand_in_packets(int lanes) {
  return packets[lanes];
}

STAND_IN Device* rtcNewDevice(const char* configuration) {
  if (configuration && configuration[0] != '\0') {
    refuse("a device configuration");  // threads= above all
  }
  return new Device;
}
STAND_IN void rtcReleaseDevice(Device* device) {
  delete device;
}
STAND_IN std::ptrdiff_t rtcGetDeviceProperty(Device*, int property) {
  switch (property) {
    case 0:
      return setting("RADVOR_STAND_IN_VERSION", 40301);
    case 32:
      return setting("RADVOR_STAND_IN_LANES", 16) >= 4;
    case 33:
      return setting("RADVOR_STAND_IN_LANES", 16) >= 8;
    case 34:
      return setting("RADVOR_STAND_IN_LANES", 16) >= 16;
    case 65:
      return setting("RADVOR_STAND_IN_CULLS", 0);
    case 96:
    case 128:
      return 1;
    default:
      return 0;
  }
}
STAND_IN int rtcGetDeviceError(Device*) {
  return 0;
}
STAND_IN void rtcSetDeviceErrorFunction(Device*, ErrorFunction, void*) {}
STAND_IN void rtcSetDeviceMemoryMonitorFunction(Device*, MemoryMonitor, void*) {}
STAND_IN Scene* rtcNewScene(Device*) {
  return new Scene;
}
STAND_IN void rtcReleaseScene(Scene* scene) {
  delete scene;
}
STAND_IN void rtcSetSceneFlags(Scene*, int) {}
STAND_IN void rtcSetSceneBuildQuality(Scene*, int) {}
STAND_IN Geometry* rtcNewGeometry(Device*, int type) {
  return type == 0 ? new Geometry : nullptr;
}
STAND_IN void rtcReleaseGeometry(Geometry* geometry) {
  delete geometry;
}
STAND_IN void rtcSetSharedGeometryBuffer(Geometry* geometry, int type, unsigned slot, int format, const void* data,
                                         std::size_t offset, std::size_t stride, std::size_t count) {
  if (slot != 0 || offset != 0 || stride != 12 || format != (type == 0 ? 0x5003 : 0x9003)) {
    refuse("a buffer of another shape");
  }
  if (type == 0) {
    geometry->indices = static_cast<const std::uint32_t*>(data);
    geometry->triangles = count;
  } else {
    geometry->vertices = static_cast<const float*>(data);
  }
}
STAND_IN void rtcCommitGeometry(Geometry*) {}
STAND_IN unsigned rtcAttachGeometry(Scene* scene, Geometry* geometry) {
  scene->geometries.push_back(*geometry);  // its buffers stay with the caller, who may now release it
  return 0;
}
STAND_IN void rtcCommitScene(Scene* scene) {
  scene->committed = true;
}
STAND_IN void rtcJoinCommitScene(Scene* scene) {
  scene->committed = true;
}

STAND_IN void rtcOccluded1(Scene* scene, RayPacket<1>* ray, Arguments* arguments) {
  occlude<1>(nullptr, scene, ray, arguments);
}
STAND_IN void rtcOccluded4(const int* valid, Scene* scene, RayPacket<4>* rays, Arguments* arguments) {
  occlude<4>(valid, scene, rays, arguments);
}
STAND_IN void rtcOccluded8(const int* valid, Scene* scene, RayPacket<8>* rays, Arguments* arguments) {
  occlude<8>(valid, scene, rays, arguments);
}
STAND_IN void rtcOccluded16(const int* valid, Scene* scene, RayPacket<16>* rays, Arguments* arguments) {
  occlude<16>(valid, scene, rays, arguments);
}
STAND_IN void rtcIntersect1(Scene* scene, HitPacket<1>* rays, Arguments* arguments) {
  intersect<1>(nullptr, scene, rays, arguments);
}
STAND_IN void rtcIntersect4(const int* valid, Scene* scene, HitPacket<4>* rays, Arguments* arguments) {
  intersect<4>(valid, scene, rays, arguments);
}
STAND_IN void rtcIntersect8(const int* valid, Scene* scene, HitPacket<8>* rays, Arguments* arguments) {
  intersect<8>(valid, scene, rays, arguments);
}
STAND_IN void rtcIntersect16(const int* valid, Scene* scene, HitPacket<16>* rays, Arguments* arguments) {
  intersect<16>(valid, scene, rays, arguments);
}
