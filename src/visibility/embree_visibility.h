// Visibility answered by Embree: packets of as many rays as the processor traces at once.
#pragma once

#include <atomic>
#include <memory>
#include <memory_resource>
#include <vector>

#include "base/host.h"
#include "visibility/embree_library.h"
#include "visibility/float_frame.h"
#include "visibility/visibility.h"

namespace radvor {

class EmbreeVisibility final : public Visibility {
 public:
  /// Builds the acceleration structure in the host's arena. Triangles without area block nothing. The library must
  /// outlive this. Throws Error(out_of_memory), Error(unsupported), Error(internal) or std::bad_alloc.
  EmbreeVisibility(const EmbreeLibrary& library, const Occluders& occluders, Host& host);

  void blocked_from(const Vec3& from, std::span<const Vec3> to, std::uint8_t* blocked) const override;
  void blocked(std::span<const Sightline> segments, std::uint8_t* blocked) const override;
  FirstHit first_hit(const Vec3& from, const Vec3& direction) const override;
  void first_hits(const Vec3& from, std::span<const Vec3> directions, FirstHit* hits) const override;
  double lift() const override;
  std::uint64_t bytes() const override;

 private:
  // What Embree says from its own threads: the first error, and the bytes it holds.
  struct Reports {
    std::atomic<std::int64_t> bytes{0};
    std::atomic<bool> failed{false};
    int code = 0;
    char text[256] = "";

    static bool on_memory(void* reports, std::ptrdiff_t bytes, bool post);
    static void on_error(void* reports, int code, const char* text);
    void check() const;
  };

  template <int N, class SegmentAt>
  void trace(std::size_t count, const SegmentAt& segment_at, std::uint8_t* blocked) const;
  template <class SegmentAt>
  void trace_all(std::size_t count, const SegmentAt& segment_at, std::uint8_t* blocked) const;

  template <class OnPacket>
  void for_packets(std::size_t count, OnPacket&& on_packet) const;
  template <int N>
  void intersect(const Vec3& origin, std::span<const Vec3> directions, FirstHit* hits) const;

  void make_device();
  void copy_triangles(const Occluders& occluders);
  void build(const Jobs& jobs);

  const EmbreeLibrary& library_;
  FloatFrame frame_;
  std::pmr::vector<float> positions_;        // 3 a corner position, and padding that Embree may read
  std::pmr::vector<std::uint32_t> corners_;  // 3 a triangle, and padding
  std::size_t position_count_ = 0;
  std::size_t triangle_count_ = 0;
  int lanes_ = 1;
  Reports reports_;
  std::unique_ptr<embree::Device, embree::ReleaseDevice> device_;  // before the scene: released after it
  std::unique_ptr<embree::Scene, embree::ReleaseScene> scene_;
};

}  // namespace radvor
