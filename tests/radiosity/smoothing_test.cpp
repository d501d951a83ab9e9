// Noise goes, what is linear stays, and nothing moves by more than noise explains.
#include "radiosity/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/hash.h"
#include "plain.h"

namespace radvor {
namespace {

double ramp(const Vec3& at) {
  return 3 + at.x - 0.5 * at.y;
}

double rms(std::span<const Color> values, const Surface& surface) {
  double squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double error = values[i].g - ramp(surface.sites()[surface.samples()[i].site].position);
    squares += error * error;
  }
  return std::sqrt(squares / static_cast<double>(values.size()));
}

class Smoothing : public testing::Test {
 protected:
  Smoothing() : bake(plain()), host(1), surface((*bake).surface()) {
    for (std::uint32_t i = 0; i < surface.samples().size(); ++i) {
      const double noise = 0.2 * (to_unit(mix(i + 1)) - 0.5);
      linear.push_back(Color(ramp(surface.sites()[surface.samples()[i].site].position)));
      noisy.push_back(linear.back() + noise);
    }
  }

  TestBake bake;
  TestHost host;
  const Surface& surface;
  std::vector<Color> linear, noisy;
};

TEST_F(Smoothing, KeepsWhatIsLinear) {
  const std::vector<Certainty> certain(linear.size(), Certainty{0.02, 10});
  std::vector<Color> values = linear;
  smooth(surface, certain, values, host.host);
  EXPECT_GT(values.size(), 400u);
  EXPECT_LT(rms(values, surface), 1e-12);
}

TEST_F(Smoothing, HalvesNoiseAtLeast) {
  const std::vector<Certainty> certain(linear.size(), Certainty{0.02, 10});
  std::vector<Color> values = noisy;
  smooth(surface, certain, values, host.host);
  EXPECT_LT(rms(values, surface), 0.5 * rms(noisy, surface));
}

TEST_F(Smoothing, LeavesAStepThatNoiseDoesNotExplain) {
  const std::vector<Certainty> certain(linear.size(), Certainty{0.001, 10});
  std::vector<Color> values;
  for (const Sample& sample : surface.samples()) {
    values.push_back(Color(sample.point.x < 0 ? 1.0 : 5.0));
  }
  const std::vector<Color> before = values;
  smooth(surface, certain, values, host.host);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(values[i].g, before[i].g, 1e-12);
  }
}

TEST_F(Smoothing, LeavesWhatIsCertainAndWhatNothingReaches) {
  for (const Certainty certainty : {Certainty{0, 10}, Certainty{0.02, 0.001}}) {
    const std::vector<Certainty> certain(linear.size(), certainty);
    std::vector<Color> values = noisy;
    smooth(surface, certain, values, host.host);
    EXPECT_TRUE(values == noisy);
  }
}

}  // namespace
}  // namespace radvor
