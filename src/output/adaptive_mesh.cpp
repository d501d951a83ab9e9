#include "output/adaptive_mesh.h"

#include <array>
#include <bit>
#include <cstddef>

#include "output/mesh_facets.h"
#include "output/mesh_space.h"
#include "output/quantity.h"
#include "output/source_triangles.h"
#include "scene/index_table.h"

namespace radvor {
namespace {

template <glm::length_t N>
std::uint64_t hash_bits(std::uint64_t seed, const glm::vec<N, float>& v) {
  for (glm::length_t i = 0; i < N; ++i) {
    seed = hash(seed, std::bit_cast<std::uint32_t>(v[i] + 0.0f));  // -0 equals 0
  }
  return seed;
}

class Builder {
 public:
  Builder(const LitSurface& lit, std::uint32_t mesh)
      : result(&lit.host.memory),
        lit_(lit),
        surface_(lit.surface),
        mesh_(lit.surface.scene().meshes[mesh]),
        space_(lit.surface.scene(), lit.surface.welded(), mesh, &lit.host.memory),
        corners_(&lit.host.memory),
        vertex_of_corner_(&lit.host.memory),
        site_of_vertex_(&lit.host.memory),
        corner_table_(0, &lit.host.memory),
        vertex_table_(0, &lit.host.memory) {}

  void add_facet(std::uint32_t facet) {
    const SourceTriangles sources(surface_, facet, &lit_.host.memory);
    for (const ShareTriangle& shares : surface_.triangles(facet)) {
      add_triangle(facet, sources, shares);
    }
  }

  /// Sites that single precision no longer tells apart.
  std::uint32_t collapsed_sites() const {
    IndexTable sites(site_of_vertex_.size(), &lit_.host.memory);
    IndexTable places(site_of_vertex_.size(), &lit_.host.memory);
    std::uint32_t collapsed = 0;
    for (std::uint32_t v = 0; v < site_of_vertex_.size(); ++v) {
      const bool new_site = v == sites.find_or_insert(mix(site_of_vertex_[v]), v, [&](std::uint32_t other) {
        return site_of_vertex_[other] == site_of_vertex_[v];
      });
      const bool new_place = v == places.find_or_insert(hash_bits(0, result.positions[v]), v, [&](std::uint32_t other) {
        return result.positions[other] == result.positions[v];
      });
      collapsed += new_site && !new_place ? 1 : 0;
    }
    return collapsed;
  }

  AdaptiveMesh result;

 private:
  struct Corner {
    std::uint32_t share, region;
    bool operator==(const Corner&) const = default;
  };

  const Site& site_of(std::uint32_t share) const {
    return surface_.sites()[surface_.samples()[surface_.shares()[share].sample].site];
  }

  Vec2 in_plane(std::uint32_t facet, std::uint32_t share) const {
    return surface_.facets().facets[facet].frame.to_plane(site_of(share).position);
  }

  const Triangle& input(const SourceTriangle& source) const { return surface_.welded().triangles[source.triangle]; }

  void add_triangle(std::uint32_t facet, const SourceTriangles& sources, const ShareTriangle& shares) {
    const Vec2 middle = (in_plane(facet, shares[0]) + in_plane(facet, shares[1]) + in_plane(facet, shares[2])) / 3.0;
    const SourceTriangle& source = *sources.nearest(middle);
    const Triangle& triangle = input(source);
    const auto given = std::span(mesh_.indices).subspan(3 * std::size_t{triangle.source}, 3);
    for (std::size_t i = 0; i < 3; ++i) {
      // The input's winding: the welded triangle is the input's, turned where that is clockwise in the world.
      const std::uint32_t share = shares[is_turned(triangle, given) ? 2 - i : i];
      result.indices.push_back(vertex_of(facet, sources, source, share));
      add_weights(source, triangle, given, facet, share);
    }
    result.materials.push_back(triangle.material);
    result.source_triangles.push_back(triangle.source);
  }

  static bool is_turned(const Triangle& triangle, std::span<const std::uint32_t> given) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (given[i] == triangle.corners[0]) {
        return given[(i + 1) % 3] != triangle.corners[1];
      }
    }
    return false;
  }

  /// Weights of a triangle's corners at a share's site: exactly one of them at a corner.
  std::array<double, 3> weights_at(const SourceTriangle& source, std::uint32_t facet, std::uint32_t share) const {
    const std::uint32_t vertex = site_of(share).vertex;
    const auto& vertices = input(source).vertices;
    if (vertex != k_none && std::ranges::find(vertices, vertex) != vertices.end()) {
      return {vertices[0] == vertex ? 1.0 : 0.0, vertices[1] == vertex ? 1.0 : 0.0, vertices[2] == vertex ? 1.0 : 0.0};
    }
    return source.area() > 0 ? source.weights(in_plane(facet, share)) : std::array<double, 3>{1.0, 0.0, 0.0};
  }

  void add_weights(const SourceTriangle& source, const Triangle& triangle, std::span<const std::uint32_t> given,
                   std::uint32_t facet, std::uint32_t share) {
    const std::array<double, 3> weights = weights_at(source, facet, share);
    for (const std::uint32_t corner : given) {
      const auto found = std::ranges::find(triangle.corners, corner) - triangle.corners.begin();
      result.source_weights.push_back(static_cast<float>(weights[static_cast<std::size_t>(found)]));
    }
  }

  /// What a triangle's corner shows depends on its share and, for UVs, on the region; what shows the same at the same
  /// site is one vertex.
  std::uint32_t vertex_of(std::uint32_t facet, const SourceTriangles& sources, const SourceTriangle& source,
                          std::uint32_t share) {
    const Corner corner{share, source.region};
    const auto next = static_cast<std::uint32_t>(corners_.size());
    const std::uint32_t known = corner_table_.find_or_insert(
        hash(corner.share, corner.region), next, [&](std::uint32_t other) { return corners_[other] == corner; });
    if (known == next) {
      corners_.push_back(corner);
      vertex_of_corner_.push_back(make_vertex(facet, sources, source, share));
    }
    return vertex_of_corner_[known];
  }

  std::uint32_t make_vertex(std::uint32_t facet, const SourceTriangles& sources, const SourceTriangle& source,
                            std::uint32_t share) {
    // Of the triangles of the region the one at the site, not the one at hand: every corner here gets the same bits.
    const SourceTriangle* near = sources.nearest(in_plane(facet, share), source.region);
    const SourceTriangle& origin = near != nullptr ? *near : source;
    const std::array<double, 3> weights = weights_at(origin, facet, share);
    const std::uint32_t sample = surface_.shares()[share].sample;
    const std::uint32_t site = surface_.samples()[sample].site;

    const glm::vec3 position = position_of(site, origin, weights);
    const glm::vec3 normal = normal_of(sample, origin);
    const glm::vec2 uv = mesh_.uvs.empty() ? glm::vec2(0.0f) : glm::vec2(mix_corners(mesh_.uvs, origin, weights));
    const glm::vec3 irradiance(corner_value(lit_, Quantity::irradiance, share));
    const glm::vec3 radiance(corner_value(lit_, Quantity::radiance, share));

    const auto next = static_cast<std::uint32_t>(site_of_vertex_.size());
    const std::uint64_t key = hash_bits(hash_bits(hash_bits(hash_bits(mix(site), normal), uv), irradiance), radiance);
    const std::uint32_t vertex = vertex_table_.find_or_insert(key, next, [&](std::uint32_t other) {
      return site_of_vertex_[other] == site && result.normals[other] == normal &&
             (mesh_.uvs.empty() || result.uvs[other] == uv) && result.irradiance[other] == irradiance &&
             result.radiance[other] == radiance;
    });
    if (vertex == next) {
      site_of_vertex_.push_back(site);
      result.positions.push_back(position);
      result.normals.push_back(normal);
      if (!mesh_.uvs.empty()) {
        result.uvs.push_back(uv);
      }
      result.irradiance.push_back(irradiance);
      result.radiance.push_back(radiance);
    }
    return vertex;
  }

  glm::vec3 position_of(std::uint32_t site_index, const SourceTriangle& origin,
                        const std::array<double, 3>& weights) const {
    const Site& site = surface_.sites()[site_index];
    const std::uint32_t own = site.vertex != k_none ? space_.own_vertex(site.vertex) : k_none;
    if (own != k_none) {
      return mesh_.positions[own];
    }
    return space_.invertible() ? space_.position(site.position)
                               : glm::vec3(mix_corners(mesh_.positions, origin, weights));
  }

  glm::vec3 normal_of(std::uint32_t sample, const SourceTriangle& origin) const {
    const glm::vec3 normal = space_.normal(surface_.samples()[sample].normal);
    if (normal != glm::vec3(0.0f)) {
      return normal;
    }
    const auto& corners = input(origin).corners;  // flattened: the input triangle's own
    const Vec3 at(mesh_.positions[corners[0]]);
    return glm::vec3(normalize(cross(Vec3(mesh_.positions[corners[1]]) - at, Vec3(mesh_.positions[corners[2]]) - at)));
  }

  /// In double: the caller rounds once.
  template <glm::length_t N>
  glm::vec<N, double> mix_corners(const std::pmr::vector<glm::vec<N, float>>& vectors, const SourceTriangle& origin,
                                  const std::array<double, 3>& weights) const {
    glm::vec<N, double> mixed(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
      mixed += weights[i] * glm::vec<N, double>(vectors[input(origin).corners[i]]);
    }
    return mixed;
  }

  const LitSurface& lit_;
  const Surface& surface_;
  const Mesh& mesh_;
  MeshSpace space_;
  std::pmr::vector<Corner> corners_;
  std::pmr::vector<std::uint32_t> vertex_of_corner_;
  std::pmr::vector<std::uint32_t> site_of_vertex_;
  IndexTable corner_table_;  ///< of corners_
  IndexTable vertex_table_;  ///< of result's vertices
};

}  // namespace

AdaptiveMesh make_adaptive_mesh(const LitSurface& lit, std::uint32_t mesh) {
  Builder builder(lit, mesh);
  const FacetRange range = facets_of_mesh(lit.surface.facets(), mesh);
  for (std::uint32_t facet = range.first; facet < range.last; ++facet) {
    builder.add_facet(facet);
  }
  if (const std::uint32_t collapsed = builder.collapsed_sites(); collapsed > 0) {
    lit.host.log(LogLevel::warning, "mesh %u: %u sites of its adaptive mesh coincide with others in single precision",
                 mesh, collapsed);
  }
  return std::move(builder.result);
}

}  // namespace radvor
