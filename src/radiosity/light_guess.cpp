#include "radiosity/light_guess.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "radiosity/method.h"

namespace radvor {

namespace {

constexpr std::size_t k_most_asked = 16;  // sources, one packet
constexpr double k_not_asked = 0.1;       // of the light: what is not worth a ray

}  // namespace

Color LightGuess::at(const Receiver& receiver, Tracer& tracer) {
  aims_.clear();
  Color left(0.0), near(0.0);
  for (std::uint32_t source = 0; source < light_.source_count(); ++source) {
    const DirectLight::Aim aim = light_.aim(source, receiver);
    if (aim.near) {
      Sight sight;
      near += light_.irradiance(source, receiver, tracer, sight);
    } else if (sum(aim.irradiance) > 0) {
      aims_.push_back(aim);
      left += aim.irradiance;
    }
  }
  const double least = k_not_asked * sum(left);
  const std::size_t most = std::min(aims_.size(), k_most_asked);
  std::partial_sort(aims_.begin(), aims_.begin() + static_cast<std::ptrdiff_t>(most), aims_.end(),
                    [](const auto& a, const auto& b) { return sum(a.irradiance) > sum(b.irradiance); });
  std::array<Vec3, k_most_asked> at;
  std::size_t count = 0;
  for (; count < most && sum(left) > least; ++count) {
    at[count] = aims_[count].at;
    left -= aims_[count].irradiance;
  }
  if (count == 0) {
    return near;
  }
  std::array<std::uint8_t, k_most_asked> blocked;
  tracer.blocked_from(receiver.lifted, std::span(at.data(), count), blocked.data());
  Color seen(0.0);
  double asked = 0;
  for (std::size_t k = 0; k < count; ++k) {
    asked += sum(aims_[k].irradiance);
    seen += blocked[k] == 0 ? aims_[k].irradiance : Color(0.0);
  }
  return near + seen + glm::max(left, Color(0.0)) * (sum(seen) / asked);
}

}  // namespace radvor
