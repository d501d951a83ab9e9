#include "radiosity/clipped_form_factor.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "radiosity/form_factor.h"
#include "radiosity/visible_polygon.h"

namespace radvor {

namespace {

constexpr std::size_t k_room = 64;  // occluders that are kept at most

// Of the whole: what rounding leaves along the cuts of triangles that together hide everything.
constexpr double k_splinter = 1e-12;

}  // namespace

std::size_t cut_at_horizon(const Receiver& receiver, std::span<const Vec3> polygon, std::span<Vec3> part) {
  std::size_t size = 0;
  // A cut through a corner is not that corner twice: a side without length has no plane to be on either side of.
  const auto add = [&](const Vec3& corner) {
    if (size == 0 || corner != part[size - 1]) {
      part[size++] = corner;
    }
  };
  Vec3 last = polygon.back();
  double last_height = glm::dot(last - receiver.point, receiver.normal);
  for (const Vec3& corner : polygon) {
    const double height = glm::dot(corner - receiver.point, receiver.normal);
    if ((last_height < 0 && height > 0) || (last_height > 0 && height < 0)) {
      add(last + (corner - last) * (last_height / (last_height - height)));
    }
    if (height >= 0) {
      add(corner);
    }
    last = corner;
    last_height = height;
  }
  size -= size > 1 && part[size - 1] == part[0] ? 1 : 0;
  return size < 3 ? 0 : size;
}

namespace {

// What is left of the polygon goes to `measure` as a VisiblePolygon; where nothing was taken away, `whole` is the
// answer.
template <class Measure>
std::optional<double> clip(const Receiver& receiver, std::span<const Vec3> polygon, const Vec3& normal, double whole,
                           std::size_t most_occluders, Tracer& tracer, const OccluderTree& occluders,
                           const Measure& measure) {
  std::array<Vec3, k_max_clip_corners + 1> corners;
  const auto above = std::span<const Vec3>(corners).first(cut_at_horizon(receiver, polygon, corners));
  if (above.empty()) {
    return 0;
  }
  std::array<std::uint32_t, k_room> found;
  const auto room = std::span(found).first(std::min(most_occluders, k_room));
  const auto count = occluders.between(receiver.lifted, above, normal, tracer.lift(), room);
  if (!count) {
    return std::nullopt;
  }
  if (*count == 0) {
    ++tracer.counters.skipped_clear;
    return whole;
  }
  VisiblePolygon visible(receiver.lifted, above, normal, tracer.lift());
  for (std::size_t i = 0; i < *count && !visible.dark(); ++i) {
    if (!visible.subtract(occluders.triangle(found[i]))) {
      return std::nullopt;
    }
  }
  if (visible.whole()) {
    return whole;
  }
  tracer.counters.form_factors += visible.piece_count();
  const double seen = measure(visible.form_factor(receiver.point, receiver.normal));
  return seen > k_splinter * whole ? seen : 0;
}

}  // namespace

std::optional<double> clipped_form_factor(const Receiver& receiver, std::span<const Vec3> polygon, const Vec3& normal,
                                          double whole, std::size_t most_occluders, Tracer& tracer,
                                          const OccluderTree& occluders) {
  return clip(receiver, polygon, normal, whole, most_occluders, tracer, occluders, [](double seen) { return seen; });
}

std::optional<double> visible_share(const Receiver& receiver, std::span<const Vec3> polygon, const Vec3& normal,
                                    std::size_t most_occluders, Tracer& tracer, const OccluderTree& occluders) {
  return clip(receiver, polygon, normal, 1, most_occluders, tracer, occluders, [&](double seen) {
    const double all = polygon_form_factor(receiver.point, receiver.normal, polygon, normal);
    return all > 0 ? std::min(1.0, seen / all) : 0;
  });
}

}  // namespace radvor
