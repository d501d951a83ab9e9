#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/floating_point.h"
#include "scene/edge_chains.h"
#include "scene/index_table.h"
#include "scene/position_welding.h"
#include "scene/welded.h"

namespace radvor {
namespace {

using Corners = std::array<std::uint32_t, 3>;
using Sides = std::pmr::vector<std::array<std::uint32_t, 3>>;  // segments of the kept triangles, after their corners

// Turned so that the smallest vertex comes first: equal for equal triangles with the same front.
Corners turned(const Corners& v) {
  const auto first = static_cast<std::size_t>(std::min_element(v.begin(), v.end()) - v.begin());
  return {v[first], v[(first + 1) % 3], v[(first + 2) % 3]};
}

void check_limits(const Scene& scene) {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  for (const Mesh& mesh : scene.meshes) {
    vertices += mesh.positions.size();
    triangles += mesh.indices.size() / 3;
  }
  constexpr std::uint64_t k_most = k_none / 8;  // uses and segments are counted in 32 bits too
  if (vertices > k_most || triangles > k_most) {
    throw Error(ErrorCode::limit,
                "the scene has %llu vertices and %llu triangles; no more than %llu of each are possible",
                static_cast<unsigned long long>(vertices), static_cast<unsigned long long>(triangles),
                static_cast<unsigned long long>(k_most));
  }
}

// Fills welded.triangles with what is no degenerate and no duplicate, and the chains with all segments that matter.
Sides keep_triangles(const Scene& scene, const Tolerance& tolerance, EdgeChains& chains, WeldedScene& welded,
                     std::pmr::memory_resource* memory) {
  Sides sides(memory);
  std::size_t count = 0;
  for (const Mesh& mesh : scene.meshes) {
    count += mesh.indices.size() / 3;
  }
  welded.triangles.reserve(count);
  sides.reserve(count);
  IndexTable known(count, memory);
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    const bool reverse = mesh.clockwise != mirrors(mesh.transform);
    for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
      const std::size_t first_index = std::size_t{3} * t;
      Corners corners{mesh.indices[first_index], mesh.indices[first_index + 1], mesh.indices[first_index + 2]};
      if (reverse) {
        std::swap(corners[1], corners[2]);
      }
      const auto& vertex_of = welded.vertex_of[m];
      const Corners vertices{vertex_of[corners[0]], vertex_of[corners[1]], vertex_of[corners[2]]};
      if (vertices[0] == vertices[1] || vertices[1] == vertices[2] || vertices[2] == vertices[0]) {
        ++welded.degenerate_triangles;
        continue;
      }
      const int apex = apex_of_sliver(tolerance, vertices);
      if (apex >= 0) {
        ++welded.degenerate_triangles;
        chains.add_triangle(vertices, apex);
        continue;
      }
      const Corners key = turned(vertices);
      const auto next = static_cast<std::uint32_t>(welded.triangles.size());
      const std::uint64_t kind = (mesh.casts ? 2u : 0u) | (mesh.receives ? 1u : 0u);
      const std::uint32_t first =
          known.find_or_insert(hash(std::uint64_t{key[0]} << 32 | key[1], std::uint64_t{key[2]} << 2 | kind), next,
                               [&](std::uint32_t other) {
                                 const Mesh& other_mesh = scene.meshes[welded.triangles[other].mesh];
                                 return other_mesh.casts == mesh.casts && other_mesh.receives == mesh.receives &&
                                        turned(welded.triangles[other].vertices) == key;
                               });
      if (first != next) {
        ++welded.duplicate_triangles;
        continue;
      }
      welded.triangles.push_back({vertices, corners, m, t, mesh.triangle_materials[t]});
      sides.push_back(chains.add_triangle(vertices));
    }
  }
  return sides;
}

// The outline of a triangle as links.
class Outline {
 public:
  struct Part {
    EdgeChains::Link link;
    std::uint8_t side;
  };

  Outline(EdgeChains& chains, std::size_t vertex_count, std::pmr::memory_resource* memory)
      : chains_(chains), links_(memory), parts_(memory), last_seen_(vertex_count, k_none, memory) {}

  void trace(const Triangle& triangle, const std::array<std::uint32_t, 3>& sides) {
    parts_.clear();
    for (std::uint8_t side = 0; side < 3; ++side) {
      links_.clear();
      chains_.chain(sides[side], triangle.vertices[side], links_);
      for (const auto& link : links_) {
        parts_.push_back({link, side});
      }
    }
  }

  /// Whether the outline meets itself in some vertex. Takes that vertex back from all sides where it is no corner.
  bool untie(const Triangle& triangle) {
    bool tied = false;
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      last_seen_[parts_[i].link.from] = i;
    }
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      const std::uint32_t vertex = parts_[i].link.from;
      if (last_seen_[vertex] == i) {
        continue;
      }
      tied = true;
      for (const Part& part : parts_) {
        if (part.link.from == vertex && triangle.vertices[part.side] != vertex) {
          chains_.refuse(part.link.parent, vertex);
        }
      }
    }
    return tied;
  }
  std::span<const Part> parts() const { return parts_; }

 private:
  EdgeChains& chains_;
  std::pmr::vector<EdgeChains::Link> links_;
  std::pmr::vector<Part> parts_;
  std::pmr::vector<std::uint32_t> last_seen_;
};

// A vertex may lie on two sides of one triangle: near a sharp corner, or in a triangle not much higher than what counts
// as touching. It stays off these sides, or the triangle would fall apart.
void untie_outlines(EdgeChains& chains, const Sides& sides, const WeldedScene& welded, const Jobs& jobs,
                    std::pmr::memory_resource* memory) {
  Outline outline(chains, welded.positions.size(), memory);
  for (bool tied = true; tied;) {
    tied = false;
    for (std::size_t t = 0; t < sides.size(); ++t) {
      if (std::ranges::any_of(sides[t], [&](std::uint32_t segment) { return chains.is_divided(segment); })) {
        outline.trace(welded.triangles[t], sides[t]);
        tied = outline.untie(welded.triangles[t]) || tied;
      }
    }
    chains.split(jobs);  // what the changed segments consist of now
  }
}

void join_by_edges(EdgeChains& chains, const Sides& sides, WeldedScene& welded, std::pmr::memory_resource* memory) {
  std::pmr::vector<std::uint32_t> edge_of_segment(chains.segment_count(), k_none, memory);
  std::pmr::vector<bool> counted(welded.positions.size(), false, memory);
  Outline outline(chains, welded.positions.size(), memory);
  welded.edges.reserve(chains.segment_count());
  welded.uses_by_triangle.reserve(3 * welded.triangles.size());
  welded.first_use.reserve(welded.triangles.size() + 1);
  for (std::uint32_t t = 0; t < welded.triangles.size(); ++t) {
    const Triangle& triangle = welded.triangles[t];
    outline.trace(triangle, sides[t]);
    welded.first_use.push_back(static_cast<std::uint32_t>(welded.uses_by_triangle.size()));
    for (const auto& [link, side] : outline.parts()) {
      std::uint32_t& edge = edge_of_segment[link.segment];
      if (edge == k_none) {
        edge = static_cast<std::uint32_t>(welded.edges.size());
        const bool ordered = lies_before(welded.positions[link.from], welded.positions[link.to]);
        welded.edges.push_back(ordered ? Edge{link.from, link.to} : Edge{link.to, link.from});
      }
      if (link.from != triangle.vertices[side] && !counted[link.from]) {
        counted[link.from] = true;
        ++welded.t_junctions;
      }
      welded.uses_by_triangle.push_back({edge, t, side, welded.edges[edge].a == link.from});
    }
  }
  welded.first_use.push_back(static_cast<std::uint32_t>(welded.uses_by_triangle.size()));
}

void find_bounds(WeldedScene& welded) {
  Box box;
  for (const Triangle& triangle : welded.triangles) {
    for (const std::uint32_t vertex : triangle.vertices) {
      box.add(welded.positions[vertex]);
    }
  }
  if (!welded.triangles.empty()) {
    welded.low = box.low;
    welded.high = box.high;
  }
}

void report(const WeldedScene& welded, const Log& log) {
  if (welded.degenerate_triangles > 0) {
    log(LogLevel::warning, "dropped %u degenerate triangles", welded.degenerate_triangles);
  }
  if (welded.duplicate_triangles > 0) {
    log(LogLevel::warning, "dropped %u duplicate triangles", welded.duplicate_triangles);
  }
  if (welded.t_junctions > 0) {
    log(LogLevel::info, "joined %u T-junctions", welded.t_junctions);
  }
}

}  // namespace

WeldedScene::WeldedScene(std::pmr::memory_resource* memory)
    : positions(memory),
      precision(memory),
      vertex_of(memory),
      triangles(memory),
      edges(memory),
      uses_by_triangle(memory),
      first_use(memory),
      uses_of_edge(memory),
      first_of_edge(memory) {}

// Counting sort of the uses by edge.
void group_uses(WeldedScene& welded) {
  auto& first = welded.first_of_edge;
  first.assign(welded.edges.size() + 1, 0);
  for (const EdgeUse& use : welded.uses_by_triangle) {
    ++first[use.edge + 1];
  }
  for (std::size_t e = 0; e < welded.edges.size(); ++e) {
    first[e + 1] += first[e];
  }
  welded.uses_of_edge.resize(welded.uses_by_triangle.size());
  for (std::uint32_t i = static_cast<std::uint32_t>(welded.uses_by_triangle.size()); i-- > 0;) {
    // Filled from the back, so that each group ends up in order and `first` one group too far.
    welded.uses_of_edge[--first[welded.uses_by_triangle[i].edge + 1]] = i;
  }
  first.erase(first.begin());
  first.push_back(static_cast<std::uint32_t>(welded.uses_by_triangle.size()));
}

std::span<const EdgeUse> WeldedScene::uses_of_triangle(std::uint32_t triangle) const {
  return std::span(uses_by_triangle).subspan(first_use[triangle], first_use[triangle + 1] - first_use[triangle]);
}

std::span<const std::uint32_t> WeldedScene::uses_at_edge(std::uint32_t edge) const {
  return std::span(uses_of_edge).subspan(first_of_edge[edge], first_of_edge[edge + 1] - first_of_edge[edge]);
}

WeldedScene weld(const Scene& scene, double weld_distance, Host& host) {
  const FloatingPointGuard guard(Denormals::keep);
  check_limits(scene);
  std::pmr::memory_resource* memory = &host.memory;
  WeldedScene welded(memory);
  welded.weld_distance = weld_distance;
  {
    WeldedPositions points = weld_positions(scene, weld_distance, memory);
    welded.positions = std::move(points.positions);
    welded.precision = std::move(points.precision);
    welded.vertex_of = std::move(points.vertex_of);
  }
  const Tolerance tolerance{welded.positions, welded.precision, weld_distance};
  EdgeChains chains(tolerance, memory);
  const Sides sides = keep_triangles(scene, tolerance, chains, welded, memory);
  chains.split(host.jobs);
  untie_outlines(chains, sides, welded, host.jobs, memory);
  join_by_edges(chains, sides, welded, memory);
  group_uses(welded);
  find_bounds(welded);
  report(welded, host.log);
  return welded;
}

}  // namespace radvor
