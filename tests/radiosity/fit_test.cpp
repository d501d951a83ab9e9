// Corners yield to what is found between them: the mean is right, the error is smaller, what is linear stays.
#include "radiosity/fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plain.h"

namespace radvor {
namespace {

struct Deviation {
  double mean = 0, rms = 0;
};

class Fit : public testing::Test {
 protected:
  Fit() : bake(plain()), host(1), surface((*bake).surface()) {
    const std::vector<std::uint8_t> all(surface.samples().size(), 1);
    const auto placed = place_probes(surface, 0, all, 0, host.host);
    probes.assign(placed.begin(), placed.end());
  }

  // Values at the samples and at the probes, and what is to be added to the former.
  template <class Light>
  void see(Light&& light) {
    for (const Sample& sample : surface.samples()) {
      values.emplace_back(light(surface.sites()[sample.site].position));
    }
    for (const Probe& probe : probes) {
      found.emplace_back(light(probe.receiver.point));
    }
    const auto to_add = fit_to_probes(surface, probes, found, values, host.host);
    for (std::size_t i = 0; i < values.size(); ++i) {
      fitted.push_back(values[i] + to_add[i]);
    }
  }

  // Of the interpolation over the inner triangles, by a rule that is exact to the fourth degree (D. Dunavant, 1985).
  template <class Light>
  Deviation deviation(const std::vector<Color>& corners, Light&& light) const {
    constexpr double k_a = 0.445948490915965, k_b = 0.091576213509771;
    constexpr double k_weight_a = 0.223381589678011, k_weight_b = 0.109951743655322;
    double area = 0, sum = 0, squares = 0;
    for (const Probe& probe : inner()) {
      for (std::size_t k = 0; k < 3; ++k) {
        for (const auto& [near, weight] : {std::pair(k_a, k_weight_a), std::pair(k_b, k_weight_b)}) {
          Vec3 at(0.0);
          double value = 0;
          for (std::size_t i = 0; i < 3; ++i) {
            const double share = i == k ? 1 - 2 * near : near;
            at += share * corner(probe, i);
            value += share * corners[probe.samples[i]].g;
          }
          const double error = value - light(at);
          area += weight * probe.area;
          sum += weight * probe.area * error;
          squares += weight * probe.area * error * error;
        }
      }
    }
    return {sum / area, std::sqrt(squares / area)};
  }

  double mean_of_squared_edges() const {
    double area = 0, sum = 0;
    for (const Probe& probe : inner()) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 edge = corner(probe, k) - corner(probe, (k + 1) % 3);
        sum += probe.area * glm::dot(edge, edge);
      }
      area += probe.area;
    }
    return sum / area;
  }

  Vec3 corner(const Probe& probe, std::size_t k) const {
    return surface.sites()[surface.samples()[probe.samples[k]].site].position;
  }

  // At the border corners have triangles on one side alone.
  std::vector<Probe> inner() const {
    std::vector<Probe> chosen;
    for (const Probe& probe : probes) {
      if (std::max(std::abs(probe.receiver.point.x), std::abs(probe.receiver.point.y)) <= 0.75) {
        chosen.push_back(probe);
      }
    }
    return chosen;
  }

  TestBake bake;
  TestHost host;
  const Surface& surface;
  std::vector<Probe> probes;
  std::vector<Color> values, found, fitted;
};

TEST_F(Fit, KeepsWhatIsLinear) {
  see([](const Vec3& at) { return 3 + at.x - 0.5 * at.y; });
  ASSERT_GT(probes.size(), 500u);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(fitted[i].g, values[i].g, 1e-12);
  }
}

// Interpolation of x^2 + y^2 is too large by the sum, over pairs of corners, of the product of their barycentric
// coordinates and their squared distance: on the mean by a twelfth of the squared edges. In each triangle of a lattice
// that is the same, so all of it goes, and what is left is the deviation about it.
TEST_F(Fit, MakesTheMeanOfAParabolaRight) {
  const auto light = [](const Vec3& at) { return 2 + at.x + at.x * at.x + at.y * at.y; };
  see(light);
  const Deviation before = deviation(values, light), after = deviation(fitted, light);
  EXPECT_NEAR(before.mean, mean_of_squared_edges() / 12, 1e-9);
  EXPECT_LT(std::abs(after.mean), 0.02 * before.mean);
  EXPECT_LT(after.rms, 0.45 * before.rms);
}

TEST_F(Fit, IsNoWorseAtAStep) {
  const auto light = [](const Vec3& at) { return at.x + 0.3 * at.y < 0.02 ? 1.0 : 5.0; };
  see(light);
  EXPECT_LT(deviation(fitted, light).rms, deviation(values, light).rms);
}

TEST_F(Fit, StaysWithinWhatWasFound) {
  see([](const Vec3& at) { return at.x + 0.3 * at.y < 0.02 ? 0.0 : 5.0; });
  for (const Color& value : fitted) {
    EXPECT_GE(value.g, 0);
    EXPECT_LE(value.g, 5);
  }
}

}  // namespace
}  // namespace radvor
