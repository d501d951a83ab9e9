#include "surface/sample_origins.h"

#include <algorithm>
#include <numeric>

#include "surface/facet_location.h"

namespace radvor {

SurfaceBefore::SurfaceBefore(SurfaceParts& parts, std::span<const std::uint32_t> changed_facets)
    : shares(std::move(parts.shares)),
      samples(std::move(parts.samples)),
      details(std::move(parts.details)),
      records(parts.records, parts.memory),
      small_triangles(parts.small_triangles, parts.memory),
      changed(parts.records.size(), std::uint8_t{0}, parts.memory) {
  for (const std::uint32_t facet : changed_facets) {
    changed[facet] = 1;
  }
}

void SurfaceBefore::trade_places(SurfaceParts& parts) {
  shares.swap(parts.shares);
  samples.swap(parts.samples);
  std::swap(details, parts.details);
  records.swap(parts.records);
  small_triangles.swap(parts.small_triangles);
}

namespace {

constexpr std::size_t k_samples = 1024;  // of a task

class OriginFinder {
 public:
  OriginFinder(const SurfaceParts& parts, const SurfaceBefore& before)
      : parts_(parts), before_(before), old_share_(parts.shares.size(), k_none, parts.memory) {}

  // Shares that were there before, on unchanged facets and of old sites on changed ones.
  Steps match_shares(std::span<const std::uint32_t> changed, Pace& pace) {
    parts_.ranges_by_shares().for_each_in_parts(
        parts_.host.jobs, [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
          for (std::uint32_t facet = begin; facet < end; ++facet) {
            const FacetRecord& record = parts_.records[facet];
            if (record.first_share != k_none && !before_.is_changed(facet)) {
              const auto first = old_share_.begin() + record.first_share;
              const std::uint32_t count = record.two_sided ? 2 * record.share_count : record.share_count;
              std::iota(first, first + count, before_.records[facet].first_share);
            }
          }
        });
    co_await pace;
    constexpr double k_task = 1024;
    const EvenRanges ranges(
        changed.size(), k_task, [&](std::uint32_t k) { return 1.0 + parts_.records[changed[k]].share_count; },
        parts_.memory);
    const auto match = [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t k = begin; k < end; ++k) {
        match_shares(changed[k]);
      }
    };
    co_await ranges.for_each(parts_.host.jobs, match, pace);
  }

  Steps find(std::pmr::vector<SampleOrigin>& found, Pace& pace) const {
    constexpr std::size_t k_at_once = 8;  // tasks a thread
    const Jobs& jobs = parts_.host.jobs;
    found.resize(parts_.samples.size());
    const auto find_some = [&](std::size_t first, std::size_t last) {
      jobs.for_ranges(last - first, k_samples, [&](std::size_t begin, std::size_t end) {
        for (std::size_t index = first + begin; index < first + end; ++index) {
          found[index] = origin(parts_.samples[index]);
        }
      });
    };
    co_await in_portions(found.size(), k_at_once * k_samples * jobs.thread_count(), find_some, pace);
  }

 private:
  void match_shares(std::uint32_t facet) {
    const FacetMesh* mesh = triangulation(parts_.records[facet].mesh);
    const FacetMesh* old_mesh = triangulation(before_.records[facet].mesh);
    if (mesh && old_mesh) {
      match_vertices(*mesh, *old_mesh);
    } else {
      match_by_site(facet);
    }
    if (parts_.records[facet].two_sided) {
      match_backs(facet);
    }
  }

  const FacetMesh* triangulation(std::uint32_t mesh) const {
    return mesh == k_none || parts_.meshes[mesh]->degenerate() ? nullptr : &*parts_.meshes[mesh];
  }

  LocatedFacet before(std::uint32_t facet) const {
    const FacetRecord& record = before_.records[facet];
    const std::span<const ShareTriangle> triangles =
        record.mesh == k_none ? std::span<const ShareTriangle>(before_.small_triangles).subspan(facet, 1)
                              : parts_.meshes[record.mesh]->triangles();
    return {parts_.facets.facets[facet].frame,
            triangles,
            triangulation(record.mesh),
            parts_.sites,
            before_.samples,
            before_.shares};
  }

  // Vertices come in the same order before and after, with new ones between.
  void match_vertices(const FacetMesh& mesh, const FacetMesh& old_mesh) {
    delaunay::CellBuffer buffer(parts_.memory);
    std::pmr::vector<Vec2> now(parts_.memory), then(parts_.memory);
    std::uint32_t old = 0;
    for (std::uint32_t vertex = 0; vertex < mesh.sites().size(); ++vertex) {
      if (old == old_mesh.sites().size() || old_mesh.sites()[old] != mesh.sites()[vertex]) {
        continue;
      }
      const std::uint32_t count = mesh.end_share(vertex) - mesh.first_share(vertex);
      const std::uint32_t old_count = old_mesh.end_share(old) - old_mesh.first_share(old);
      if (count == 1 && old_count == 1) {
        old_share_[mesh.first_share(vertex)] = old_mesh.first_share(old);
      } else if (old_count > 0) {
        find_walls(mesh.triangulation(), vertex, buffer, now);
        find_walls(old_mesh.triangulation(), old, buffer, then);
        match_sectors(now, then, mesh.first_share(vertex), old_mesh.first_share(old));
      }
      ++old;
    }
  }

  // Per sector of a vertex: the direction of the wall that it begins at, unit.
  static void find_walls(const delaunay::Triangulation& triangulation, delaunay::VertexId vertex,
                         delaunay::CellBuffer& buffer, std::pmr::vector<Vec2>& directions) {
    bounded_cell(triangulation, vertex, buffer);
    directions.clear();
    for (const delaunay::Sector& sector : buffer.sectors()) {
      directions.push_back(
          glm::normalize(triangulation.position(triangulation.target(sector.first)) - triangulation.position(vertex)));
    }
  }

  // Walls stay where they are, and sectors run counter-clockwise: which is the first may have changed. Where one wall
  // is there no more, or one that was not is, each sector was the one that began at the nearest direction.
  void match_sectors(std::span<const Vec2> now, std::span<const Vec2> then, std::uint32_t first,
                     std::uint32_t first_old) {
    const auto best = [&](auto&& likeness) {
      std::size_t found = 0;
      for (std::size_t k = 1; k < then.size(); ++k) {
        found = likeness(k) > likeness(found) ? k : found;
      }
      return found;
    };
    const std::size_t turn = best([&](std::size_t by) {
      double sum = 0;
      for (std::size_t k = 0; k < now.size(); ++k) {
        sum += glm::dot(now[k], then[(k + by) % then.size()]);
      }
      return sum;
    });
    for (std::size_t k = 0; k < now.size(); ++k) {
      const std::size_t old = now.size() == then.size()
                                  ? (k + turn) % then.size()
                                  : best([&](std::size_t other) { return glm::dot(now[k], then[other]); });
      old_share_[first + k] = first_old + static_cast<std::uint32_t>(old);
    }
  }

  // Between receivers.
  double distance(std::uint32_t old, std::uint32_t share) const {
    return glm::distance(before_.details.receiver[old], parts_.details.receiver[share]);
  }

  // Facets that are, or were, no triangulation: rare, or of three corners.
  void match_by_site(std::uint32_t facet) {
    const FacetRecord& record = parts_.records[facet];
    const FacetRecord& old = before_.records[facet];
    std::pmr::vector<std::uint32_t> by_site(parts_.memory);
    for (std::uint32_t share = old.first_share; share < old.first_share + old.share_count; ++share) {
      by_site.push_back(share);
    }
    const auto site = [&](std::uint32_t share) { return before_.details.site[share]; };
    std::sort(by_site.begin(), by_site.end(),
              [&](std::uint32_t a, std::uint32_t b) { return site(a) != site(b) ? site(a) < site(b) : a < b; });
    for (std::uint32_t share = record.first_share; share < record.first_share + record.share_count; ++share) {
      const std::uint32_t wanted = parts_.details.site[share];
      auto at = std::lower_bound(by_site.begin(), by_site.end(), wanted,
                                 [&](std::uint32_t a, std::uint32_t b) { return site(a) < b; });
      std::uint32_t& found = old_share_[share];
      for (; at != by_site.end() && site(*at) == wanted; ++at) {
        found = found == k_none || distance(*at, share) < distance(found, share) ? *at : found;
      }
    }
  }

  void match_backs(std::uint32_t facet) {
    const FacetRecord& record = parts_.records[facet];
    for (std::uint32_t front = record.first_share; front < record.first_share + record.share_count; ++front) {
      if (old_share_[front] != k_none) {
        old_share_[front + record.share_count] = before_.shares[old_share_[front]].other_side;
      }
    }
  }

  SampleOrigin origin(const Sample& sample) const {
    for (std::uint32_t share = sample.first_share; share != k_none; share = parts_.shares[share].next_in_sample) {
      if (old_share_[share] != k_none) {
        const std::uint32_t old = before_.shares[old_share_[share]].sample;
        return {{old, old, old}, {1, 0, 0}, true};
      }
    }
    const Frame& frame = parts_.facets.facets[sample.facet].frame;
    const FacetPoint point = before(sample.facet).locate(frame.to_plane(sample.point));
    SampleOrigin origin{{}, {}, false};
    for (std::size_t k = 0; k < 3; ++k) {
      const Share& front = before_.shares[point.shares[k]];
      origin.samples[k] =
          parts_.shares[sample.first_share].back ? before_.shares[front.other_side].sample : front.sample;
      origin.weights[k] = static_cast<float>(point.weights[k]);
    }
    return origin;
  }

  const SurfaceParts& parts_;
  const SurfaceBefore& before_;
  std::pmr::vector<std::uint32_t> old_share_;  // per share: the one it was, or k_none
};

}  // namespace

Steps find_origins(const SurfaceParts& parts, const SurfaceBefore& before, std::span<const std::uint32_t> changed,
                   std::pmr::vector<SampleOrigin>& origins, Pace& pace) {
  OriginFinder finder(parts, before);
  co_await finder.match_shares(changed, pace);
  co_await finder.find(origins, pace);
}

}  // namespace radvor
