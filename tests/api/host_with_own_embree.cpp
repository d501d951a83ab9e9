// Bakes inside a host that carries an Embree of its own and exports its functions: linked to Embree plainly, radvor
// would find those and hit nothing.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include "api/shadowed_floor.h"
#include "support/own_embree.h"

namespace radvor::test {
namespace {

TEST(HostWithOwnEmbree, BakesCorrectly) {
  ASSERT_EQ(dlsym(RTLD_DEFAULT, "rtcOccluded16"), reinterpret_cast<void*>(&rtcOccluded16)) << "nothing clashes";
  bake_shadowed_floor(Engine());
  Lends embree4;
  embree4.embree_path = RADVOR_STAND_IN_EMBREE;
  bake_shadowed_floor(Engine(embree4));
}

}  // namespace
}  // namespace radvor::test
