#include "scene/closest_weights.h"

namespace radvor {

Vec3 closest_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double ab_a = dot(ab, p - a);
  const double ac_a = dot(ac, p - a);
  if (ab_a <= 0 && ac_a <= 0) {
    return {1, 0, 0};
  }
  const double ab_b = dot(ab, p - b);
  const double ac_b = dot(ac, p - b);
  if (ab_b >= 0 && ac_b <= ab_b) {
    return {0, 1, 0};
  }
  const double over_ab = ab_a * ac_b - ab_b * ac_a;
  if (over_ab <= 0 && ab_a >= 0 && ab_b <= 0) {
    const double along = ab_a / (ab_a - ab_b);
    return {1 - along, along, 0};
  }
  const double ab_c = dot(ab, p - c);
  const double ac_c = dot(ac, p - c);
  if (ac_c >= 0 && ab_c <= ac_c) {
    return {0, 0, 1};
  }
  const double over_ac = ab_c * ac_a - ab_a * ac_c;
  if (over_ac <= 0 && ac_a >= 0 && ac_c <= 0) {
    const double along = ac_a / (ac_a - ac_c);
    return {1 - along, 0, along};
  }
  const double over_bc = ab_b * ac_c - ab_c * ac_b;
  if (over_bc <= 0 && ac_b - ab_b >= 0 && ab_c - ac_c >= 0) {
    const double along = (ac_b - ab_b) / ((ac_b - ab_b) + (ab_c - ac_c));
    return {0, 1 - along, along};
  }
  const double scale = 1 / (over_bc + over_ac + over_ab);
  return {over_bc * scale, over_ac * scale, over_ab * scale};
}

}  // namespace radvor
