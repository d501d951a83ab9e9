#include "visibility/embree_visibility.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <type_traits>

#include "base/error.h"

namespace radvor {
namespace {

// Segments and rays are open at their origin, segments at their end too.
constexpr float k_first_t = std::numeric_limits<float>::min();
constexpr float k_last_t = 0x1.fffffep-1f;

// Embree reads whole vectors of 16 bytes, past the last element of a buffer.
constexpr std::size_t k_padding = 16 / sizeof(float);

// To float and back: a direction taken from the origin as Embree gets it ends where it should.
Vec3 rounded(const Vec3& position) {
  return Vec3(glm::vec3(position));
}

struct OriginDirection {
  Vec3 origin, direction;
};

template <int N>
void set_ray(embree::Rays<N>& rays, int lane, const Vec3& origin, const Vec3& direction, float last_t) {
  rays.origin_x[lane] = static_cast<float>(origin.x);
  rays.origin_y[lane] = static_cast<float>(origin.y);
  rays.origin_z[lane] = static_cast<float>(origin.z);
  rays.t_near[lane] = k_first_t;
  rays.direction_x[lane] = static_cast<float>(direction.x);
  rays.direction_y[lane] = static_cast<float>(direction.y);
  rays.direction_z[lane] = static_cast<float>(direction.z);
  rays.time[lane] = 0;
  rays.t_far[lane] = last_t;
  rays.mask[lane] = 0xffffffffu;
  rays.id[lane] = 0;
  rays.flags[lane] = 0;
}

}  // namespace

bool EmbreeVisibility::Reports::on_memory(void* reports, std::ptrdiff_t bytes, bool) {
  static_cast<Reports*>(reports)->bytes.fetch_add(bytes, std::memory_order_relaxed);
  return true;  // go on
}

void EmbreeVisibility::Reports::on_error(void* reports, int code, const char* text) {
  auto& self = *static_cast<Reports*>(reports);
  if (!self.failed.exchange(true)) {  // check() runs after Embree's call returned, and its threads with it
    self.code = code;
    std::snprintf(self.text, sizeof self.text, "%s", text ? text : "");
  }
}

void EmbreeVisibility::Reports::check() const {
  if (failed) {
    const bool memory = code == embree::k_error_out_of_memory;
    throw Error(memory ? ErrorCode::out_of_memory : ErrorCode::internal, "Embree: error %d, %s", code, text);
  }
}

EmbreeVisibility::EmbreeVisibility(const EmbreeLibrary& library, const Occluders& occluders, Host& host)
    : library_(library),
      frame_(occluders.positions, occluders.corners),
      positions_(&host.memory),
      corners_(&host.memory),
      device_(nullptr, library.release_device),
      scene_(nullptr, library.release_scene) {
  copy_triangles(occluders);
  make_device();
  build(host.jobs);
}

void EmbreeVisibility::copy_triangles(const Occluders& occluders) {
  position_count_ = occluders.positions.size();
  triangle_count_ = occluders.corners.size() / 3;
  positions_.resize(3 * position_count_ + k_padding);
  corners_.reserve(occluders.corners.size() + k_padding);
  corners_.assign(occluders.corners.begin(), occluders.corners.end());
  corners_.resize(occluders.corners.size() + k_padding);
  for (const std::uint32_t corner : occluders.corners) {  // positions that no triangle names may lie anywhere: left 0
    const Vec3 position = frame_.to_frame(occluders.positions[corner]);
    for (int axis = 0; axis < 3; ++axis) {
      positions_[std::size_t{3} * corner + static_cast<std::size_t>(axis)] = static_cast<float>(position[axis]);
    }
  }
}

void EmbreeVisibility::make_device() {
  // No configuration: threads= would lower TBB's limit for the whole host.
  device_.reset(library_.new_device(nullptr));
  if (!device_) {
    throw Error(ErrorCode::unsupported, "Embree makes no device: its error %d", library_.get_device_error(nullptr));
  }
  library_.set_device_error_function(device_.get(), Reports::on_error, &reports_);
  library_.set_device_memory_monitor_function(device_.get(), Reports::on_memory, &reports_);
  // Packets wider than the processor's vectors are taken apart inside, into single rays.
  const auto native = [&](int property) { return library_.get_device_property(device_.get(), property) != 0; };
  lanes_ = native(embree::k_property_native_ray16)  ? 16
           : native(embree::k_property_native_ray8) ? 8
           : native(embree::k_property_native_ray4) ? 4
                                                    : 1;
}

void EmbreeVisibility::build(const Jobs& jobs) {
  scene_.reset(library_.new_scene(device_.get()));
  reports_.check();
  // Robust: no ray slips through between triangles. Medium quality: without spatial splits, the same tree for any
  // number of threads (with the robust flag 3.13 builds that one for high quality too).
  library_.set_scene_flags(scene_.get(), embree::k_scene_robust);
  library_.set_scene_build_quality(scene_.get(), embree::k_quality_medium);
  if (triangle_count_ > 0) {
    const std::unique_ptr<embree::Geometry, embree::ReleaseGeometry> geometry(
        library_.new_geometry(device_.get(), embree::k_geometry_triangles), library_.release_geometry);
    reports_.check();
    library_.set_shared_geometry_buffer(geometry.get(), embree::k_buffer_vertices, 0, embree::k_format_float3,
                                        positions_.data(), 0, 3 * sizeof(float), position_count_);
    library_.set_shared_geometry_buffer(geometry.get(), embree::k_buffer_indices, 0, embree::k_format_uint3,
                                        corners_.data(), 0, 3 * sizeof(std::uint32_t), triangle_count_);
    library_.commit_geometry(geometry.get());
    library_.attach_geometry(scene_.get(), geometry.get());
    reports_.check();
  }
  // An Embree with threads of its own would start them for commit; joined, the calling thread builds alone.
  // One on TBB keeps to the arena it is called in.
  const bool own_threads =
      library_.get_device_property(device_.get(), embree::k_property_tasking_system) == embree::k_tasking_internal;
  jobs.in_arena([&] { (own_threads ? library_.join_commit_scene : library_.commit_scene)(scene_.get()); });
  reports_.check();
}

template <int N, class SegmentAt>
void EmbreeVisibility::trace(std::size_t count, const SegmentAt& segment_at, std::uint8_t* blocked) const {
  embree::Rays<N> rays;
  alignas(4 * N) int valid[N];
  for (int lane = 0; lane < N; ++lane) {
    const std::size_t index = std::min(static_cast<std::size_t>(lane), count - 1);
    const auto [origin, direction] = segment_at(index);
    set_ray(rays, lane, origin, direction, k_last_t);
    valid[lane] = static_cast<std::size_t>(lane) < count ? -1 : 0;
  }
  library_.occluded(valid, scene_.get(), rays);
  for (std::size_t index = 0; index < count; ++index) {
    blocked[index] = rays.t_far[index] < 0;
  }
}

// Packets of all lanes, then the narrowest that holds the rest: a ray alone is 1.5 times as fast by itself.
// on_packet(width, first, count)
template <class OnPacket>
void EmbreeVisibility::for_packets(std::size_t count, OnPacket&& on_packet) const {
  const auto lanes = static_cast<std::size_t>(lanes_);
  for (std::size_t first = 0; first < count;) {
    const std::size_t live = std::min(lanes, count - first);
    if (live > 8) {
      on_packet(std::integral_constant<int, 16>(), first, live);
    } else if (live > 4) {
      on_packet(std::integral_constant<int, 8>(), first, live);
    } else if (live > 1) {
      on_packet(std::integral_constant<int, 4>(), first, live);
    } else {
      on_packet(std::integral_constant<int, 1>(), first, live);
    }
    first += live;
  }
}

template <class SegmentAt>
void EmbreeVisibility::trace_all(std::size_t count, const SegmentAt& segment_at, std::uint8_t* blocked) const {
  for_packets(count, [&](auto width, std::size_t first, std::size_t live) {
    trace<width>(
        live, [&](std::size_t index) { return segment_at(first + index); }, blocked + first);
  });
}

void EmbreeVisibility::blocked_from(const Vec3& from, std::span<const Vec3> to, std::uint8_t* blocked) const {
  const Vec3 origin = rounded(frame_.to_frame(from));
  trace_all(
      to.size(),
      [&](std::size_t i) {
        return OriginDirection{origin, frame_.to_frame(to[i]) - origin};
      },
      blocked);
}

void EmbreeVisibility::blocked(std::span<const Sightline> segments, std::uint8_t* blocked) const {
  trace_all(
      segments.size(),
      [&](std::size_t i) {
        const Vec3 origin = rounded(frame_.to_frame(segments[i].from));
        return OriginDirection{origin, frame_.to_frame(segments[i].to) - origin};
      },
      blocked);
}

template <int N>
void EmbreeVisibility::intersect(const Vec3& origin, std::span<const Vec3> directions, FirstHit* hits) const {
  embree::RayHits<N> rays;
  alignas(4 * N) int valid[N];
  double largest[N];
  for (int lane = 0; lane < N; ++lane) {
    const std::size_t index = std::min(static_cast<std::size_t>(lane), directions.size() - 1);
    const Vec3& direction = directions[index];
    largest[lane] = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    // Before the length, whose squares would overflow or vanish.
    set_ray(rays.ray, lane, origin, direction / largest[lane], std::numeric_limits<float>::infinity());
    rays.geometry[lane] = rays.primitive[lane] = embree::k_no_geometry;
    valid[lane] = static_cast<std::size_t>(lane) < directions.size() ? -1 : 0;
  }
  library_.intersect(valid, scene_.get(), rays);
  for (std::size_t index = 0; index < directions.size(); ++index) {
    if (rays.geometry[index] == embree::k_no_geometry) {
      hits[index] = {};
      continue;
    }
    const auto corner = [&](std::size_t k) {
      const float* position = &positions_[std::size_t{3} * corners_[std::size_t{3} * rays.primitive[index] + k]];
      return Vec3(position[0], position[1], position[2]);
    };
    const Vec3 a = corner(0);
    const Vec3 normal = glm::cross(corner(1) - a, corner(2) - a);
    hits[index] = {rays.primitive[index], glm::dot(normal, directions[index] / largest[index]) < 0,
                   rays.ray.t_far[index] / (frame_.scale() * largest[index])};
  }
}

FirstHit EmbreeVisibility::first_hit(const Vec3& from, const Vec3& direction) const {
  FirstHit hit;
  intersect<1>(rounded(frame_.to_frame(from)), std::span(&direction, 1), &hit);
  return hit;
}

void EmbreeVisibility::first_hits(const Vec3& from, std::span<const Vec3> directions, FirstHit* hits) const {
  const Vec3 origin = rounded(frame_.to_frame(from));
  for_packets(directions.size(), [&](auto width, std::size_t first, std::size_t count) {
    intersect<width>(origin, directions.subspan(first, count), hits + first);
  });
}

// In units of the rounding, the highest points that their own triangle still blocked, over random shapes, places and
// directions: 18 for triangles of aspect up to 100, 100 for needles of 1000. 64 left none on the triangles of eight
// real scenes but one thinner than the rounding itself.
double EmbreeVisibility::lift() const {
  return 64 * frame_.rounding();
}

std::uint64_t EmbreeVisibility::bytes() const {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, reports_.bytes.load(std::memory_order_relaxed)));
}

}  // namespace radvor
