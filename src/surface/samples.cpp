// Samples: shares at one site that smooth edges join are one receiver.
#include <cmath>
#include <utility>

#include "scene/disjoint_sets.h"
#include "surface/surface_parts.h"

namespace radvor {

namespace {

constexpr std::size_t k_range = 4096;

class SampleMaker {
 public:
  explicit SampleMaker(SurfaceParts& parts)
      : parts_(parts),
        sets_(static_cast<std::uint32_t>(parts.shares.size()), parts.memory),
        first_piece_(parts.welded.edges.size(), k_none, parts.memory),
        waiting_(parts.memory) {}

  void run() {
    parts_.samples.clear();
    join_shares();
    collect();
    finish();
  }

 private:
  struct Ends {
    std::uint32_t low = k_none, high = k_none;
  };

  void join(std::uint32_t a, std::uint32_t b) {
    sets_.unite(a, b);
    const std::uint32_t back_a = parts_.shares[a].other_side;
    const std::uint32_t back_b = parts_.shares[b].other_side;
    if (back_a != k_none && back_b != k_none) {
      sets_.unite(back_a, back_b);
    }
  }

  // The first facet at a piece of edge waits there for the second.
  void meet(const BorderPiece& piece) {
    std::uint32_t& first = first_piece_[piece.edge];
    if (first == k_none) {
      first = static_cast<std::uint32_t>(waiting_.size());
      waiting_.resize(waiting_.size() + parts_.borders.count_on_edge(piece.edge) + 1);
    }
    Ends& ends = waiting_[first + piece.index];
    if (ends.low == k_none) {
      ends = {piece.low, piece.high};
    } else {
      join(ends.low, piece.low);
      join(ends.high, piece.high);
    }
  }

  void join_shares() {
    for (std::uint32_t facet = 0; facet < parts_.records.size(); ++facet) {
      const FacetRecord& record = parts_.records[facet];
      if (record.first_share == k_none) {
        continue;
      }
      const std::uint32_t first = record.first_share;
      if (record.mesh == k_none) {
        for (const EdgeUse& use : parts_.welded.uses_of_triangle(parts_.facets.triangles_of(facet).front())) {
          if (parts_.borders.joins(use.edge)) {
            const std::uint32_t from = first + use.side;
            const std::uint32_t to = first + (use.side + 1u) % 3u;
            meet({use.edge, 0, use.forward ? from : to, use.forward ? to : from});
          }
        }
        continue;
      }
      const FacetDraft& facet_draft = parts_.drafts[record.mesh];
      for (const auto& pair : facet_draft.joined) {
        join(first + pair[0], first + pair[1]);
      }
      for (const BorderPiece& piece : facet_draft.pieces) {
        meet({piece.edge, piece.index, first + piece.low, first + piece.high});
      }
    }
  }

  // A set's smallest member makes the sample. Most are alone in it, so what goes side by side is all but the joining.
  void collect() {
    const auto count = static_cast<std::uint32_t>(parts_.shares.size());
    const Jobs& jobs = parts_.host.jobs;
    std::pmr::vector<std::uint32_t> first_of_range((count + k_range - 1) / k_range, parts_.memory);
    jobs.for_ranges(count, k_range, [&](std::size_t begin, std::size_t end) {
      for (std::size_t index = begin; index < end; ++index) {
        first_of_range[begin / k_range] += sets_.is_first(static_cast<std::uint32_t>(index)) ? 1 : 0;
      }
    });
    std::uint32_t total = 0;
    for (std::uint32_t& first : first_of_range) {
      total += std::exchange(first, total);
    }
    parts_.samples.resize(total);
    RawVector<std::uint32_t> last(total, parts_.memory);  // per sample: its latest share
    jobs.for_ranges(count, k_range, [&](std::size_t begin, std::size_t end) {
      std::uint32_t next = first_of_range[begin / k_range];
      for (auto index = static_cast<std::uint32_t>(begin); index < end; ++index) {
        if (sets_.is_first(index)) {
          Sample& sample = parts_.samples[next] = Sample{};
          sample.site = parts_.details.site[index];
          sample.first_share = last[next] = index;
          parts_.shares[index].sample = next++;
        }
      }
    });
    for (std::uint32_t index = 0; index < count; ++index) {
      if (!sets_.is_first(index)) {
        const std::uint32_t sample = parts_.shares[sets_.find(index)].sample;
        parts_.shares[index].sample = sample;
        parts_.shares[last[sample]].next_in_sample = index;
        last[sample] = index;
      }
    }
  }

  void finish() {
    parts_.host.jobs.for_ranges(parts_.samples.size(), k_range, [&](std::size_t begin, std::size_t end) {
      for (std::size_t index = begin; index < end; ++index) {
        finish(parts_.samples[index]);
      }
    });
  }

  void finish(Sample& sample) const {
    std::uint32_t largest = sample.first_share;
    Vec3 normal(0.0);
    for (std::uint32_t index = sample.first_share; index != k_none; index = parts_.shares[index].next_in_sample) {
      const Share& share = parts_.shares[index];
      sample.area += share.area;
      normal += share.area * parts_.details.normal[index];
      largest = share.area > parts_.shares[largest].area ? index : largest;
    }
    const Share& share = parts_.shares[largest];
    const double length = glm::length(normal);
    const bool alone = parts_.shares[sample.first_share].next_in_sample == k_none;
    sample.normal = alone || !(length > 0) ? parts_.details.normal[largest] : normal / length;
    sample.facet = share.facet;
    const Vec3& facet_normal = parts_.facets.facets[share.facet].frame.normal;
    sample.facet_normal = share.back ? -facet_normal : facet_normal;
    sample.point = parts_.details.receiver[largest];
  }

  SurfaceParts& parts_;
  DisjointSets sets_;
  std::pmr::vector<std::uint32_t> first_piece_;  // per edge: into waiting_
  std::pmr::vector<Ends> waiting_;
};

}  // namespace

void make_samples(SurfaceParts& parts) {
  SampleMaker(parts).run();
}

}  // namespace radvor
