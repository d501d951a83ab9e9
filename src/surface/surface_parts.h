// What a surface is made of, for the steps that make and refine it.
#pragma once

#include <cstdint>
#include <deque>
#include <memory_resource>
#include <optional>
#include <vector>

#include "base/even_ranges.h"
#include "base/raw_vector.h"
#include "surface/border_sites.h"
#include "surface/facet_draft.h"
#include "surface/facet_location.h"
#include "surface/facet_mesh.h"
#include "surface/surface.h"

namespace radvor {

/// Where a facet's things are. Shares are numbered fronts first, then the backs of two-sided materials in the same
/// order.
struct FacetRecord {
  std::uint32_t first_share = k_none;  ///< k_none: the facet does not receive
  std::uint32_t share_count = 0;       ///< of the front
  std::uint32_t mesh = k_none;         ///< k_none: a single small triangle, shares first_share .. first_share + 2
  bool two_sided = false;
};

/// Where a site lies in what it may be refined with.
struct SitePlace {
  std::uint32_t facet = k_none;  ///< of sites inside of facets
  bool on_lattice = false;       ///< of that facet, at index on the finest level
  LatticeIndex index{0, 0};      ///< of border sites: i is the step on the edge (border_sites.h)
};

/// What samples and patches are made of, share by share.
struct ShareDetails {
  explicit ShareDetails(std::pmr::memory_resource* memory) : site(memory), normal(memory), receiver(memory) {}

  void resize(std::size_t count) {
    site.resize(count);
    normal.resize(count);
    receiver.resize(count);
  }

  RawVector<std::uint32_t> site;
  RawVector<Vec3> normal;    ///< unit, on the share's side
  RawVector<Vec3> receiver;  ///< inside the share's cell
};

struct SurfaceParts {
  SurfaceParts(const Scene& scene_given, const WeldedScene& welded_scene, const Facets& facets_found,
               const SurfaceOptions& options_given, Host& lender)
      : scene(scene_given),
        welded(welded_scene),
        facets(facets_found),
        options(options_given),
        host(lender),
        memory(&lender.memory),
        borders(scene, welded, facets, options, memory),
        sites(memory),
        given(memory),
        first_given(memory),
        places(memory),
        levels(memory),
        samples(memory),
        shares(memory),
        details(memory),
        records(facets_found.facets.size(), memory),
        meshes(memory),
        drafts(memory),
        small_triangles(memory),
        first_of_patch(memory),
        patch_members(memory) {}

  FacetInput input(std::uint32_t facet) const {
    return {scene, welded, facets, options, borders, memory, facet, given_on(facet)};
  }
  std::span<const InnerSite> given_on(std::uint32_t facet) const {
    return first_given.empty()
               ? std::span<const InnerSite>()
               : std::span(given).subspan(first_given[facet], first_given[facet + 1] - first_given[facet]);
  }

  std::span<const ShareTriangle> triangles_of(std::uint32_t facet) const {
    const FacetRecord& record = records[facet];
    if (record.first_share == k_none) {
      return {};
    }
    return record.mesh == k_none ? std::span<const ShareTriangle>(small_triangles).subspan(facet, 1)
                                 : meshes[record.mesh]->triangles();
  }
  /// All facets, for tasks that do little to each of their shares.
  EvenRanges ranges_by_shares() const {
    constexpr double k_task = 4096;
    const auto weight = [&](std::uint32_t facet) { return 1.0 + records[facet].share_count; };
    return {records.size(), k_task, weight, memory};
  }

  /// NULL where each triangle's corners are shares of their own, with cells in closed form.
  const FacetMesh* triangulated(std::uint32_t facet) const {
    const FacetRecord& record = records[facet];
    return record.mesh == k_none || meshes[record.mesh]->degenerate() ? nullptr : &*meshes[record.mesh];
  }
  LocatedFacet located(std::uint32_t facet) const {
    return {facets.facets[facet].frame, triangles_of(facet), triangulated(facet), sites, samples, shares};
  }

  const Scene& scene;
  const WeldedScene& welded;
  const Facets& facets;
  SurfaceOptions options;
  Host& host;
  std::pmr::memory_resource* memory;

  BorderSites borders;
  std::pmr::vector<Site> sites;
  std::pmr::vector<InnerSite> given;            // by the host; grouped by facet, their sites follow one another
  std::pmr::vector<std::uint32_t> first_given;  // per facet and one past the last; empty: none are given
  std::pmr::vector<SitePlace> places;           // per site
  std::pmr::vector<std::uint8_t> levels;        // per site: what it was raised to
  RawVector<Sample> samples;
  RawVector<Share> shares;
  ShareDetails details;
  std::pmr::vector<FacetRecord> records;
  std::pmr::deque<std::optional<FacetMesh>> meshes;  // empty ones are free
  std::pmr::deque<FacetDraft> drafts;                // per mesh
  std::pmr::vector<ShareTriangle> small_triangles;   // per facet; that of facets without a mesh
  std::pmr::vector<std::uint32_t> first_of_patch;    // per patch, and one past the last
  std::pmr::vector<std::uint32_t> patch_members;
};

/// Groups shares into samples over smooth edges (samples.cpp).
void make_samples(SurfaceParts& parts);

/// Groups shares into patches (patches.cpp).
void make_patches(SurfaceParts& parts);

}  // namespace radvor
