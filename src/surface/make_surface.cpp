// The steps that make a surface. Facets are built side by side; numbers are given in one serial pass between, so that
// they are the same for any number of threads.
#include "surface/make_surface.h"

#include <algorithm>
#include <atomic>

#include "base/even_ranges.h"
#include "surface/facet_ground.h"
#include "surface/given_sites.h"
#include "surface/receiver_point.h"
#include "surface/sample_origins.h"
#include "surface/shading.h"
#include "surface/spaced_points.h"
#include "surface/triangle_cells.h"

namespace radvor {

namespace {

class SurfaceMaker {
 public:
  explicit SurfaceMaker(SurfaceParts& parts)
      : parts_(parts), facets_(parts.memory), retired_(parts.memory), inner_sites_(parts.memory) {}

  void draft() {
    parts_.sites = parts_.borders.list();
    take_given_sites();
    for (std::uint32_t facet = 0; facet < parts_.records.size(); ++facet) {
      const Facet& described = parts_.facets.facets[facet];
      if (parts_.scene.meshes[described.mesh].receives) {
        parts_.records[facet].two_sided = parts_.scene.materials[described.material].two_sided;
        parts_.records[facet].first_share = 0;  // for now: it receives
        facets_.push_back(facet);
      }
    }
    parts_.small_triangles.assign(parts_.records.size(), ShareTriangle{k_none, k_none, k_none});
    build_meshes([&](std::uint32_t k) { return parts_.input(facets_[k]); });
    number();
    place_border_sites();
  }

  void finish(const ChangedFacets& changed) {
    build_anew(changed);
    free_retired();
    facets_.clear();
    for (std::uint32_t facet = 0; facet < parts_.records.size(); ++facet) {
      if (parts_.records[facet].first_share != k_none) {
        facets_.push_back(facet);
      }
    }
    make_room();
    fill_shares();
    make_samples(parts_);
  }

  std::pmr::vector<SampleOrigin> remake(const ChangedFacets& changed) {
    SurfaceBefore before(parts_, changed.facets);
    build_anew(changed);
    make_room();
    copy_shares(before);
    fill_shares();
    make_samples(parts_);
    auto origins = find_origins(parts_, before, facets_);
    free_retired();
    return origins;
  }

 private:
  void build_anew(const ChangedFacets& changed) {
    facets_.assign(changed.facets.begin(), changed.facets.end());
    build_meshes([&](std::uint32_t k) {
      FacetInput input = parts_.input(facets_[k]);
      input.inner = changed.inner_of(k);
      return input;
    });
    number();
  }

  void free_retired() {
    for (const std::uint32_t mesh : retired_) {
      parts_.meshes[mesh].reset();
      parts_.drafts[mesh].let_all_go();
    }
    retired_.clear();
  }

  // Those that the host gave become sites after the borders', each inside of its facet.
  void take_given_sites() {
    const std::pmr::vector<GivenSite> found =
        find_given_sites(parts_.scene, parts_.welded, parts_.facets, parts_.memory);
    if (found.empty()) {
      return;
    }
    constexpr double k_clearance = 1.0 / 64;
    const double clear = k_clearance * parts_.options.patch_spacing;
    std::size_t next = 0;
    for (std::uint32_t facet = 0; facet < parts_.facets.facets.size(); ++facet) {
      parts_.first_given.push_back(static_cast<std::uint32_t>(parts_.given.size()));
      if (next == found.size() || found[next].facet != facet) {
        continue;
      }
      const FacetGround ground(
          {parts_.scene, parts_.welded, parts_.facets, parts_.options, parts_.borders, parts_.memory, facet});
      SpacedPoints apart(clear, parts_.memory);
      for (; next < found.size() && found[next].facet == facet; ++next) {
        const Vec2& position = found[next].position;
        if (ground.encloses(position) && ground.clearance(position, 2 * clear) >= clear && apart.add(position)) {
          parts_.given.push_back({position, static_cast<std::uint32_t>(parts_.sites.size())});
          parts_.sites.emplace_back().position = parts_.facets.facets[facet].frame.to_world(position);
          parts_.places.resize(parts_.sites.size());
          parts_.places.back().facet = facet;
        }
      }
    }
    parts_.first_given.push_back(static_cast<std::uint32_t>(parts_.given.size()));
    if (parts_.given.size() < found.size()) {
      parts_.host.log(LogLevel::info, "%zu of %zu sites given are too near to borders or to others, and left out",
                      found.size() - parts_.given.size(), found.size());
    }
  }

  // input_of(k): of facets_[k].
  template <class InputOf>
  void build_meshes(InputOf&& input_of) {
    std::pmr::vector<std::uint32_t> free(parts_.memory);
    for (auto mesh = static_cast<std::uint32_t>(parts_.meshes.size()); mesh-- > 0;) {
      if (!parts_.meshes[mesh]) {
        free.push_back(mesh);
      }
    }
    std::pmr::vector<std::uint32_t> meshed(parts_.memory);  // into facets_
    for (std::uint32_t k = 0; k < facets_.size(); ++k) {
      FacetRecord& record = parts_.records[facets_[k]];
      record.first_share = 0;
      if (record.mesh != k_none) {
        retired_.push_back(record.mesh);
        record.mesh = k_none;
      }
      if (FacetMesh::needed(input_of(k))) {
        meshed.push_back(k);
        if (free.empty()) {
          record.mesh = static_cast<std::uint32_t>(parts_.meshes.size());
          parts_.meshes.emplace_back();
          parts_.drafts.emplace_back(parts_.memory);
        } else {
          record.mesh = free.back();
          free.pop_back();
          parts_.drafts[record.mesh].clear();
        }
      }
    }
    // A facet's own sites, and a constant for the rest.
    const double spacing = parts_.borders.spacing();
    constexpr double k_task = 1000;
    const EvenRanges ranges(
        meshed.size(), k_task,
        [&](std::uint32_t k) {
          const FacetInput input = input_of(meshed[k]);
          const Facet& facet = input.facet();
          return 10.0 + 2.0 * facet.triangle_count +
                 (input.inner ? static_cast<double>(input.inner->size()) : facet.area / (spacing * spacing));
        },
        parts_.memory);
    ranges.for_each(parts_.host.jobs, [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t k = begin; k < end; ++k) {
        const std::uint32_t mesh = parts_.records[facets_[meshed[k]]].mesh;
        parts_.meshes[mesh].emplace(input_of(meshed[k]), parts_.drafts[mesh]);
      }
    });
  }

  // Shares of all facets; sites that are still without a number, in facets built now.
  void number() {
    const std::pmr::vector<FacetRecord> before(parts_.records, parts_.memory);
    std::uint32_t shares = 0;
    for (std::uint32_t facet = 0; facet < parts_.records.size(); ++facet) {
      FacetRecord& record = parts_.records[facet];
      if (record.first_share == k_none) {
        continue;
      }
      if (record.mesh == k_none) {
        record.share_count = 3;
        parts_.small_triangles[facet] = {shares, shares + 1, shares + 2};
      } else {
        const auto drafted = static_cast<std::uint32_t>(parts_.drafts[record.mesh].shares.size());
        record.share_count = drafted > 0 ? drafted : record.share_count;  // else it is as it was
      }
      record.first_share = shares;
      shares += record.two_sided ? 2 * record.share_count : record.share_count;
    }
    parts_.ranges_by_shares().for_each_in_parts(
        parts_.host.jobs, [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
          for (std::uint32_t facet = begin; facet < end; ++facet) {
            const FacetRecord& record = parts_.records[facet];
            if (record.first_share != k_none && record.mesh != k_none) {
              parts_.meshes[record.mesh]->number_shares(record.first_share - before[facet].first_share);
            }
          }
        });
    std::uint32_t degenerate = 0;
    for (const std::uint32_t facet : facets_) {
      if (parts_.records[facet].mesh != k_none) {
        degenerate += number_sites(facet) ? 0 : 1;
      }
    }
    if (degenerate > 0) {
      parts_.host.log(LogLevel::info, "%u of %zu facets are too thin to be triangulated anew and keep their triangles",
                      degenerate, parts_.records.size());
    }
    share_count_ = shares;
  }

  void make_room() {
    parts_.shares.resize(share_count_);
    parts_.details.resize(share_count_);
  }

  // False where the facet is degenerate.
  bool number_sites(std::uint32_t facet) {
    FacetMesh& mesh = *parts_.meshes[parts_.records[facet].mesh];
    FacetDraft& draft = parts_.drafts[parts_.records[facet].mesh];
    if (!draft.lattice.empty()) {
      const auto first = static_cast<std::uint32_t>(parts_.sites.size());
      const std::int64_t step = std::int64_t{1} << refinements(parts_.options);
      for (const LatticeIndex& index : draft.lattice) {
        const Vec2 position = mesh.lattice().point(parts_.options.element_levels, index);
        parts_.sites.emplace_back().position = parts_.facets.facets[facet].frame.to_world(position);
        parts_.places.resize(parts_.sites.size());
        parts_.places.back() = {facet, true, {index.i * step, index.j * step}};
      }
      mesh.number_sites([&](std::size_t k) { return first + static_cast<std::uint32_t>(k); });
    }
    for (FacetShare& share : draft.shares) {
      if (share.site == k_none) {
        share.site = share.inner_vertex == k_none ? mesh.sites()[share.vertex] : inner_vertex_site(share.inner_vertex);
      }
    }
    parts_.places.resize(parts_.sites.size());
    parts_.levels.resize(parts_.sites.size(), std::uint8_t{0});
    return !mesh.degenerate();
  }

  // Of a welded vertex inside a facet that keeps its triangles.
  std::uint32_t inner_vertex_site(std::uint32_t vertex) {
    if (inner_sites_.empty()) {
      inner_sites_.assign(parts_.welded.positions.size(), k_none);
      for (std::uint32_t site = 0; site < parts_.sites.size(); ++site) {
        if (parts_.sites[site].vertex != k_none) {
          inner_sites_[parts_.sites[site].vertex] = site;
        }
      }
    }
    if (inner_sites_[vertex] == k_none) {
      inner_sites_[vertex] = static_cast<std::uint32_t>(parts_.sites.size());
      Site& site = parts_.sites.emplace_back();
      site.position = parts_.welded.positions[vertex];
      site.vertex = vertex;
    }
    return inner_sites_[vertex];
  }

  void place_border_sites() {
    parts_.places.resize(parts_.sites.size());
    parts_.levels.resize(parts_.sites.size(), std::uint8_t{0});
    for (std::uint32_t edge = 0; edge < parts_.welded.edges.size(); ++edge) {
      for (const EdgeSite& site : parts_.borders.on_edge(edge)) {
        parts_.places[site.site].index.i = site.step;
      }
    }
  }

  // What has not changed, under its new numbers.
  void copy_shares(const SurfaceBefore& before) {
    parts_.ranges_by_shares().for_each_in_parts(
        parts_.host.jobs, [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
          for (std::uint32_t facet = begin; facet < end; ++facet) {
            if (parts_.records[facet].first_share != k_none && !before.is_changed(facet)) {
              copy_shares(before, parts_.records[facet], before.records[facet].first_share);
            }
          }
        });
  }

  void copy_shares(const SurfaceBefore& before, const FacetRecord& record, std::uint32_t from) {
    const std::uint32_t count = record.two_sided ? 2 * record.share_count : record.share_count;
    for (std::uint32_t k = 0; k < count; ++k) {
      Share& share = parts_.shares[record.first_share + k];
      share = before.shares[from + k];
      share.sample = share.next_in_sample = k_none;
      if (share.other_side != k_none) {
        share.other_side += record.first_share - from;
      }
    }
    const auto copy = [&](const auto& old, auto& now) {
      std::copy_n(old.begin() + from, count, now.begin() + record.first_share);
    };
    copy(before.details.site, parts_.details.site);
    copy(before.details.normal, parts_.details.normal);
    copy(before.details.receiver, parts_.details.receiver);
  }

  // Of facets_, whose drafts are still there.
  void fill_shares() {
    constexpr double k_task = 2000;
    const EvenRanges ranges(
        facets_.size(), k_task,
        [&](std::uint32_t k) { return static_cast<double>(parts_.records[facets_[k]].share_count); }, parts_.memory);
    std::atomic<std::uint32_t> clamped{0};
    ranges.for_each(parts_.host.jobs, [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
      std::uint32_t clamped_here = 0;
      for (std::uint32_t k = begin; k < end; ++k) {
        clamped_here += parts_.records[facets_[k]].mesh == k_none ? fill_small(facets_[k]) : fill_meshed(facets_[k]);
      }
      clamped += clamped_here;
    });
    if (clamped > 0) {
      parts_.host.log(LogLevel::warning, "albedo above %g is taken as that, at %u elements", k_most_albedo,
                      clamped.load());
    }
  }

  std::uint32_t fill_small(std::uint32_t facet) {
    const FacetInput input = parts_.input(facet);
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
      share.site = parts_.borders.at_vertex(vertices[k]);
      share.centroid = cells[k].centroid;
      share.receiver = corners[k] + k_nudge * (cells[k].centroid - corners[k]);
      share.area = cells[k].area;
      clamped += fill(facet, k, share, shading.at_corner(triangle, k));
    }
    return clamped;
  }

  std::uint32_t fill_meshed(std::uint32_t facet) {
    const FacetInput input = parts_.input(facet);
    FacetShading shading(input);
    FacetDraft& draft = parts_.drafts[parts_.records[facet].mesh];
    std::uint32_t clamped = 0;
    for (std::uint32_t k = 0; k < draft.shares.size(); ++k) {
      const FacetShare& share = draft.shares[k];
      clamped +=
          fill(facet, k, share,
               share.source.triangle == k_none ? shading.inside(share.position)
                                               : shading.on_side(share.source, parts_.sites[share.site].position));
    }
    draft.let_go();
    parts_.meshes[parts_.records[facet].mesh]->prepare_location();
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
    parts_.details.site[index] = drafted.site;
    parts_.details.normal[index] = normal;
    parts_.details.receiver[index] = frame.to_world(drafted.receiver);
  }

  SurfaceParts& parts_;
  std::uint32_t share_count_ = 0;
  std::pmr::vector<std::uint32_t> facets_;       // built now
  std::pmr::vector<std::uint32_t> retired_;      // meshes that others took the place of
  std::pmr::vector<std::uint32_t> inner_sites_;  // per welded vertex, once one is needed
};

}  // namespace

void draft_surface(SurfaceParts& parts) {
  SurfaceMaker(parts).draft();
}

void finish_surface(SurfaceParts& parts, const ChangedFacets& changed) {
  SurfaceMaker(parts).finish(changed);
}

std::pmr::vector<SampleOrigin> remake_surface(SurfaceParts& parts, const ChangedFacets& changed) {
  return SurfaceMaker(parts).remake(changed);
}

}  // namespace radvor
