// Visibility by trying every triangle, in double precision: the oracle that others are held against, and the answer
// where every instruction is to be watched by a sanitizer.
#pragma once

#include <memory_resource>
#include <vector>

#include "visibility/visibility.h"

namespace radvor {

class BruteForceVisibility final : public Visibility {
 public:
  BruteForceVisibility(const Occluders& occluders, std::pmr::memory_resource* memory);

  void blocked_from(const Vec3& from, std::span<const Vec3> to, std::uint8_t* blocked) const override;
  void blocked(std::span<const Sightline> segments, std::uint8_t* blocked) const override;
  FirstHit first_hit(const Vec3& from, const Vec3& direction) const override;
  void first_hits(const Vec3& from, std::span<const Vec3> directions, FirstHit* hits) const override;
  double lift() const override;
  std::uint64_t bytes() const override { return 0; }

 private:
  struct Triangle {
    Vec3 a, b, c;
    Vec3 normal;  // not of unit length
  };

  bool is_blocked(const Vec3& from, const Vec3& to) const;

  std::pmr::vector<Triangle> triangles_;
  double lift_ = 0;
};

}  // namespace radvor
