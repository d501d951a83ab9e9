// One question: which of these segments are blocked? And its sibling: what does this ray hit first?
// Answered by Embree (embree_visibility.h) or, for tests and where Embree's code cannot be instrumented, by brute
// force over all triangles (brute_force_visibility.h). Surfaces block from both sides.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "base/vector.h"

namespace radvor {

/// An open segment that light might travel.
struct Sightline {
  Vec3 from;
  Vec3 to;
};

/// What a ray meets first.
struct FirstHit {
  static constexpr std::uint32_t k_miss = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t triangle = k_miss;  ///< index among the triangles given at construction
  bool front = false;               ///< the side on which the triangle's corners run counter-clockwise
  double distance = 0;              ///< in lengths of `direction`
};

/// Immutable after construction; all calls may run on many threads at once and allocate nothing.
/// Segments are open: the caller lifts both ends off their surfaces by at least lift().
class Visibility {
 public:
  virtual ~Visibility() = default;

  /// blocked[i] = 1 where some triangle lies between from and to[i], else 0. Packed by the one origin: the fast way.
  virtual void blocked_from(const Vec3& from, std::span<const Vec3> to, std::uint8_t* blocked) const = 0;

  /// The same for unrelated segments, best with neighbours close together.
  virtual void blocked(std::span<const Sightline> segments, std::uint8_t* blocked) const = 0;

  /// The nearest triangle along from + t * direction, t > 0; direction of any length > 0.
  virtual FirstHit first_hit(const Vec3& from, const Vec3& direction) const = 0;

  /// The same for many directions, best where those that follow one another lie close together. hits: one each.
  virtual void first_hits(const Vec3& from, std::span<const Vec3> directions, FirstHit* hits) const = 0;

  /// Scene units by which an end must stand off a surface so that rounding cannot make the surface, or its neighbours
  /// in the plane, block it: from the precision of the coordinates, not a fixed epsilon. Clears triangles up to 100
  /// times as long as they are high; thinner ones may still block a segment from their own surface here and there.
  virtual double lift() const = 0;

  /// Bytes that the acceleration structure holds beside those from the memory resource; 0 where there are none.
  virtual std::uint64_t bytes() const = 0;
};

/// World-space triangles that block, finite; what is needed of them is copied by the constructors of the answers.
struct Occluders {
  std::span<const Vec3> positions;
  std::span<const std::uint32_t> corners;  ///< 3 a triangle, indices into positions
};

}  // namespace radvor
