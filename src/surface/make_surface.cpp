// The steps that make a surface. Facets are built side by side; numbers are given in one serial pass between, so that
// they are the same for any number of threads.
#include "surface/make_surface.h"

#include <algorithm>

#include "base/even_ranges.h"
#include "surface/facet_ground.h"
#include "surface/fill_shares.h"
#include "surface/given_sites.h"
#include "surface/spaced_points.h"

namespace radvor {

namespace {

constexpr double k_seconds_of_site = 2e-6;  // about, of a facet that is triangulated
constexpr std::size_t k_facets_a_task = 64;

class SurfaceMaker {
 public:
  explicit SurfaceMaker(SurfaceParts& parts)
      : parts_(parts),
        facets_(parts.memory),
        retired_(parts.memory),
        inner_sites_(parts.memory),
        first_before_(parts.memory) {}

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
    const auto input_of = [&](std::uint32_t k) { return parts_.input(facets_[k]); };
    Pace pace(parts_.memory);
    build_meshes(input_of, pace).finish();
    number();
    place_border_sites();
  }

  void finish(const ChangedFacets& changed) {
    Pace pace(parts_.memory);
    build_anew(changed, pace).finish();
    renumber_kept();
    free_retired();
    facets_.clear();
    for (std::uint32_t facet = 0; facet < parts_.records.size(); ++facet) {
      if (parts_.records[facet].first_share != k_none) {
        facets_.push_back(facet);
      }
    }
    make_room();
    fill_shares(parts_, facets_, pace).finish();
    make_samples(parts_);
  }

  Steps remake(const ChangedFacets& changed, Remaking& remaking, Pace& pace) {
    remaking.before.emplace(parts_, changed.facets);
    co_await build_anew(changed, pace);
    make_room();
    copy_shares(*remaking.before);
    co_await pace;
    co_await fill_shares(parts_, facets_, pace);
    const double pass = k_seconds_of_pass * static_cast<double>(parts_.shares.size());
    co_await pace.time_for(pass);
    make_samples(parts_);
    co_await pace;
    co_await find_origins(parts_, *remaking.before, facets_, remaking.origins, pace);
    co_await pace.time_for(pass);  // for what is here, and for Solver::follow, which comes at once
    remaking.before.reset();
    renumber_kept();
    free_retired();
  }

 private:
  Steps build_anew(const ChangedFacets& changed, Pace& pace) {
    facets_.assign(changed.facets.begin(), changed.facets.end());
    const auto input_of = [&](std::uint32_t k) {
      FacetInput input = parts_.input(facets_[k]);
      input.inner = changed.inner_of(k);
      return input;
    };
    co_await build_meshes(input_of, pace);
    number();
    co_await pace;
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
  Steps build_meshes(const InputOf& input_of, Pace& pace) {
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
    const auto build = [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t k = begin; k < end; ++k) {
        const std::uint32_t mesh = parts_.records[facets_[meshed[k]]].mesh;
        parts_.meshes[mesh].emplace(input_of(meshed[k]), parts_.drafts[mesh]);
      }
    };
    co_await pace.time_for(k_seconds_of_site * ranges.heaviest());  // a large facet is one task
    co_await ranges.for_each(parts_.host.jobs, build, pace);
  }

  // Shares of all facets; sites that are still without a number, in facets built now. The others' triangles keep the
  // numbers that their shares had.
  void number() {
    first_before_.resize(parts_.records.size());
    std::uint32_t shares = 0;
    for (std::uint32_t facet = 0; facet < parts_.records.size(); ++facet) {
      FacetRecord& record = parts_.records[facet];
      first_before_[facet] = record.first_share;
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
    parts_.host.jobs.for_ranges(facets_.size(), k_facets_a_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const FacetRecord& record = parts_.records[facets_[k]];
        first_before_[facets_[k]] = record.first_share;
        if (record.mesh != k_none) {
          parts_.meshes[record.mesh]->number_shares(record.first_share);
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

  // The triangles of facets that were not built now.
  void renumber_kept() {
    parts_.ranges_by_shares().for_each_in_parts(
        parts_.host.jobs, [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
          for (std::uint32_t facet = begin; facet < end; ++facet) {
            const FacetRecord& record = parts_.records[facet];
            if (record.mesh != k_none && record.first_share != first_before_[facet]) {
              parts_.meshes[record.mesh]->number_shares(record.first_share - first_before_[facet]);
            }
          }
        });
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

  SurfaceParts& parts_;
  std::uint32_t share_count_ = 0;
  std::pmr::vector<std::uint32_t> facets_;        // built now
  std::pmr::vector<std::uint32_t> retired_;       // meshes that others took the place of
  std::pmr::vector<std::uint32_t> inner_sites_;   // per welded vertex, once one is needed
  std::pmr::vector<std::uint32_t> first_before_;  // per facet: the share that its triangles' numbers begin at
};

}  // namespace

void draft_surface(SurfaceParts& parts) {
  SurfaceMaker(parts).draft();
}

void finish_surface(SurfaceParts& parts, const ChangedFacets& changed) {
  SurfaceMaker(parts).finish(changed);
}

Steps remake_surface(SurfaceParts& parts, const ChangedFacets& changed, Remaking& remaking, Pace& pace) {
  SurfaceMaker maker(parts);
  co_await maker.remake(changed, remaking, pace);
}

}  // namespace radvor
