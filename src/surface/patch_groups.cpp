#include "surface/patch_groups.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace radvor {

namespace {

constexpr double k_normal_extent = 0.8;  // along each axis: cuts between the faces of a box, at about 50 degrees
constexpr double k_smallest = 1e-3;      // a group this small, in units of its limits, is not cut for its area's sake

using Key = std::array<double, 6>;

// Position and normal in units of what a group may span.
Key key_of(const PatchMember& member, const PatchLimits& limits) {
  return {member.position.x / limits.extent, member.position.y / limits.extent, member.position.z / limits.extent,
          member.normal.x / k_normal_extent, member.normal.y / k_normal_extent, member.normal.z / k_normal_extent};
}

struct Range {
  std::uint32_t begin, end;
};

struct Cut {
  std::size_t axis;
  double length;
  double middle;
};

// Those for which first() holds come first, both parts in the order they had; returns where the second part begins.
// (The standard library's own takes memory that is not the host's.)
template <class First>
std::uint32_t move_first(std::span<std::uint32_t> indices, std::pmr::vector<std::uint32_t>& rest, First&& first) {
  rest.clear();
  std::uint32_t end = 0;
  for (const std::uint32_t index : indices) {
    if (first(index)) {
      indices[end++] = index;
    } else {
      rest.push_back(index);
    }
  }
  std::copy(rest.begin(), rest.end(), indices.begin() + end);
  return end;
}

Cut longest_axis(std::span<const PatchMember> members, std::span<const std::uint32_t> range,
                 const PatchLimits& limits) {
  Key low = key_of(members[range.front()], limits);
  Key high = low;
  for (const std::uint32_t index : range) {
    const Key key = key_of(members[index], limits);
    for (std::size_t axis = 0; axis < key.size(); ++axis) {
      low[axis] = std::min(low[axis], key[axis]);
      high[axis] = std::max(high[axis], key[axis]);
    }
  }
  Cut cut{0, -1, 0};
  for (std::size_t axis = 0; axis < low.size(); ++axis) {
    if (high[axis] - low[axis] > cut.length) {
      cut = {axis, high[axis] - low[axis], 0.5 * (low[axis] + high[axis])};
    }
  }
  return cut;
}

}  // namespace

std::uint32_t group_members(std::span<const PatchMember> members, const PatchLimits& limits,
                            std::pmr::vector<std::uint32_t>& groups, std::pmr::memory_resource* memory) {
  groups.assign(members.size(), 0);
  std::pmr::vector<std::uint32_t> order(members.size(), memory);
  std::iota(order.begin(), order.end(), 0u);
  std::pmr::vector<std::uint32_t> rest(memory);
  const std::uint32_t lights = move_first(order, rest, [&](std::uint32_t index) { return members[index].emits; });

  std::pmr::vector<Range> open(memory);
  open.push_back({lights, static_cast<std::uint32_t>(order.size())});
  open.push_back({0, lights});
  std::uint32_t count = 0;
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    if (range.begin == range.end) {
      continue;
    }
    const std::span<std::uint32_t> indices(order.data() + range.begin, range.end - range.begin);
    const double area = std::accumulate(indices.begin(), indices.end(), 0.0,
                                        [&](double sum, std::uint32_t index) { return sum + members[index].area; });
    const Cut cut = longest_axis(members, indices, limits);
    if (cut.length > 1 || (area > limits.area && cut.length > k_smallest)) {
      const std::uint32_t at = range.begin + move_first(indices, rest, [&](std::uint32_t index) {
                                 return key_of(members[index], limits)[cut.axis] <= cut.middle;
                               });
      if (at != range.begin && at != range.end) {  // rounding may leave nothing to one side
        open.push_back({at, range.end});
        open.push_back({range.begin, at});
        continue;
      }
    }
    for (const std::uint32_t index : indices) {
      groups[index] = count;
    }
    ++count;
  }
  return count;
}

}  // namespace radvor
