// Patches: the facets' own, about their level-0 sites, and groups of what is too small for that.
#include <algorithm>
#include <limits>

#include "surface/facet_patches.h"
#include "surface/lattice.h"
#include "surface/patch_groups.h"
#include "surface/surface_parts.h"

namespace radvor {

namespace {

constexpr double k_group_area = 1.5;    // in patch areas: groups are halved until they are below, so 0.75 to 1.5
constexpr double k_group_extent = 1.5;  // in patch spacings
constexpr double k_whole_extent = 0.5;  // in patch spacings: up to this a facet's side is not divided

class PatchMaker {
 public:
  explicit PatchMaker(SurfaceParts& parts)
      : parts_(parts),
        own_counts_(parts.records.size(), 0, parts.memory),
        members_(parts.memory),
        ranges_(parts.memory) {}

  void run() {
    find_own();
    for (std::uint32_t facet = 0; facet < parts_.records.size(); ++facet) {
      const FacetRecord& record = parts_.records[facet];
      if (record.first_share != k_none) {
        number_own(record, own_counts_[facet]);
        gather(facet, record.first_share);
        if (record.two_sided) {
          gather(facet, record.first_share + record.share_count);
        }
      }
    }
    group();
    list();
  }

 private:
  struct Range {
    std::uint32_t first, end;  // shares
  };

  // Numbered from 0 in each facet.
  void find_own() {
    const auto find = [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
      std::pmr::vector<std::uint32_t> patch_of(parts_.memory);
      for (std::uint32_t facet = begin; facet < end; ++facet) {
        const FacetRecord& record = parts_.records[facet];
        if (record.first_share != k_none) {
          patch_of.resize(record.share_count);
          own_counts_[facet] = find_own_patches(parts_, facet, patch_of);
          for (std::uint32_t k = 0; k < record.share_count; ++k) {
            Share& front = parts_.shares[record.first_share + k];
            front.patch = patch_of[k];
            if (record.two_sided) {
              parts_.shares[front.other_side].patch = patch_of[k];
            }
          }
        }
      }
    };
    parts_.ranges_by_shares().for_each(parts_.host.jobs, find);
  }

  void number_own(const FacetRecord& record, std::uint32_t own) {
    for (std::uint32_t k = 0; own > 0 && k < record.share_count; ++k) {
      Share& front = parts_.shares[record.first_share + k];
      if (front.patch != k_none) {
        front.patch += count_;
        if (record.two_sided) {
          parts_.shares[front.other_side].patch += count_ + own;
        }
      }
    }
    count_ += record.two_sided ? 2 * own : own;
  }

  // What has no patch yet on one side of a facet, which begins at share `first`.
  void gather(std::uint32_t facet, std::uint32_t first) {
    const std::uint32_t end = first + parts_.records[facet].share_count;
    bool whole = true;
    Vec3 low(std::numeric_limits<double>::infinity());
    Vec3 high(-low);
    for (std::uint32_t share = first; share < end; ++share) {
      whole = whole && parts_.shares[share].patch == k_none;
      low = glm::min(low, parts_.shares[share].centroid);
      high = glm::max(high, parts_.shares[share].centroid);
    }
    const Vec3 size = high - low;
    whole = whole && std::max({size.x, size.y, size.z}) <= k_whole_extent * parts_.options.patch_spacing;
    if (whole && first < end) {
      add(facet, {first, end});
    }
    for (std::uint32_t share = first; !whole && share < end; ++share) {
      if (parts_.shares[share].patch == k_none) {
        add(facet, {share, share + 1});
      }
    }
  }

  void add(std::uint32_t facet, const Range& range) {
    const Facet& described = parts_.facets.facets[facet];
    PatchMember member{Vec3(0.0), described.frame.normal, 0,
                       parts_.scene.materials[described.material].emission != Color(0.0)};
    if (parts_.shares[range.first].back) {
      member.normal = -member.normal;
    }
    Vec3 mean(0.0);
    for (std::uint32_t share = range.first; share < range.end; ++share) {
      member.area += parts_.shares[share].area;
      member.position += parts_.shares[share].area * parts_.shares[share].centroid;
      mean += parts_.shares[share].centroid;
    }
    member.position = member.area > 0 ? member.position / member.area : mean / double(range.end - range.first);
    members_.push_back(member);
    ranges_.push_back(range);
  }

  void group() {
    const FacetLattice lattice(parts_.options.lattice, parts_.options.patch_spacing, Vec2(0.0));
    const PatchLimits limits{k_group_area * lattice.cell_area(), k_group_extent * parts_.options.patch_spacing};
    std::pmr::vector<std::uint32_t> groups(parts_.memory);
    const std::uint32_t group_count = group_members(members_, limits, groups, parts_.memory);
    for (std::size_t k = 0; k < ranges_.size(); ++k) {
      for (std::uint32_t share = ranges_[k].first; share < ranges_[k].end; ++share) {
        parts_.shares[share].patch = count_ + groups[k];
      }
    }
    count_ += group_count;
  }

  void list() {
    auto& first = parts_.first_of_patch;
    first.assign(count_ + 1, 0);
    for (const Share& share : parts_.shares) {
      ++first[share.patch + 1];
    }
    for (std::uint32_t patch = 0; patch < count_; ++patch) {
      first[patch + 1] += first[patch];
    }
    std::pmr::vector<std::uint32_t> next(first, parts_.memory);
    parts_.patch_members.resize(parts_.shares.size());
    for (std::uint32_t share = 0; share < parts_.shares.size(); ++share) {
      parts_.patch_members[next[parts_.shares[share].patch]++] = share;
    }
  }

  SurfaceParts& parts_;
  std::pmr::vector<std::uint32_t> own_counts_;  // per facet: patches of its own
  std::pmr::vector<PatchMember> members_;
  std::pmr::vector<Range> ranges_;  // per member
  std::uint32_t count_ = 0;
};

}  // namespace

void make_patches(SurfaceParts& parts) {
  PatchMaker(parts).run();
}

}  // namespace radvor
