#include "surface/facet_patches.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "scene/disjoint_sets.h"
#include "surface/facet_outline.h"
#include "surface/lattice_patches.h"

namespace radvor {

namespace {

// A facet has patches of its own if it is at least this part of one; smaller ones are grouped with their neighbours.
constexpr double k_least_patch = 0.5;

class OwnPatches {
 public:
  OwnPatches(const SurfaceParts& parts, std::uint32_t facet, std::span<std::uint32_t> patch_of)
      : parts_(parts),
        facet_(facet),
        record_(parts.records[facet]),
        mesh_(*parts.triangulated(facet)),
        outline_(parts.welded, parts.facets, facet, parts.memory),
        patch_of_(patch_of) {}

  std::uint32_t find() {
    const std::pmr::vector<LatticeIndex> centres = lattice_centres();
    const std::pmr::vector<Vec2> given = given_centres();
    const std::pmr::vector<Segment> blocking = walls();
    const LatticePatches patches(mesh_.lattice(), centres, given, blocking, parts_.memory);
    count_ = patches.count();
    if (count_ > 0) {
      const Frame& frame = parts_.facets.facets[facet_].frame;
      for (std::uint32_t k = 0; k < record_.share_count; ++k) {
        const Vec3& receiver = parts_.details.receiver[record_.first_share + k];
        patch_of_[k] = patches.nearest(position(k), frame.to_plane(receiver));
      }
      if (!parts_.facets.contacts.of_facet(facet_).empty()) {
        gather_cut_off();
      }
    }
    return count_;
  }

 private:
  Vec2 position(std::uint32_t share) const {
    return mesh_.triangulation().position(parts_.shares[record_.first_share + share].vertex);
  }

  // Sites of level 0 that were there from the start.
  std::pmr::vector<LatticeIndex> lattice_centres() const {
    const std::int64_t whole = std::int64_t{1} << (parts_.options.element_levels + refinements(parts_.options));
    std::pmr::vector<LatticeIndex> centres(parts_.memory);
    for (const std::uint32_t site : mesh_.sites().subspan(mesh_.border_count())) {
      const SitePlace& place = parts_.places[site];
      if (place.on_lattice && parts_.sites[site].level == 0 && place.index.i % whole == 0 &&
          place.index.j % whole == 0) {
        centres.push_back({place.index.i / whole, place.index.j / whole});
      }
    }
    return centres;
  }

  std::pmr::vector<Vec2> given_centres() const {
    std::pmr::vector<Vec2> centres(parts_.memory);
    for (const InnerSite& given : parts_.given_on(facet_)) {
      centres.push_back(given.position);
    }
    return centres;
  }

  // What cells end at. The outline's vertices are the triangulation's first.
  std::pmr::vector<Segment> walls() const {
    const auto corner = [&](std::uint32_t vertex) {
      const auto at = std::ranges::lower_bound(outline_.vertices, vertex);
      return mesh_.triangulation().position(static_cast<delaunay::VertexId>(at - outline_.vertices.begin()));
    };
    std::pmr::vector<Segment> walls(parts_.memory);
    for (const OutlineEdge& edge : outline_.edges) {
      if (edge.flags & delaunay::constraint::k_blocking) {
        const Edge& ends = parts_.welded.edges[edge.edge];
        walls.push_back({corner(ends.a), corner(ends.b)});
      }
    }
    return walls;
  }

  // Shares that see no site of level 0 become patches of their own, each on one side of every contact: what is lit and
  // what is dark must not shoot together.
  void gather_cut_off() {
    DisjointSets regions(record_.share_count, parts_.memory);
    for (const ShareTriangle& triangle : mesh_.triangles()) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = triangle[k] - record_.first_share;
        const std::uint32_t b = triangle[(k + 1) % 3] - record_.first_share;
        if (patch_of_[a] == k_none && patch_of_[b] == k_none) {
          regions.unite(a, b);
        }
      }
    }
    Vec2 low = mesh_.triangulation().position(0);
    for (delaunay::VertexId corner = 1; corner < outline_.vertices.size(); ++corner) {
      low = glm::min(low, mesh_.triangulation().position(corner));
    }
    struct Place {
      std::uint32_t region;
      double row, column;  // of squares as wide as patches
      std::uint32_t share;
      auto tie() const { return std::tie(region, row, column); }
    };
    std::pmr::vector<Place> places(parts_.memory);
    for (std::uint32_t share = 0; share < record_.share_count; ++share) {
      if (patch_of_[share] == k_none) {
        const Vec2 square = (position(share) - low) / parts_.options.patch_spacing;
        places.push_back({regions.find(share), std::floor(square.y), std::floor(square.x), share});
      }
    }
    std::ranges::sort(places, [](const Place& x, const Place& y) {
      return x.tie() != y.tie() ? x.tie() < y.tie() : x.share < y.share;
    });
    for (std::size_t k = 0; k < places.size(); ++k) {
      count_ += k == 0 || places[k].tie() != places[k - 1].tie() ? 1 : 0;
      patch_of_[places[k].share] = count_ - 1;
    }
  }

  const SurfaceParts& parts_;
  std::uint32_t facet_;
  const FacetRecord& record_;
  const FacetMesh& mesh_;
  FacetOutline outline_;
  std::span<std::uint32_t> patch_of_;
  std::uint32_t count_ = 0;
};

}  // namespace

std::uint32_t find_own_patches(const SurfaceParts& parts, std::uint32_t facet, std::span<std::uint32_t> patch_of) {
  std::ranges::fill(patch_of, k_none);
  const FacetMesh* mesh = parts.triangulated(facet);
  return mesh && parts.facets.facets[facet].area >= k_least_patch * mesh->lattice().cell_area()
             ? OwnPatches(parts, facet, patch_of).find()
             : 0;
}

}  // namespace radvor
