// The diagonals of a cocircular polygon join vertices of similar value: the least sum of |difference|, by dynamic
// programming over its chords (G. T. Klincsek, "Minimal triangulations of polygonal domains", 1980), by greedy ears
// where it has many corners. Without values, and where costs are equal, it is the fan of its least corner.
#include "delaunay/tie_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radvor::delaunay {

namespace {
constexpr std::uint32_t k_most_exact = 40;  // corners; cubic time above

// The determinant is the power of the point times the triangle's doubled area: a needle's is small at any point, so the
// area, too, is what it is compared to. For the corners of a rectangle that asks for no more.
bool lies_near_circle(const Triangulation& d, TriangleId t, Vec2 point, double tolerance) {
  const auto corners = d.triangle(t);
  Vec2 from[3];
  double lift[3];
  for (std::size_t k = 0; k < 3; ++k) {
    from[k] = d.position(corners[k]) - point;
    lift[k] = from[k].x * from[k].x + from[k].y * from[k].y;
  }
  double determinant = 0;
  double magnitude = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2& b = from[(k + 1) % 3];
    const Vec2& c = from[(k + 2) % 3];
    determinant += lift[k] * (b.x * c.y - c.x * b.y);
    magnitude += lift[k] * (std::fabs(b.x * c.y) + std::fabs(c.x * b.y));
  }
  const Vec2 along = from[1] - from[0], across = from[2] - from[0];
  const double doubled_area = std::fabs(along.x * across.y - along.y * across.x);
  return std::fabs(determinant) <=
         tolerance * std::min(magnitude, 4 * doubled_area * *std::max_element(lift, lift + 3));
}
}  // namespace

TiePolygon::TiePolygon(std::pmr::memory_resource* memory)
    : triangles_(memory),
      corners_(memory),
      outer_(memory),
      values_(memory),
      positions_(memory),
      ears_(memory),
      stack_(memory),
      costs_(memory),
      apexes_(memory),
      before_(memory),
      after_(memory) {}

std::uint32_t TiePolygon::collect(const Triangulation& d, TriangleId seed) {
  return collect_where(d, seed, [&](HalfEdge h) { return d.lies_on_circle(h); });
}

std::uint32_t TiePolygon::collect_near(const Triangulation& d, TriangleId seed, double tolerance,
                                       std::span<const std::uint8_t> taken) {
  const auto seed_corners = d.triangle(seed);
  corners_.assign(seed_corners.begin(), seed_corners.end());
  return collect_where(d, seed, [&](HalfEdge h) {
    if (!d.is_ordinary(h) || taken[triangle_of(h)] != 0) {
      return false;
    }
    const VertexId apex = d.apex(h);
    const bool belongs = tolerance > 0 ? lies_near_circle(d, seed, d.position(apex), tolerance) : d.lies_on_circle(h);
    // Near a circle a vertex may be met from two sides: once is enough.
    if (!belongs || std::find(corners_.begin(), corners_.end(), apex) != corners_.end()) {
      return false;
    }
    corners_.push_back(apex);
    return true;
  });
}

// Like the cavity of an insertion: a tree of triangles whose border comes out in order.
template <class Belongs>
std::uint32_t TiePolygon::collect_where(const Triangulation& d, TriangleId seed, Belongs&& belongs) {
  triangles_.assign(1, seed);
  outer_.clear();
  stack_.clear();
  for (std::uint32_t corner = 3; corner-- > 0;) {
    stack_.push_back(d.twin(half_edge(seed, corner)));
  }
  while (!stack_.empty()) {
    const HalfEdge h = stack_.back();
    stack_.pop_back();
    if (belongs(h)) {
      triangles_.push_back(triangle_of(h));
      stack_.push_back(d.twin(previous(h)));
      stack_.push_back(d.twin(next(h)));
    } else {
      outer_.push_back(h);
    }
  }
  const auto least = std::min_element(outer_.begin(), outer_.end(), [&](HalfEdge a, HalfEdge b) {
    return lexicographically_less(d.position(d.target(a)), d.position(d.target(b)));
  });
  std::rotate(outer_.begin(), least, outer_.end());
  corners_.clear();
  values_.clear();
  positions_.clear();
  for (const HalfEdge h : outer_) {
    corners_.push_back(d.target(h));
    values_.push_back(d.value(d.target(h)));
    positions_.push_back(d.position(d.target(h)));
  }
  return static_cast<std::uint32_t>(corners_.size());
}

double TiePolygon::difference(std::uint32_t i, std::uint32_t j) const {
  return std::fabs(values_[i] - values_[j]);
}

bool TiePolygon::resolve(const Triangulation& d) {
  decide();
  return is_new(d);
}

bool TiePolygon::resolve(const Triangulation& d, std::span<const double> values) {
  values_.assign(values.begin(), values.end());
  decide();
  if (!is_new(d)) {
    return false;
  }
  double now = 0;  // every diagonal is a side of two triangles
  const auto corner_of_vertex = [&](VertexId v) {
    return static_cast<std::uint32_t>(std::find(corners_.begin(), corners_.end(), v) - corners_.begin());
  };
  const auto is_diagonal = [&](std::uint32_t i, std::uint32_t j) {
    const auto size = static_cast<std::uint32_t>(corners_.size());
    return (i + 1) % size != j && (j + 1) % size != i;
  };
  for (const TriangleId t : triangles_) {
    const auto vertices = d.triangle(t);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t i = corner_of_vertex(vertices[k]), j = corner_of_vertex(vertices[(k + 1) % 3]);
      now += is_diagonal(i, j) ? 0.5 * difference(i, j) : 0;
    }
  }
  double then = 0;
  bool sound = true;
  std::size_t left = ears_.size();
  for_each_decided([&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    then += --left > 0 ? difference(a, c) : 0;  // the last ear leaves no diagonal
    sound = sound && cross(positions_[b] - positions_[a], positions_[c] - positions_[a]) > 0;
  });
  return sound && then < now;
}

void TiePolygon::decide() {
  const auto unset = [](double value) { return std::isnan(value); };
  const auto same = [&](double value) { return value == values_[0]; };
  if (std::any_of(values_.begin(), values_.end(), unset) || std::all_of(values_.begin(), values_.end(), same)) {
    fan();
  } else if (corners_.size() <= k_most_exact) {
    resolve_exactly();
  } else {
    resolve_greedily();
  }
}

void TiePolygon::start_cutting() {
  const auto size = static_cast<std::uint32_t>(corners_.size());
  before_.resize(size);
  after_.resize(size);
  for (std::uint32_t i = 0; i < size; ++i) {
    before_[i] = (i + size - 1) % size;
    after_[i] = (i + 1) % size;
  }
}

// Every ear but the last leaves a diagonal.
bool TiePolygon::is_new(const Triangulation& d) {
  start_cutting();
  bool changed = false;
  for (std::size_t k = 0; k + 1 < ears_.size(); ++k) {
    const std::uint32_t a = before_[ears_[k]], c = after_[ears_[k]];
    changed = changed || d.find_edge(corners_[a], corners_[c]) == k_none;
    after_[a] = c;
    before_[c] = a;
  }
  return changed;
}

void TiePolygon::fan() {
  ears_.clear();
  for (std::uint32_t i = 1; i + 1 < corners_.size(); ++i) {
    ears_.push_back(i);
  }
}

// best(i, j): the cheapest triangulation of corners i ... j, without the chord i-j.
void TiePolygon::resolve_exactly() {
  const auto size = static_cast<std::uint32_t>(corners_.size());
  costs_.assign(std::size_t{size} * size, 0.0);
  apexes_.assign(std::size_t{size} * size, 0);
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return std::size_t{i} * size + j; };
  const auto chord = [&](std::uint32_t i, std::uint32_t j) { return j == i + 1 ? 0.0 : difference(i, j); };
  for (std::uint32_t span = 2; span < size; ++span) {
    for (std::uint32_t i = 0; i + span < size; ++i) {
      const std::uint32_t j = i + span;
      double best = std::numeric_limits<double>::infinity();
      std::uint32_t least = i;
      for (std::uint32_t k = i; k <= j; ++k) {
        least = lexicographically_less(positions_[k], positions_[least]) ? k : least;
      }
      const std::uint32_t of_fan = least == i ? j - 1 : least == j ? i + 1 : least;
      for (std::uint32_t k = i + 1; k < j; ++k) {
        const double cost = (costs_[at(i, k)] + chord(i, k)) + (costs_[at(k, j)] + chord(k, j));
        if (cost < best ||
            (cost == best && (k == of_fan || (apexes_[at(i, j)] != of_fan &&
                                              lexicographically_less(positions_[k], positions_[apexes_[at(i, j)]]))))) {
          best = cost;
          apexes_[at(i, j)] = k;
        }
      }
      costs_[at(i, j)] = best;
    }
  }
  // Apexes in the order in which they can be cut off: the outermost last. Pushed as i, j pairs, written backwards.
  ears_.clear();
  stack_.assign({0, size - 1});
  while (!stack_.empty()) {
    const std::uint32_t j = stack_.back();
    stack_.pop_back();
    const std::uint32_t i = stack_.back();
    stack_.pop_back();
    if (j > i + 1) {
      const std::uint32_t k = apexes_[at(i, j)];
      ears_.push_back(k);
      stack_.insert(stack_.end(), {i, k, k, j});
    }
  }
  std::reverse(ears_.begin(), ears_.end());
}

// The cheapest ear next; of equal ones that with the lowest corner.
void TiePolygon::resolve_greedily() {
  const auto size = static_cast<std::uint32_t>(corners_.size());
  before_.resize(size);
  after_.resize(size);
  costs_.resize(size);
  apexes_.clear();  // a heap of corners; a corner whose ear got another cost is there again
  struct Entry {
    double cost;
    std::uint32_t corner;
    bool operator<(const Entry& other) const {
      return cost > other.cost || (cost == other.cost && corner > other.corner);
    }
  };
  std::pmr::vector<Entry> heap(apexes_.get_allocator().resource());
  const auto consider = [&](std::uint32_t i) {
    costs_[i] = difference(before_[i], after_[i]);
    heap.push_back({costs_[i], i});
    std::push_heap(heap.begin(), heap.end());
  };
  for (std::uint32_t i = 0; i < size; ++i) {
    before_[i] = (i + size - 1) % size;
    after_[i] = (i + 1) % size;
    consider(i);
  }
  ears_.clear();
  while (ears_.size() + 2 < size) {
    std::pop_heap(heap.begin(), heap.end());
    const Entry entry = heap.back();
    heap.pop_back();
    const std::uint32_t i = entry.corner;
    if (after_[i] == k_none || entry.cost != costs_[i]) {
      continue;
    }
    ears_.push_back(i);
    const std::uint32_t a = before_[i], c = after_[i];
    after_[i] = k_none;
    after_[a] = c;
    before_[c] = a;
    consider(a);
    consider(c);
  }
}

void TiePolygon::apply(Mesh& mesh) const {
  const auto size = static_cast<std::uint32_t>(corners_.size());
  const std::uint8_t state = mesh.state(triangles_[0]);
  std::pmr::vector<HalfEdge> outer(outer_, outer_.get_allocator());
  std::pmr::vector<std::uint32_t> before(size, outer_.get_allocator()), after(size, outer_.get_allocator());
  for (std::uint32_t i = 0; i < size; ++i) {
    before[i] = (i + size - 1) % size;
    after[i] = (i + 1) % size;
  }
  for (std::size_t k = 0; k < ears_.size(); ++k) {
    const std::uint32_t b = ears_[k], a = before[b], c = after[b];
    const TriangleId t = triangles_[k];
    mesh.set_triangle(t, corners_[a], corners_[b], corners_[c], state);
    const auto join = [&](std::uint32_t corner, HalfEdge beyond) {
      mesh.write(t).constraint[corner] = mesh.constraint(beyond);
      mesh.link(half_edge(t, corner), beyond);
    };
    join(0, outer[a]);
    join(1, outer[b]);
    if (k + 1 == ears_.size()) {
      join(2, outer[c]);
    } else {
      outer[a] = half_edge(t, 2);  // seen from the rest, the side from a to c
      after[a] = c;
      before[c] = a;
    }
  }
}

}  // namespace radvor::delaunay
