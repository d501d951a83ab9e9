// What a surface is made of, for the steps that make it.
#pragma once

#include <cstdint>
#include <deque>
#include <memory_resource>
#include <optional>
#include <vector>

#include "surface/facet_draft.h"
#include "surface/facet_mesh.h"
#include "surface/surface.h"

namespace radvor {

/// Where a facet's things are. Shares are numbered fronts first, then the backs of two-sided materials in the same
/// order; ids are only ever appended.
struct FacetRecord {
  std::uint32_t first_share = k_none;  ///< k_none: the facet does not receive
  std::uint32_t share_count = 0;       ///< of the front
  std::uint32_t mesh = k_none;         ///< k_none: a single small triangle, shares first_share .. first_share + 2
  bool two_sided = false;
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
        sites(memory),
        samples(memory),
        shares(memory),
        records(facets_found.facets.size(), memory),
        meshes(memory),
        small_triangles(memory),
        first_of_patch(memory),
        patch_members(memory) {}

  FacetInput input(std::uint32_t facet, const BorderSites& borders) const {
    return {scene, welded, facets, options, borders, memory, facet};
  }
  Vec2 position_in_facet(std::uint32_t share) const {
    return facets.facets[shares[share].facet].frame.to_plane(sites[samples[shares[share].sample].site].position);
  }

  const Scene& scene;
  const WeldedScene& welded;
  const Facets& facets;
  SurfaceOptions options;
  Host& host;
  std::pmr::memory_resource* memory;

  std::pmr::vector<Site> sites;
  std::pmr::vector<Sample> samples;
  std::pmr::vector<Share> shares;
  std::pmr::vector<FacetRecord> records;
  std::pmr::deque<std::optional<FacetMesh>> meshes;
  std::pmr::vector<ShareTriangle> small_triangles;  // per facet; that of facets without a mesh
  std::pmr::vector<std::uint32_t> first_of_patch;   // per patch, and one past the last
  std::pmr::vector<std::uint32_t> patch_members;
};

/// What is known of the surface while it is made. Drafts belong to meshes, the others to shares.
struct SurfaceDraft {
  explicit SurfaceDraft(std::pmr::memory_resource* memory)
      : facets(memory), site_of_share(memory), normals(memory), receivers(memory) {}

  std::pmr::deque<FacetDraft> facets;
  std::pmr::vector<std::uint32_t> site_of_share;
  std::pmr::vector<Vec3> normals;    // unit, on the share's side
  std::pmr::vector<Vec3> receivers;  // inside the share's cell
};

/// Groups shares into samples over smooth edges (samples.cpp).
void make_samples(SurfaceParts& parts, const SurfaceDraft& draft, const BorderSites& borders);

/// Groups shares into patches (patches.cpp).
void make_patches(SurfaceParts& parts, const SurfaceDraft& draft);

}  // namespace radvor
