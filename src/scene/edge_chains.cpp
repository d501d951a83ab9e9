#include "scene/edge_chains.h"

#include <algorithm>
#include <cmath>

namespace radvor {
namespace {

double squared_length(const Vec3& v) {
  return dot(v, v);
}

// Longer first; of equally long ones the ends decide, so that the order is strict whatever the numbering.
bool longer(const Tolerance& t, std::array<std::uint32_t, 2> a, std::array<std::uint32_t, 2> b) {
  const auto& p = t.positions;
  const double length_a = squared_length(p[a[0]] - p[a[1]]);
  const double length_b = squared_length(p[b[0]] - p[b[1]]);
  if (length_a != length_b) {
    return length_a > length_b;
  }
  for (auto* ends : {&a, &b}) {
    if (lies_before(p[(*ends)[1]], p[(*ends)[0]])) {
      std::swap((*ends)[0], (*ends)[1]);
    }
  }
  return a[0] != b[0] ? lies_before(p[a[0]], p[b[0]]) : a[1] != b[1] && lies_before(p[a[1]], p[b[1]]);
}

// Separating axes of a segment and a box (Ericson, Real-Time Collision Detection, 5.3.3), the box grown by `margin`.
class SegmentProbe {
 public:
  SegmentProbe(const Vec3& from, const Vec3& to, double margin)
      : middle_(0.5 * (from + to)), half_(0.5 * (to - from)), reach_(abs(half_)), margin_(margin) {}

  bool touches(const Box& box) const {
    const Vec3 size = 0.5 * (box.high - box.low) + margin_;
    const Vec3 offset = middle_ - 0.5 * (box.low + box.high);
    const Vec3 apart = abs(offset);
    if (apart.x > size.x + reach_.x || apart.y > size.y + reach_.y || apart.z > size.z + reach_.z) {
      return false;
    }
    const Vec3 normal = abs(cross(offset, half_));
    return normal.x <= size.y * reach_.z + size.z * reach_.y && normal.y <= size.x * reach_.z + size.z * reach_.x &&
           normal.z <= size.x * reach_.y + size.y * reach_.x;
  }

 private:
  static Vec3 abs(const Vec3& v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }
  Vec3 middle_, half_, reach_;
  double margin_;
};

}  // namespace

int apex_of_sliver(const Tolerance& tolerance, const std::array<std::uint32_t, 3>& v) {
  int apex = 0;
  for (int i = 1; i < 3; ++i) {
    const auto side = [&](int opposite) {
      return std::array{v[static_cast<std::size_t>((opposite + 1) % 3)],
                        v[static_cast<std::size_t>((opposite + 2) % 3)]};
    };
    if (longer(tolerance, side(i), side(apex))) {
      apex = i;
    }
  }
  const Vec3& a = tolerance.positions[v[static_cast<std::size_t>((apex + 1) % 3)]];
  const Vec3& b = tolerance.positions[v[static_cast<std::size_t>((apex + 2) % 3)]];
  const Vec3& c = tolerance.positions[v[static_cast<std::size_t>(apex)]];
  const double twice_area = length(cross(b - a, c - a));
  return twice_area <= tolerance.touching(v[0], v[1], v[2]) * length(b - a) ? apex : -1;
}

EdgeChains::EdgeChains(const Tolerance& tolerance, std::pmr::memory_resource* memory)
    : tolerance_(tolerance),
      memory_(memory),
      segments_(memory),
      table_(tolerance.positions.size() * 3, memory),  // Euler: about three edges a vertex
      inside_(memory),
      children_(memory),
      apexes_(memory),
      tree_vertices_(memory),
      in_tree_(tolerance.positions.size(), false, memory),
      stack_(memory) {
  segments_.reserve(tolerance.positions.size() * 3);
}

std::uint32_t EdgeChains::segment_between(std::uint32_t a, std::uint32_t b) {
  if (a > b) {
    std::swap(a, b);
  }
  const std::uint32_t next = segment_count();
  const std::uint32_t found = table_.find_or_insert(
      hash_pair(a, b), next, [&](std::uint32_t other) { return segments_[other].a == a && segments_[other].b == b; });
  if (found == next) {
    segments_.push_back({a, b});
  }
  return found;
}

double EdgeChains::parameter(const Segment& segment, std::uint32_t vertex) const {
  const Vec3& a = tolerance_.positions[segment.a];
  const Vec3 side = tolerance_.positions[segment.b] - a;
  return dot(tolerance_.positions[vertex] - a, side) / squared_length(side);
}

std::array<std::uint32_t, 3> EdgeChains::add_triangle(const std::array<std::uint32_t, 3>& vertices, int apex) {
  std::array<std::uint32_t, 3> segments;
  for (std::size_t i = 0; i < 3; ++i) {
    segments[i] = segment_between(vertices[i], vertices[(i + 1) % 3]);
    const std::uint32_t opposite = vertices[(i + 2) % 3];
    if (static_cast<int>((i + 2) % 3) == apex) {
      hand_down(segments[i], opposite);
    }
    if (!in_tree_[opposite]) {
      in_tree_[opposite] = true;
      tree_vertices_.push_back(opposite);
    }
  }
  return segments;
}

void EdgeChains::plant_tree() {
  std::pmr::vector<Box> boxes(tree_vertices_.size(), memory_);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::uint32_t vertex = tree_vertices_[i];
    // Grown so that, with the margin of a probe, the sum is no less than the tolerance of the three together.
    const double share = touching_distance(tolerance_.precision[vertex], tolerance_.weld_distance);
    boxes[i].add(tolerance_.positions[vertex] - share);
    boxes[i].add(tolerance_.positions[vertex] + share);
  }
  tree_.emplace(boxes, memory_);
}

void EdgeChains::find_inside(std::uint32_t index, std::pmr::vector<Found>& found) const {
  const Segment& segment = segments_[index];
  const Vec3& a = tolerance_.positions[segment.a];
  const Vec3 side = tolerance_.positions[segment.b] - a;
  const double side_length = length(side);
  const double ends = tolerance_.precision[segment.a] + tolerance_.precision[segment.b];
  const SegmentProbe probe(a, a + side, touching_distance(ends, 0));
  tree_->walk([&](const Box& box) { return probe.touches(box); },
              [&](std::uint32_t item) {
                const std::uint32_t vertex = tree_vertices_[item];
                if (vertex == segment.a || vertex == segment.b) {
                  return;
                }
                const double touching = tolerance_.touching(segment.a, segment.b, vertex);
                const double along = parameter(segment, vertex);
                const Vec3 off = tolerance_.positions[vertex] - (a + along * side);
                // A vertex that nearly coincides with an end is that end's twin, not inside.
                const double to_end = std::min(along, 1 - along) * side_length;
                if (to_end > 2 * touching && squared_length(off) <= touching * touching) {
                  found.push_back({index, {vertex, along}});
                }
              });
}

// Too near each other to be told apart along a segment.
bool EdgeChains::are_twins(std::uint32_t segment, std::uint32_t a, std::uint32_t b) const {
  const double near = 2 * tolerance_.touching(segments_[segment].a, segments_[segment].b, a);
  return squared_length(tolerance_.positions[a] - tolerance_.positions[b]) <= near * near;
}

void EdgeChains::sort_along(std::span<Found> found) const {
  const auto& positions = tolerance_.positions;
  std::sort(found.begin(), found.end(), [&](const Found& a, const Found& b) {
    return a.inside.along != b.inside.along ? a.inside.along < b.inside.along
                                            : a.inside.vertex != b.inside.vertex &&
                                                  lies_before(positions[a.inside.vertex], positions[b.inside.vertex]);
  });
}

// Of one segment, in no order. Of twins one is enough.
void EdgeChains::lay_inside(std::span<Found> found) {
  sort_along(found);
  const std::uint32_t index = found.front().segment;
  Segment& segment = segments_[index];
  segment.first_inside = static_cast<std::uint32_t>(inside_.size());
  for (const Found& one : found) {
    if (segment.inside_count == 0 || !are_twins(index, one.inside.vertex, inside_.back().vertex)) {
      inside_.push_back(one.inside);
      ++segment.inside_count;
    }
  }
}

bool EdgeChains::is_smaller(std::uint32_t from, std::uint32_t to, const Segment& than) const {
  return longer(tolerance_, {than.a, than.b}, {from, to});
}

// Replaces one segment by those between the vertices inside it. Each must be smaller, or splitting need not end: where
// rounding makes one longer (two twins across a segment hardly longer than the tolerance) the segment stays whole.
void EdgeChains::divide(std::uint32_t index) {
  const Segment parent = segments_[index];
  if (parent.inside_count == 0) {
    return;
  }
  const auto for_each_part = [&](auto&& function) {
    std::uint32_t from = parent.a;
    for (std::uint32_t i = 0; i < parent.inside_count; ++i) {
      const std::uint32_t to = inside_[parent.first_inside + i].vertex;
      function(from, to);
      from = to;
    }
    function(from, parent.b);
  };
  bool all_smaller = true;
  for_each_part(
      [&](std::uint32_t from, std::uint32_t to) { all_smaller = all_smaller && is_smaller(from, to, parent); });
  if (!all_smaller) {
    segments_[index].inside_count = 0;
    return;
  }
  segments_[index].first_child = static_cast<std::uint32_t>(children_.size());
  for_each_part([&](std::uint32_t from, std::uint32_t to) { children_.push_back(segment_between(from, to)); });
}

void EdgeChains::hand_down(std::uint32_t segment, std::uint32_t vertex) {
  apexes_.push_back({segment, {vertex, parameter(segments_[segment], vertex)}});
}

// The longest side of a dropped sliver must consist of its other two sides, whatever lies inside these: it is divided
// at the apex alone, and the parts, which are those sides, divide themselves. Where several slivers share a longest
// side it is divided at one apex; the part behind hands on the others, and the sides of their slivers get that one, as
// if they had slivers of their own. Longest first, so that a segment knows all its apexes; the middle one, so that k of
// them make no more than k log k segments.
void EdgeChains::lay_apexes() {
  const auto shorter = [&](const Found& a, const Found& b) {
    const Segment& one = segments_[a.segment];
    return a.segment != b.segment && is_smaller(one.a, one.b, segments_[b.segment]);
  };
  std::make_heap(apexes_.begin(), apexes_.end(), shorter);
  std::pmr::vector<Found> group(memory_);
  while (!apexes_.empty()) {
    group.clear();
    const std::uint32_t index = apexes_.front().segment;
    while (!apexes_.empty() && apexes_.front().segment == index) {
      group.push_back(apexes_.front());
      std::pop_heap(apexes_.begin(), apexes_.end(), shorter);
      apexes_.pop_back();
    }
    sort_along(group);
    const auto same = [](const Found& a, const Found& b) { return a.inside.vertex == b.inside.vertex; };
    group.erase(std::unique(group.begin(), group.end(), same), group.end());
    auto middle = group.end();
    while (!group.empty() && segments_[index].inside_count == 0) {
      middle = group.begin() + static_cast<std::ptrdiff_t>(group.size() / 2);
      segments_[index].first_inside = static_cast<std::uint32_t>(inside_.size());
      segments_[index].inside_count = 1;
      inside_.push_back(middle->inside);
      divide(index);
      if (segments_[index].inside_count == 0) {
        group.erase(middle);
      }
    }
    const Segment whole = segments_[index];
    const auto hand = [&](std::uint32_t from, std::uint32_t to, std::uint32_t vertex) {
      if (is_smaller(from, to, whole)) {
        hand_down(segment_between(from, to), vertex);
        std::push_heap(apexes_.begin(), apexes_.end(), shorter);
      }
    };
    for (auto other = group.begin(); other != group.end(); ++other) {
      const std::uint32_t vertex = other->inside.vertex;
      if (other < middle) {
        hand(whole.a, middle->inside.vertex, vertex);
        hand(vertex, whole.b, middle->inside.vertex);
      } else if (other > middle) {
        hand(middle->inside.vertex, whole.b, vertex);
        hand(whole.a, vertex, middle->inside.vertex);
      }
    }
  }
}

void EdgeChains::split(const Jobs& jobs) {
  constexpr std::uint32_t k_chunk = 4096;
  if (!tree_) {
    plant_tree();
    lay_apexes();
  }
  std::pmr::vector<std::pmr::vector<Found>> found_by_chunk(memory_);
  std::pmr::vector<Found> found(memory_);
  while (searched_ < segment_count()) {
    const std::uint32_t begin = searched_;
    const std::uint32_t end = segment_count();
    found_by_chunk.resize((end - begin + k_chunk - 1) / k_chunk);
    jobs.for_each(static_cast<std::uint32_t>(found_by_chunk.size()), [&](std::uint32_t chunk) {
      found_by_chunk[chunk].clear();
      const std::uint32_t first = begin + chunk * k_chunk;
      for (std::uint32_t i = first; i < std::min(end, first + k_chunk); ++i) {
        if (!is_divided(i)) {
          find_inside(i, found_by_chunk[chunk]);
        }
      }
    });
    found.clear();
    for (const auto& part : found_by_chunk) {
      found.insert(found.end(), part.begin(), part.end());
    }
    // Not std::stable_sort, whose buffer is not the host's memory; lay_inside puts each segment's in order.
    std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.segment < b.segment; });
    for (std::size_t i = 0; i < found.size();) {
      std::size_t j = i + 1;
      while (j < found.size() && found[j].segment == found[i].segment) {
        ++j;
      }
      lay_inside(std::span(found).subspan(i, j - i));
      divide(found[i].segment);
      i = j;
    }
    searched_ = end;
  }
}

void EdgeChains::refuse(std::uint32_t index, std::uint32_t vertex) {
  Segment& segment = segments_[index];
  const auto begin = inside_.begin() + segment.first_inside;
  const auto end = begin + segment.inside_count;
  const auto gone = std::remove_if(begin, end, [&](const Inside& inside) { return inside.vertex == vertex; });
  if (gone != end) {
    segment.inside_count = static_cast<std::uint32_t>(gone - begin);
    divide(index);
  }
}

void EdgeChains::chain(std::uint32_t whole, std::uint32_t start_of_whole, std::pmr::vector<Link>& links) {
  const Segment& outer = segments_[whole];
  stack_.assign(1, {start_of_whole, outer.a == start_of_whole ? outer.b : outer.a, whole, whole});
  while (!stack_.empty()) {
    const Link link = stack_.back();
    stack_.pop_back();
    const Segment& segment = segments_[link.segment];
    if (segment.inside_count == 0) {
      links.push_back(link);
      continue;
    }
    // The last part is pushed first.
    const bool forward = link.from == segment.a;
    std::uint32_t end = link.to;
    for (std::uint32_t i = 0; i <= segment.inside_count; ++i) {
      const std::uint32_t child = children_[segment.first_child + (forward ? segment.inside_count - i : i)];
      const std::uint32_t start = segments_[child].a == end ? segments_[child].b : segments_[child].a;
      stack_.push_back({start, end, child, start == link.from ? link.parent : link.segment});
      end = start;
    }
  }
}

}  // namespace radvor
