#include "output/vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory_resource>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "output/mesh_facets.h"
#include "output/vertex_fit.h"

namespace radvor {
namespace {

/// Light at the corners of one facet's triangles. Most are sites; what lies inside a merged facet is between sites, and
/// where a facet touches itself in a point, several shares meet there.
class CornerLight {
 public:
  CornerLight(const LitSurface& lit, Quantity quantity, bool back)
      : lit_(lit), quantity_(quantity), back_(back), at_vertices_(&lit.host.memory) {}

  void open(std::uint32_t facet) {
    facet_ = facet;
    at_vertices_.clear();
    for (const ShareTriangle& triangle : lit_.surface.triangles(facet)) {
      for (const std::uint32_t share : triangle) {
        const std::uint32_t vertex = vertex_of(share);
        if (vertex != k_none) {
          at_vertices_.push_back({vertex, lit_.surface.shares()[share].sample, share});
        }
      }
    }
    std::ranges::sort(at_vertices_, {}, [](const AtVertex& at) { return std::tuple(at.vertex, at.sample, at.share); });
    const auto same_light = [](const AtVertex& one, const AtVertex& other) {
      return one.vertex == other.vertex && one.sample == other.sample;  // shares of one sample show the same light
    };
    at_vertices_.erase(std::unique(at_vertices_.begin(), at_vertices_.end(), same_light), at_vertices_.end());
  }

  Color at(const Triangle& triangle, std::size_t corner) const {
    const std::uint32_t vertex = triangle.vertices[corner];
    const auto first = std::ranges::lower_bound(at_vertices_, vertex, {}, &AtVertex::vertex);
    const auto last = std::ranges::upper_bound(first, at_vertices_.end(), vertex, {}, &AtVertex::vertex);
    if (last - first == 1) {
      return of_share(first->share);
    }
    // A little inside the triangle, so that the light is this triangle's; nothing is lost at that distance.
    constexpr double k_inside = 0x1p-30;
    const Frame& frame = lit_.surface.facets().facets[facet_].frame;
    std::array<Vec2, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = frame.to_plane(lit_.surface.welded().positions[triangle.vertices[i]]);
    }
    const Vec2 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const FacetPoint point = lit_.surface.locate(facet_, corners[corner] + k_inside * (middle - corners[corner]));
    for (const std::uint32_t share : point.shares) {
      if (vertex_of(share) == vertex) {
        return of_share(share);
      }
    }
    return value_at(lit_, quantity_, point, back_);
  }

 private:
  struct AtVertex {
    std::uint32_t vertex, sample, share;
  };

  std::uint32_t vertex_of(std::uint32_t share) const {
    const Surface& surface = lit_.surface;
    return surface.sites()[surface.samples()[surface.shares()[share].sample].site].vertex;
  }

  Color of_share(std::uint32_t front) const {
    return value_at(lit_, quantity_, back_ ? lit_.surface.shares()[front].other_side : front);
  }

  const LitSurface& lit_;
  Quantity quantity_;
  bool back_;
  std::uint32_t facet_ = k_none;
  std::pmr::vector<AtVertex> at_vertices_;
};

struct Mean {
  Color sum{0.0};
  double weight = 0;

  void add(const Mean& more) {
    sum += more.sum;
    weight += more.weight;
  }
  Color value() const { return weight > 0 ? sum / weight : Color(0.0); }
};

double corner_angle(const WeldedScene& welded, const Triangle& triangle, std::size_t corner) {
  const Vec3& at = welded.positions[triangle.vertices[corner]];
  const Vec3 one = welded.positions[triangle.vertices[(corner + 1) % 3]] - at;
  const Vec3 other = welded.positions[triangle.vertices[(corner + 2) % 3]] - at;
  return std::atan2(length(cross(one, other)), dot(one, other));
}

/// Vertices that only dropped triangles use, or none, take the mean of those that were welded to the same position.
void fill_unused(std::span<const std::uint32_t> welded_vertex_of, std::pmr::vector<Mean>& means) {
  std::pmr::vector<std::uint32_t> order(means.get_allocator());
  for (std::uint32_t vertex = 0; vertex < means.size(); ++vertex) {
    order.push_back(vertex);
  }
  // Not stable_sort, whose buffer is not the host's memory.
  std::ranges::sort(order, {}, [&](std::uint32_t vertex) { return std::pair(welded_vertex_of[vertex], vertex); });
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    Mean all;
    while (last < order.size() && welded_vertex_of[order[last]] == welded_vertex_of[order[first]]) {
      all.add(means[order[last++]]);
    }
    for (std::size_t i = first; i < last; ++i) {
      if (means[order[i]].weight == 0) {
        means[order[i]] = all;
      }
    }
  }
}

std::pmr::vector<Color> sample_vertices(const LitSurface& lit, std::uint32_t mesh, Quantity quantity, bool back) {
  const Surface& surface = lit.surface;
  const WeldedScene& welded = surface.welded();
  std::pmr::vector<Mean> means(surface.scene().meshes[mesh].positions.size(), &lit.host.memory);
  CornerLight light(lit, quantity, back);
  const FacetRange range = facets_of_mesh(surface.facets(), mesh);
  for (std::uint32_t facet = range.first; facet < range.last; ++facet) {
    if (surface.triangles(facet).empty() || (back && !two_sided(surface, facet))) {
      continue;
    }
    light.open(facet);
    for (const std::uint32_t index : surface.facets().triangles_of(facet)) {
      const Triangle& triangle = welded.triangles[index];
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const double angle = corner_angle(welded, triangle, corner);
        means[triangle.corners[corner]].add({angle * light.at(triangle, corner), angle});
      }
    }
  }
  if (std::ranges::any_of(means, [](const Mean& mean) { return mean.weight == 0; })) {
    fill_unused(welded.vertex_of[mesh], means);
  }
  std::pmr::vector<Color> values(&lit.host.memory);
  values.reserve(means.size());
  for (const Mean& mean : means) {
    values.push_back(mean.value());
  }
  return values;
}

}  // namespace

void write_vertices(const LitSurface& lit, std::uint32_t mesh, Quantity quantity, bool back, VertexMode mode,
                    float* rgb, std::size_t stride) {
  std::pmr::vector<Color> values(&lit.host.memory);
  if (lit.surface.scene().meshes[mesh].receives) {
    values = sample_vertices(lit, mesh, quantity, back);
    if (mode == VertexMode::fit) {
      fit_vertices(lit, mesh, quantity, back, values);
    }
  } else {
    values.resize(lit.surface.scene().meshes[mesh].positions.size(), Color(0.0));
  }
  auto* out = reinterpret_cast<std::byte*>(rgb);
  for (const Color& value : values) {
    const std::array<float, 3> color = {static_cast<float>(value.r), static_cast<float>(value.g),
                                        static_cast<float>(value.b)};
    std::memcpy(out, color.data(), sizeof color);  // a stride need not keep floats aligned
    out += stride;
  }
}

}  // namespace radvor
