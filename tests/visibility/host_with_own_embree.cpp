// Questions of visibility inside a host that carries an Embree of its own and exports its functions.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include "support/own_embree.h"
#include "visibility/embree_visibility.h"
#include "visibility/sanitizers.h"
#include "visibility/triangle_soup.h"

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
