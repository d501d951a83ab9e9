// The steps that make a surface. Facets are built side by side; numbers are given in one serial pass between, so that
// they are the same for any number of threads.
#include "surface/make_surface.h"

#include <algorithm>
#include <atomic>

#include "surface/border_sites.h"
#include "surface/receiver_point.h"
#include "surface/shading.h"
#include "surface/triangle_cells.h"

namespace radvor {

namespace {

// Ranges of things of about equal weight: what one task does.
template <class Weight>
std::pmr::vector<std::uint32_t> even_ranges(std::uint32_t count, double weight, Weight&& weight_of,
                                            std::pmr::memory_resource* memory) {
  std::pmr::vector<std::uint32_t> bounds(1, 0u, memory);
  double sum = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    sum += weight_of(k);
    if (sum >= weight || k + 1 == count) {
      bounds.push_back(k + 1);
      sum = 0;
    }
  }
  return bounds;
}

class SurfaceMaker {
 public:
  explicit SurfaceMaker(SurfaceParts& parts)
      : parts_(parts),
        borders_(parts.scene, parts.welded, parts.facets, element_spacing(parts), parts.memory),
        draft_(parts.memory),
        meshed_(parts.memory) {}

  void run() {
    parts_.sites = borders_.list();
    build_meshes();
    number();
    fill_shares();
    make_samples(parts_, draft_, borders_);
    make_patches(parts_, draft_);
  }

 private:
  // As the facets' lattices have it, so that border sites and lattices line up.
  static double element_spacing(const SurfaceParts& parts) {
    return FacetLattice(parts.options.lattice, parts.options.patch_spacing, Vec2(0.0))
        .column(parts.options.element_levels);
  }

  void build_meshes() {
    for (std::uint32_t facet = 0; facet < parts_.records.size(); ++facet) {
      const Facet& described = parts_.facets.facets[facet];
      FacetRecord& record = parts_.records[facet];
      if (!parts_.scene.meshes[described.mesh].receives) {
        continue;
      }
      record.two_sided = parts_.scene.materials[described.material].two_sided;
      record.first_share = 0;  // for now: it receives
      if (FacetMesh::needed(parts_.input(facet, borders_))) {
        record.mesh = static_cast<std::uint32_t>(meshed_.size());
        meshed_.push_back(facet);
        parts_.meshes.emplace_back();
        draft_.facets.emplace_back(parts_.memory);
      }
    }
    // A facet's own lattice, and a constant for the rest; in sites.
    const double spacing = element_spacing(parts_);
    constexpr double k_task = 1000;
    const auto bounds = even_ranges(
        static_cast<std::uint32_t>(meshed_.size()), k_task,
        [&](std::uint32_t k) {
          const Facet& facet = parts_.facets.facets[meshed_[k]];
          return 10.0 + 2.0 * facet.triangle_count + facet.area / (spacing * spacing);
        },
        parts_.memory);
    parts_.host.jobs.for_each(static_cast<std::uint32_t>(bounds.size() - 1), [&](std::uint32_t task) {
      for (std::uint32_t k = bounds[task]; k < bounds[task + 1]; ++k) {
        parts_.meshes[k].emplace(parts_.input(meshed_[k], borders_), draft_.facets[k]);
      }
    });
  }

  void number() {
    std::uint32_t shares = 0;
    std::uint32_t degenerate = 0;
    parts_.small_triangles.assign(parts_.records.size(), ShareTriangle{k_none, k_none, k_none});
    std::pmr::vector<std::uint32_t> inner_sites(parts_.memory);  // per welded vertex, once one is needed
    for (std::uint32_t facet = 0; facet < parts_.records.size(); ++facet) {
      FacetRecord& record = parts_.records[facet];
      if (record.first_share == k_none) {
        continue;
      }
      record.first_share = shares;
      if (record.mesh == k_none) {
        record.share_count = 3;
        parts_.small_triangles[facet] = {shares, shares + 1, shares + 2};
      } else {
        FacetMesh& mesh = *parts_.meshes[record.mesh];
        FacetDraft& draft = draft_.facets[record.mesh];
        record.share_count = static_cast<std::uint32_t>(draft.shares.size());
        mesh.number_shares(shares);
        degenerate += mesh.degenerate() ? 1 : 0;
        for (FacetShare& share : draft.shares) {
          if (share.site == k_none) {
            share.site = add_inner_site(parts_.facets.facets[facet], share, inner_sites);
          }
        }
      }
      shares += record.two_sided ? 2 * record.share_count : record.share_count;
    }
    if (degenerate > 0) {
      parts_.host.log(LogLevel::info, "%u of %zu facets are too thin to be triangulated anew and keep their triangles",
                      degenerate, parts_.records.size());
    }
    parts_.shares.resize(shares);
  }

  std::uint32_t add_inner_site(const Facet& facet, const FacetShare& share,
                               std::pmr::vector<std::uint32_t>& inner_sites) {
    const auto site = static_cast<std::uint32_t>(parts_.sites.size());
    if (share.inner_vertex == k_none) {
      parts_.sites.push_back({facet.frame.to_world(share.position), k_none, k_none});
      return site;
    }
    if (inner_sites.empty()) {
      inner_sites.assign(parts_.welded.positions.size(), k_none);
    }
    std::uint32_t& known = inner_sites[share.inner_vertex];
    if (known == k_none) {
      known = site;
      parts_.sites.push_back({parts_.welded.positions[share.inner_vertex], share.inner_vertex, k_none});
    }
    return known;
  }

  void fill_shares() {
    draft_.site_of_share.resize(parts_.shares.size());
    draft_.normals.resize(parts_.shares.size());
    draft_.receivers.resize(parts_.shares.size());
    constexpr double k_task = 2000;
    const auto bounds = even_ranges(
        static_cast<std::uint32_t>(parts_.records.size()), k_task,
        [&](std::uint32_t facet) { return static_cast<double>(parts_.records[facet].share_count); }, parts_.memory);
    std::atomic<std::uint32_t> clamped{0};
    parts_.host.jobs.for_each(static_cast<std::uint32_t>(bounds.size() - 1), [&](std::uint32_t task) {
      std::uint32_t clamped_here = 0;
      for (std::uint32_t facet = bounds[task]; facet < bounds[task + 1]; ++facet) {
        if (parts_.records[facet].first_share != k_none) {
          clamped_here += parts_.records[facet].mesh == k_none ? fill_small(facet) : fill_meshed(facet);
        }
      }
      clamped += clamped_here;
    });
    if (clamped > 0) {
      parts_.host.log(LogLevel::warning, "albedo above %g is taken as that, at %u elements", k_most_albedo,
                      clamped.load());
    }
  }

  std::uint32_t fill_small(std::uint32_t facet) {
    const FacetInput input = parts_.input(facet, borders_);
    const FacetShading shading(input);
    const std::uint32_t triangle = parts_.facets.triangles_of(facet).front();
    const auto& vertices = parts_.welded.triangles[triangle].vertices;
    const Frame& frame = input.facet().frame;
    std::array<Vec2, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = frame.to_plane(parts_.welded.positions[vertices[k]]);
    }
    const auto cells = triangle_cells(corners);
    std::uint32_t clamped = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      FacetShare share;
      share.vertex = k;
      share.site = borders_.at_vertex(vertices[k]);
      share.centroid = cells[k].centroid;
      share.receiver = corners[k] + k_nudge * (cells[k].centroid - corners[k]);
      share.area = cells[k].area;
      clamped += fill(facet, k, share, shading.at_corner(triangle, k));
    }
    return clamped;
  }

  std::uint32_t fill_meshed(std::uint32_t facet) {
    const FacetInput input = parts_.input(facet, borders_);
    FacetShading shading(input);
    const FacetDraft& draft = draft_.facets[parts_.records[facet].mesh];
    std::uint32_t clamped = 0;
    for (std::uint32_t k = 0; k < draft.shares.size(); ++k) {
      const FacetShare& share = draft.shares[k];
      clamped +=
          fill(facet, k, share,
               share.source.triangle == k_none ? shading.inside(share.position)
                                               : shading.on_side(share.source, parts_.sites[share.site].position));
    }
    return clamped;
  }

  // Both sides of a share; 1 where its albedo was clamped.
  std::uint32_t fill(std::uint32_t facet, std::uint32_t number, const FacetShare& drafted, const Shading& shading) {
    const FacetRecord& record = parts_.records[facet];
    const Frame& frame = parts_.facets.facets[facet].frame;
    const std::uint32_t front = record.first_share + number;
    const std::uint32_t back = front + record.share_count;
    Share share{};
    share.centroid = frame.to_world(drafted.centroid);
    share.albedo = shading.albedo;
    share.area = drafted.area;
    share.sample = k_none;
    share.facet = facet;
    share.patch = k_none;
    share.vertex = drafted.vertex;
    share.other_side = record.two_sided ? back : k_none;
    put(front, share, drafted, shading.normal, frame);
    if (record.two_sided) {
      share.other_side = front;
      share.back = true;
      put(back, share, drafted, -shading.normal, frame);
    }
    return shading.clamped ? 1 : 0;
  }

  void put(std::uint32_t index, const Share& share, const FacetShare& drafted, const Vec3& normal, const Frame& frame) {
    parts_.shares[index] = share;
    draft_.site_of_share[index] = drafted.site;
    draft_.normals[index] = normal;
    draft_.receivers[index] = frame.to_world(drafted.receiver);
  }

  SurfaceParts& parts_;
  BorderSites borders_;
  SurfaceDraft draft_;
  std::pmr::vector<std::uint32_t> meshed_;  // facets that have a mesh
};

}  // namespace

void make_surface(SurfaceParts& parts) {
  SurfaceMaker(parts).run();
}

}  // namespace radvor
