#include "radiosity/shooting_tree.h"

#include <algorithm>
#include <cmath>

namespace radvor {

namespace {

// A node of more elements than this is split; into this many groups at most.
constexpr std::uint32_t k_leaves = 24;
constexpr std::uint32_t k_groups = 8;

// Splits [begin, end) at the median along the longest axis of the centroids, three times over: up to 8 groups of about
// the same size. Ties are broken by share, so the result depends on the elements alone.
void split_into_groups(std::span<std::uint32_t> order, std::span<const PlanePiece> pieces,
                       std::pmr::vector<std::uint32_t>& ends) {
  struct Part {
    std::uint32_t begin, end;
  };
  Part parts[k_groups] = {{0, static_cast<std::uint32_t>(order.size())}};
  std::uint32_t count = 1;
  while (count < k_groups) {
    const auto largest = std::max_element(
        parts, parts + count, [](const Part& a, const Part& b) { return a.end - a.begin < b.end - b.begin; });
    if (largest->end - largest->begin < 2) {
      break;
    }
    Vec3 low = pieces[order[largest->begin]].centroid, high = low;
    for (std::uint32_t i = largest->begin; i < largest->end; ++i) {
      low = glm::min(low, pieces[order[i]].centroid);
      high = glm::max(high, pieces[order[i]].centroid);
    }
    const Vec3 extent = high - low;
    const int axis = extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
    const std::uint32_t middle = (largest->begin + largest->end) / 2;
    std::nth_element(order.begin() + largest->begin, order.begin() + middle, order.begin() + largest->end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double x = pieces[a].centroid[axis], y = pieces[b].centroid[axis];
                       return x != y ? x < y : a < b;
                     });
    parts[count++] = {middle, largest->end};
    largest->end = middle;
  }
  std::sort(parts, parts + count, [](const Part& a, const Part& b) { return a.begin < b.begin; });
  ends.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    // nth_element leaves an order that the library may choose: make it one of our own.
    std::sort(order.begin() + parts[i].begin, order.begin() + parts[i].end);
    ends.push_back(parts[i].end);
  }
}

// To the rounding of its corners.
bool is_convex(std::span<const Vec3> polygon, const PlanePiece& piece) {
  const std::size_t size = polygon.size();
  for (std::size_t i = 0; i < size; ++i) {
    const Vec3 in = polygon[(i + 1) % size] - polygon[i];
    const Vec3 out = polygon[(i + 2) % size] - polygon[(i + 1) % size];
    if (glm::dot(glm::cross(in, out), piece.normal) < -1e-9 * piece.area) {
      return false;
    }
  }
  return size >= 3;
}

}  // namespace

std::array<Vec3, 4> bounding_rectangle(const TreeNode& node) {
  const auto at = [&](double u, double v) { return node.piece.centroid + u * node.piece.u + v * node.piece.v; };
  return {at(node.low.x, node.low.y), at(node.high.x, node.low.y), at(node.high.x, node.high.y),
          at(node.low.x, node.high.y)};
}

ShootingTree::ShootingTree(const Surface& surface, std::span<const std::uint32_t> patches, Host& host)
    : nodes_(&host.memory), elements_(&host.memory), corners_(&host.memory), roots_(&host.memory) {
  const auto shares = surface.shares();
  std::pmr::memory_resource* memory = &host.memory;
  std::pmr::vector<std::uint32_t> members(memory), first_member(1, 0u, memory);
  for (const std::uint32_t patch : patches) {
    const auto of_patch = surface.patch(patch);
    members.insert(members.end(), of_patch.begin(), of_patch.end());
    first_member.push_back(static_cast<std::uint32_t>(members.size()));
  }
  std::pmr::vector<PlanePiece> pieces(members.size(), memory);
  std::pmr::vector<double> radii(members.size(), 0.0, memory);
  std::pmr::vector<Bounds> bounds(members.size(), Bounds{Vec2(0.0), Vec2(0.0)}, memory);
  std::pmr::vector<std::uint32_t> first_corner(members.size() + 1, 0, memory);

  // Cells in parallel, by blocks of members; then one array.
  constexpr std::uint32_t k_block = 256;
  const auto member_count = static_cast<std::uint32_t>(members.size());
  const std::uint32_t block_count = (member_count + k_block - 1) / k_block;
  std::pmr::vector<std::pmr::vector<Vec3>> block_corners(block_count, memory);
  host.jobs.for_each(block_count, [&](std::uint32_t block) {
    std::pmr::vector<Vec3> polygon(memory);
    const std::uint32_t end = std::min(member_count, (block + 1) * k_block);
    for (std::uint32_t s = block * k_block; s < end; ++s) {
      const Share& share = shares[members[s]];
      const Frame& frame = surface.facets().facets[share.facet].frame;
      surface.cell(members[s], polygon);
      pieces[s] = share.back ? measure_polygon(polygon, frame.v, frame.u, -frame.normal)
                             : measure_polygon(polygon, frame.u, frame.v, frame.normal);
      pieces[s].area = share.area;
      for (const Vec3& corner : polygon) {
        const Vec3 apart = corner - pieces[s].centroid;
        const Vec2 in_plane(glm::dot(apart, pieces[s].u), glm::dot(apart, pieces[s].v));
        radii[s] = std::max(radii[s], glm::length(apart));
        bounds[s] = {glm::min(bounds[s].low, in_plane), glm::max(bounds[s].high, in_plane)};
      }
      first_corner[s + 1] = static_cast<std::uint32_t>(polygon.size());
      block_corners[block].insert(block_corners[block].end(), polygon.begin(), polygon.end());
    }
  });
  for (std::uint32_t s = 0; s < member_count; ++s) {
    first_corner[s + 1] += first_corner[s];
  }
  corners_.reserve(first_corner[member_count]);
  for (auto& block : block_corners) {
    corners_.insert(corners_.end(), block.begin(), block.end());
    block = std::pmr::vector<Vec3>(memory);
  }

  elements_.reserve(member_count);
  nodes_.reserve(member_count + member_count / 4 + patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    roots_.push_back(k_none);
    add_patch(surface, members, first_member[i], first_member[i + 1], pieces, radii, bounds, memory);
  }
  for (Element& element : elements_) {
    const std::uint32_t member = element.share;
    element.share = members[member];
    element.first_corner = first_corner[member];
    element.corner_count = first_corner[member + 1] - first_corner[member];
    element.convex = is_convex(polygon(element), pieces[member]);
  }
}

// Elements name members for now.
void ShootingTree::add_patch(const Surface& surface, std::span<const std::uint32_t> members, std::uint32_t first_member,
                             std::uint32_t end_member, std::span<const PlanePiece> pieces,
                             std::span<const double> radii, std::span<const Bounds> bounds,
                             std::pmr::memory_resource* memory) {
  std::pmr::vector<std::uint32_t> order(memory);
  for (std::uint32_t member = first_member; member < end_member; ++member) {
    if (pieces[member].area > 0) {
      order.push_back(member);
    }
  }
  if (order.empty()) {
    return;
  }
  const auto base = static_cast<std::uint32_t>(elements_.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    elements_.push_back({});
  }
  const auto shares = surface.shares();
  const auto describe = [&](std::uint32_t begin, std::uint32_t end) {
    TreeNode node;
    node.first_element = base + begin;
    node.element_count = end - begin;
    node.first_child = node.child_count = 0;
    node.piece = pieces[order[begin]];
    node.area_vector = node.piece.area * node.piece.normal;
    node.flat = true;
    Vec3 mean = node.piece.area * node.piece.centroid;
    double area = node.piece.area;
    for (std::uint32_t i = begin + 1; i < end; ++i) {
      const PlanePiece& piece = pieces[order[i]];
      node.flat = node.flat && shares[members[order[i]]].facet == shares[members[order[begin]]].facet &&
                  shares[members[order[i]]].back == shares[members[order[begin]]].back;
      if (node.flat) {
        node.piece = join(node.piece, piece);
      }
      node.area_vector += piece.area * piece.normal;
      mean += piece.area * piece.centroid;
      area += piece.area;
    }
    if (!node.flat) {
      node.piece = PlanePiece{};
      node.piece.centroid = mean / area;
      node.piece.area = area;
      const double length = glm::length(node.area_vector);
      node.piece.normal = length > 0 ? node.area_vector / length : pieces[order[begin]].normal;
    }
    node.radius = 0;
    node.low = node.high = Vec2(0.0);
    for (std::uint32_t i = begin; i < end; ++i) {
      const Vec3 apart = pieces[order[i]].centroid - node.piece.centroid;
      const Vec2 in_plane(glm::dot(apart, node.piece.u), glm::dot(apart, node.piece.v));
      node.low = glm::min(node.low, in_plane + bounds[order[i]].low);
      node.high = glm::max(node.high, in_plane + bounds[order[i]].high);
      node.radius =
          std::max(node.radius, glm::length(pieces[order[i]].centroid - node.piece.centroid) + radii[order[i]]);
    }
    return node;
  };

  roots_.back() = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(describe(0, static_cast<std::uint32_t>(order.size())));
  std::pmr::vector<std::uint32_t> ends(memory);
  for (std::uint32_t parent = roots_.back(); parent < nodes_.size(); ++parent) {
    const std::uint32_t begin = nodes_[parent].first_element - base;
    const std::uint32_t count = nodes_[parent].element_count;
    if (count == 1) {
      elements_[base + begin] = {order[begin], parent, 0, 0, false};
      continue;
    }
    ends.clear();
    if (count <= k_leaves) {
      for (std::uint32_t i = 1; i <= count; ++i) {
        ends.push_back(i);
      }
    } else {
      split_into_groups(std::span(order).subspan(begin, count), pieces, ends);
    }
    nodes_[parent].first_child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[parent].child_count = static_cast<std::uint32_t>(ends.size());
    std::uint32_t from = 0;
    for (const std::uint32_t to : ends) {
      nodes_.push_back(describe(begin + from, begin + to));
      from = to;
    }
  }
}

void ShootingTree::pull(std::span<NodeLight> light, Host& host) const {
  const auto patch_count = static_cast<std::uint32_t>(roots_.size());
  constexpr std::uint32_t k_block = 64;
  host.jobs.for_each((patch_count + k_block - 1) / k_block, [&](std::uint32_t block) {
    const std::uint32_t end = std::min(patch_count, (block + 1) * k_block);
    for (std::uint32_t patch = block * k_block; patch < end; ++patch) {
      if (roots_[patch] == k_none) {
        continue;
      }
      // The patch's nodes run from its root to the next patch's; children come after their parents.
      std::uint32_t last = patch + 1;
      while (last < patch_count && roots_[last] == k_none) {
        ++last;
      }
      const std::uint32_t stop = last < patch_count ? roots_[last] : static_cast<std::uint32_t>(nodes_.size());
      for (std::uint32_t index = stop; index-- > roots_[patch];) {
        const TreeNode& node = nodes_[index];
        if (node.child_count == 0) {
          continue;
        }
        NodeLight sum;
        for (std::uint32_t child = node.first_child; child < node.first_child + node.child_count; ++child) {
          const PlanePiece& piece = nodes_[child].piece;
          sum.radiosity += piece.area * light[child].radiosity;
          if (node.flat) {
            const Vec3 apart = piece.centroid - node.piece.centroid;
            const double child_radius = nodes_[child].radius;
            sum.moment_u += piece.area * (glm::dot(apart, node.piece.u) * light[child].radiosity +
                                          child_radius * light[child].moment_u);
            sum.moment_v += piece.area * (glm::dot(apart, node.piece.v) * light[child].radiosity +
                                          child_radius * light[child].moment_v);
          }
        }
        light[index].radiosity = sum.radiosity / node.piece.area;
        light[index].moment_u = sum.moment_u / (node.piece.area * node.radius);
        light[index].moment_v = sum.moment_v / (node.piece.area * node.radius);
      }
    }
  });
}

}  // namespace radvor
