#include "scene/planar_parts.h"

#include <algorithm>
#include <cmath>

#include "scene/box_tree.h"
#include "scene/disjoint_sets.h"
#include "scene/position_welding.h"
#include "scene/shape.h"

namespace radvor {
namespace {

struct Plane {
  Vec3 normal;
  double offset;

  bool holds(const WeldedScene& welded, const Triangle& triangle, double tolerance) const {
    return std::ranges::all_of(triangle.vertices, [&](std::uint32_t vertex) {
      return std::abs(dot(normal, welded.positions[vertex]) - offset) <= tolerance;
    });
  }
};

Plane plane_of(const WeldedScene& welded, const Triangle& triangle) {
  const Vec3 normal = normalize(area_normal(welded, triangle));
  const auto [a, b, c] = positions_of(welded, triangle);
  return {normal, dot(normal, (a + b + c) / 3.0)};
}

double largest_precision(const WeldedScene& welded, const Triangle& triangle) {
  return std::max({welded.precision[triangle.vertices[0]], welded.precision[triangle.vertices[1]],
                   welded.precision[triangle.vertices[2]]});
}

double longest_side(const std::array<Vec3, 3>& p) {
  return std::max({length(p[1] - p[0]), length(p[2] - p[1]), length(p[0] - p[2])});
}

class Growth {
 public:
  Growth(const WeldedScene& welded, const std::pmr::vector<bool>& joins, std::pmr::memory_resource* memory)
      : welded_(welded),
        joins_(joins),
        labels_(welded.triangles.size(), k_none, memory),
        queue_(memory),
        seeds_(memory) {}

  std::span<const std::uint32_t> labels() const { return labels_; }

  void divide(std::span<const std::uint32_t> part) {
    const auto label = [&](std::span<const std::uint32_t> triangles) {
      for (const std::uint32_t t : triangles) {
        labels_[t] = part.front();
      }
    };
    if (part.size() == 1 || is_planar(part)) {
      label(part);
    } else {
      grow_from_seeds(part);
    }
  }

 private:
  bool is_planar(std::span<const std::uint32_t> part) const {
    Vec3 normal{0.0};
    double precision = 0;
    Box box;
    for (const std::uint32_t t : part) {
      normal += area_normal(welded_, welded_.triangles[t]);
      precision = std::max(precision, largest_precision(welded_, welded_.triangles[t]));
      for (const std::uint32_t vertex : welded_.triangles[t].vertices) {
        box.add(welded_.positions[vertex]);
      }
    }
    if (normal == Vec3(0.0)) {
      return false;
    }
    Plane plane{normalize(normal), 0};
    // The middle of the extremes is the best offset there is.
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const std::uint32_t t : part) {
      for (const std::uint32_t vertex : welded_.triangles[t].vertices) {
        const double offset = dot(plane.normal, welded_.positions[vertex]);
        low = std::min(low, offset);
        high = std::max(high, offset);
      }
    }
    plane.offset = 0.5 * (low + high);
    const double tolerance = planar_tolerance(precision, length(box.high - box.low));
    return 0.5 * (high - low) <= tolerance && std::ranges::all_of(part, [&](std::uint32_t t) {
             return dot(area_normal(welded_, welded_.triangles[t]), plane.normal) > 0;
           });
  }

  void grow_from_seeds(std::span<const std::uint32_t> part) {
    seeds_.clear();
    for (const std::uint32_t t : part) {
      const Vec3 normal = area_normal(welded_, welded_.triangles[t]);
      auto p = positions_of(welded_, welded_.triangles[t]);
      seeds_.push_back({dot(normal, normal), (p[0] + p[1]) + p[2], t});
    }
    std::ranges::sort(seeds_, [](const Seed& a, const Seed& b) {
      return a.size != b.size     ? a.size > b.size
             : a.place != b.place ? lies_before(a.place, b.place)
                                  : a.triangle < b.triangle;
    });
    for (const Seed& seed : seeds_) {
      if (labels_[seed.triangle] == k_none) {
        grow(seed.triangle);
      }
    }
  }

  void grow(std::uint32_t seed) {
    const Triangle& first = welded_.triangles[seed];
    const Plane plane = plane_of(welded_, first);
    const double size = longest_side(positions_of(welded_, first));
    labels_[seed] = seed;
    queue_.assign(1, seed);
    for (std::size_t at = 0; at < queue_.size(); ++at) {
      for (const EdgeUse& use : welded_.uses_of_triangle(queue_[at])) {
        if (!joins_[use.edge]) {
          continue;
        }
        for (const std::uint32_t other_use : welded_.uses_at_edge(use.edge)) {
          const std::uint32_t t = welded_.uses_by_triangle[other_use].triangle;
          const Triangle& triangle = welded_.triangles[t];
          if (labels_[t] == k_none && dot(area_normal(welded_, triangle), plane.normal) > 0 &&
              plane.holds(welded_, triangle, planar_tolerance(largest_precision(welded_, triangle), size))) {
            labels_[t] = seed;
            queue_.push_back(t);
          }
        }
      }
    }
  }

  struct Seed {
    double size;
    Vec3 place;
    std::uint32_t triangle;
  };
  const WeldedScene& welded_;
  const std::pmr::vector<bool>& joins_;
  std::pmr::vector<std::uint32_t> labels_;
  std::pmr::vector<std::uint32_t> queue_;
  std::pmr::vector<Seed> seeds_;
};

}  // namespace

TriangleGroups group_by(std::span<const std::uint32_t> labels, std::pmr::memory_resource* memory) {
  TriangleGroups groups(memory);
  std::pmr::vector<std::uint32_t> group_of_label(labels.size(), k_none, memory);
  std::uint32_t count = 0;
  groups.first.assign(1, 0);
  for (const std::uint32_t label : labels) {
    if (group_of_label[label] == k_none) {
      group_of_label[label] = count++;
      groups.first.push_back(0);
    }
    ++groups.first[group_of_label[label] + 1];
  }
  for (std::size_t g = 0; g < count; ++g) {
    groups.first[g + 1] += groups.first[g];
  }
  std::pmr::vector<std::uint32_t> next(groups.first.begin(), groups.first.end(), memory);
  groups.triangles.resize(labels.size());
  for (std::uint32_t t = 0; t < labels.size(); ++t) {
    groups.triangles[next[group_of_label[labels[t]]]++] = t;
  }
  return groups;
}

bool coplanar(const WeldedScene& welded, const Triangle& a, const Triangle& b) {
  const Vec3 normal_a = area_normal(welded, a);
  const Vec3 normal_b = area_normal(welded, b);
  constexpr double k_cos_bend = 0.984807753012208;  // 10 degrees
  if (!(dot(normal_a, normal_b) >= k_cos_bend * length(normal_a) * length(normal_b))) {
    return false;
  }
  const double size_a = longest_side(positions_of(welded, a));
  const double size_b = longest_side(positions_of(welded, b));
  const double tolerance =
      planar_tolerance(std::max(largest_precision(welded, a), largest_precision(welded, b)), std::max(size_a, size_b));
  return plane_of(welded, a).holds(welded, b, tolerance) || plane_of(welded, b).holds(welded, a, tolerance);
}

TriangleGroups planar_parts(const WeldedScene& welded, const std::pmr::vector<bool>& joins,
                            std::pmr::memory_resource* memory) {
  const auto count = static_cast<std::uint32_t>(welded.triangles.size());
  DisjointSets sets(count, memory);
  for (std::uint32_t e = 0; e < welded.edges.size(); ++e) {
    if (joins[e]) {
      const auto uses = welded.uses_at_edge(e);
      sets.unite(welded.uses_by_triangle[uses[0]].triangle, welded.uses_by_triangle[uses[1]].triangle);
    }
  }
  std::pmr::vector<std::uint32_t> roots(count, memory);
  for (std::uint32_t t = 0; t < count; ++t) {
    roots[t] = sets.find(t);
  }
  const TriangleGroups connected = group_by(roots, memory);
  Growth growth(welded, joins, memory);
  for (std::size_t i = 0; i < connected.size(); ++i) {
    growth.divide(connected[i]);
  }
  return group_by(growth.labels(), memory);
}

}  // namespace radvor
