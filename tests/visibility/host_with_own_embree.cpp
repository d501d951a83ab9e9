// A host that carries an Embree of its own and exports its functions, as Blender does. Here they are traps: radvor must
// find the functions of the library that it loaded, and that library must not fall into them either.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "visibility/embree_visibility.h"
#include "visibility/sanitizers.h"
#include "visibility/triangle_soup.h"

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

namespace radvor {
namespace {

TEST(HostWithOwnEmbree, ExportsItsFunctions) {
  EXPECT_EQ(dlsym(RTLD_DEFAULT, "rtcNewDevice"), reinterpret_cast<void*>(&rtcNewDevice));
  EXPECT_EQ(dlsym(RTLD_DEFAULT, "rtcOccluded16"), reinterpret_cast<void*>(&rtcOccluded16));
}

TEST(HostWithOwnEmbree, DoesNotComeInTheWay) {
  RADVOR_SKIP_WITHOUT_EMBREE();
  for (const char* path : {"", RADVOR_EMBREE4_STAND_IN}) {
    const EmbreeLibrary library(path);
    Host host = make_host(2);
    const TriangleSoup ball = sphere(20, 30);
    const EmbreeVisibility embree(library, ball.occluders(), host);
    std::vector<Vec3> to;
    Random random(1);
    for (int i = 0; i < 100; ++i) {
      to.push_back((i % 2 == 0 ? 2.0 : 0.5) * random.direction());  // outside, inside
    }
    std::vector<std::uint8_t> blocked(to.size());
    embree.blocked_from(Vec3(0), to, blocked.data());
    for (std::size_t i = 0; i < to.size(); ++i) {
      EXPECT_EQ(blocked[i], i % 2 == 0);
    }
    EXPECT_NE(embree.first_hit(Vec3(0), Vec3(1, 2, 3)).triangle, FirstHit::k_miss);
  }
}

}  // namespace
}  // namespace radvor
