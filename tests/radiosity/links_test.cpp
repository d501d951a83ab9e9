// Links into a tree, as patches that shoot by themselves make them, against clipping element by element.
#include "radiosity/links.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "radiosity/clipped_form_factor.h"
#include "surface/made_surface.h"
#include "surface/solids.h"
#include "visibility/brute_force_visibility.h"

namespace radvor {
namespace {

// A room with a box that floats over its floor, and a patch of the floor that the box hides from a part of the ceiling.
class LinkMaking : public testing::Test {
 protected:
  LinkMaking() : made(room(), options()) {
    for (const Triangle& triangle : made.welded.triangles) {
      corners.insert(corners.end(), triangle.vertices.begin(), triangle.vertices.end());
    }
    const Occluders occluders{made.welded.positions, corners};
    visibility.emplace(occluders, std::pmr::get_default_resource());
    occluder_tree.emplace(occluders, std::pmr::get_default_resource());
    double nearest = 1e9;
    std::uint32_t patch = k_none;
    for (std::uint32_t p = 0; p < made.surface.patch_count(); ++p) {
      const Share& share = made.surface.shares()[made.surface.patch(p).front()];
      const double distance = glm::distance(share.centroid, Vec3(0.7, 1.05, 0));
      if (distance < nearest && made.facets.facets[share.facet].frame.normal.z > 0.5) {
        nearest = distance;
        patch = p;
      }
    }
    tree.emplace(made.surface, std::span(&patch, 1), made.host);
    light.resize(tree->nodes().size());
    for (const Element& element : tree->elements()) {
      light[element.node].radiosity = Color(1.0);
    }
    tree->pull(light, made.host);
  }

  static Scene room() {
    test::SceneBuilder builder(std::pmr::get_default_resource());
    builder.box({0, 0, 0}, {2, 2, 1}, true);
    builder.box({0.7, 0.8, 0.3}, {1.2, 1.3, 0.6}, false);
    return builder.take();
  }

  static SurfaceOptions options() {
    SurfaceOptions options;
    options.patch_spacing = 0.5;
    options.element_levels = 3;
    return options;
  }

  Receiver receiver(const Vec3& at, const Vec3& normal) const { return {at, at + normal * visibility->lift(), normal}; }

  double linked(const Receiver& at, const OccluderTree* occluders, Tracer& tracer) const {
    std::pmr::vector<Link> links;
    LinkMaker(*tree, occluders, {}, std::pmr::get_default_resource()).make(at, tree->roots(), tracer, links);
    double sum = 0;
    for (const Link& link : links) {
      sum += sent_along(link, light).g;
    }
    return sum;
  }

  double exact(const Receiver& at) const {
    Tracer tracer(*visibility);
    double sum = 0;
    for (const Element& element : tree->elements()) {
      const auto polygon = tree->polygon(element);
      const Vec3& normal = tree->nodes()[element.node].piece.normal;
      const double whole = polygon_form_factor(at.point, at.normal, polygon, normal);
      if (whole > 0) {
        sum += *clipped_form_factor(at, polygon, normal, whole, 64, tracer, *occluder_tree);
      }
    }
    return sum;
  }

  // Over the ceiling, from right above the box to where it hides little of the patch.
  std::vector<Receiver> ceiling() const {
    std::vector<Receiver> receivers;
    for (int i = 0; i < 24; ++i) {
      for (int j = 0; j < 24; ++j) {
        receivers.push_back(receiver({(i + 0.37) / 12, (j + 0.61) / 12, 1}, {0, 0, -1}));
      }
    }
    return receivers;
  }

  test::MadeSurface made;
  std::vector<std::uint32_t> corners;
  std::optional<BruteForceVisibility> visibility;
  std::optional<OccluderTree> occluder_tree;
  std::optional<ShootingTree> tree;
  std::vector<NodeLight> light;
};

TEST_F(LinkMaking, AgreesWithClippingWherePatchesAreHiddenInPart) {
  ASSERT_GT(tree->elements().size(), 40u);
  const OccluderTree* const none = nullptr;
  for (const OccluderTree* occluders : {&std::as_const(*occluder_tree), none}) {
    double squares = 0, all = 0, error = 0, sum = 0, whole = 0, hidden = 0;
    for (const Receiver& at : ceiling()) {
      Tracer tracer(*visibility);
      const double made_out = linked(at, occluders, tracer), right = exact(at);
      squares += (made_out - right) * (made_out - right);
      all += right * right;
      error += made_out - right;
      sum += right;
      double open = 0;
      for (const Element& element : tree->elements()) {
        open +=
            polygon_form_factor(at.point, at.normal, tree->polygon(element), tree->nodes()[element.node].piece.normal);
      }
      whole += right > 0.75 * open ? 1 : 0;
      hidden += right < 0.5 * open ? 1 : 0;
    }
    EXPECT_GT(whole, 20);
    EXPECT_GT(hidden, 20);
    EXPECT_LT(std::sqrt(squares / all), occluders != nullptr ? 0.05 : 0.1);
    EXPECT_LT(std::abs(error / sum), occluders != nullptr ? 0.01 : 0.02);
  }
}

TEST_F(LinkMaking, NeedsNoRayWhereNothingIsBetween) {
  Tracer tracer(*visibility);
  const Receiver beside = receiver({0, 1.05, 0.1}, {1, 0, 0});
  EXPECT_NEAR(linked(beside, &*occluder_tree, tracer), exact(beside), 0.02 * exact(beside));
  EXPECT_EQ(tracer.counters.rays, 0u);
  EXPECT_GT(tracer.counters.skipped_clear, 0u);
}

// What a receiver on a wall has behind itself is not there.
TEST_F(LinkMaking, CutsAtTheHorizon) {
  const TreeNode& root = tree->nodes()[tree->roots()[0]];
  const Receiver in_the_middle = receiver(root.piece.centroid + Vec3(0, 0, 0.05), {1, 0, 0});
  Tracer tracer(*visibility);
  EXPECT_NEAR(linked(in_the_middle, &*occluder_tree, tracer), exact(in_the_middle), 0.03 * exact(in_the_middle));
}

TEST(Horizon, ThroughCornersGivesEachOnce) {
  // Found by a read: a corner twice is a side without length, which has nothing in front of it.
  const std::array<Vec3, 4> square = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  for (const double off : {0.0, 1e-17, -1e-17, 1e-16, -1e-16, 1e-13}) {
    for (int turn = 0; turn < 4; ++turn) {
      const double angle = 0.78539816339744831 + turn * 1.5707963267948966;
      const Receiver receiver{{0.5 + off, 0.5, 0.5}, {0.5 + off, 0.5, 0.5}, {std::cos(angle), std::sin(angle), 0}};
      std::array<Vec3, 5> part;
      const std::size_t size = cut_at_horizon(receiver, square, part);
      ASSERT_GE(size, 3u);
      for (std::size_t k = 0; k < size; ++k) {
        EXPECT_NE(part[k], part[(k + 1) % size]) << off << " " << turn;
      }
    }
  }
}

}  // namespace
}  // namespace radvor
