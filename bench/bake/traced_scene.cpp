#include "traced_scene.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

namespace bench {
namespace {

constexpr float k_most_albedo = 0.99f;  // as radvor clamps it

/// Fills a lane of RTCRay16 or of the ray in RTCRayHit16.
void set_lane(RTCRay16& packet, std::size_t lane, const Ray& ray, float far) {
  packet.org_x[lane] = ray.origin.x;
  packet.org_y[lane] = ray.origin.y;
  packet.org_z[lane] = ray.origin.z;
  packet.dir_x[lane] = ray.direction.x;
  packet.dir_y[lane] = ray.direction.y;
  packet.dir_z[lane] = ray.direction.z;
  packet.tnear[lane] = 0;
  packet.tfar[lane] = far;
  packet.time[lane] = 0;
  packet.mask[lane] = ~0u;
  packet.id[lane] = 0;
  packet.flags[lane] = 0;
}

RTCIntersectContext context_for(bool coherent) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

}  // namespace

TracedScene::TracedScene(const bake::SceneData& scene) : materials_(scene.materials) {
  for (const bake::MeshData& mesh : scene.meshes) {
    add(mesh);
  }
  if (corners_.empty()) {
    throw std::runtime_error("a scene without triangles");
  }
  float largest = 0;
  for (const glm::vec3& position : positions_) {
    largest = std::max({largest, std::abs(position.x), std::abs(position.y), std::abs(position.z)});
  }
  lift_ = 32 * largest * std::numeric_limits<float>::epsilon();
  build();
}

void TracedScene::add(const bake::MeshData& mesh) {
  const auto first = static_cast<std::uint32_t>(positions_.size());
  positions_.insert(positions_.end(), mesh.positions.begin(), mesh.positions.end());
  normals_.insert(normals_.end(), mesh.normals.begin(), mesh.normals.end());
  normals_.resize(positions_.size(), glm::vec3(0));  // 0: the triangle's own
  colors_.insert(colors_.end(), mesh.colors.begin(), mesh.colors.end());
  colors_.resize(positions_.size(), glm::vec3(1));
  for (const std::uint32_t index : mesh.indices) {
    corners_.push_back(first + index);
  }
  triangle_materials_.insert(triangle_materials_.end(), mesh.triangle_materials.begin(), mesh.triangle_materials.end());
}

void TracedScene::build() {
  device_.reset(rtcNewDevice("threads=1"));
  if (!device_) {
    throw std::runtime_error("Embree makes no device");
  }
  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                           positions_.size());
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(std::uint32_t), triangle_count());
  std::copy(positions_.begin(), positions_.end(), static_cast<glm::vec3*>(vertices));
  std::copy(corners_.begin(), corners_.end(), static_cast<std::uint32_t*>(indices));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree cannot build the scene");
  }
}

void TracedScene::intersect(const Ray* rays, std::size_t count, bool coherent, Meeting* meetings) const {
  RTCIntersectContext context = context_for(coherent);
  rays_ += count;
  for (std::size_t first = 0; first < count; first += k_packet) {
    const std::size_t live = std::min(k_packet, count - first);
    alignas(64) int valid[k_packet];
    RTCRayHit16 packet;
    for (std::size_t lane = 0; lane < k_packet; ++lane) {
      valid[lane] = lane < live ? -1 : 0;
      set_lane(packet.ray, lane, rays[first + std::min(lane, live - 1)], std::numeric_limits<float>::infinity());
      packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.primID[lane] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, scene_.get(), &context, &packet);
    for (std::size_t lane = 0; lane < live; ++lane) {
      const bool missed = packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID;
      meetings[first + lane] = {missed ? k_nothing : packet.hit.primID[lane], packet.hit.u[lane], packet.hit.v[lane]};
    }
  }
}

void TracedScene::occluded(const Ray* segments, std::size_t count, bool coherent, bool* blocked) const {
  RTCIntersectContext context = context_for(coherent);
  rays_ += count;
  for (std::size_t first = 0; first < count; first += k_packet) {
    const std::size_t live = std::min(k_packet, count - first);
    alignas(64) int valid[k_packet];
    RTCRay16 packet;
    for (std::size_t lane = 0; lane < k_packet; ++lane) {
      valid[lane] = lane < live ? -1 : 0;
      set_lane(packet, lane, segments[first + std::min(lane, live - 1)], 1.0f);
    }
    rtcOccluded16(valid, scene_.get(), &context, &packet);
    for (std::size_t lane = 0; lane < live; ++lane) {
      blocked[first + lane] = packet.tfar[lane] < 0;
    }
  }
}

bool TracedScene::meets_front(const Ray& ray, std::uint32_t triangle) const {
  const glm::vec3 a = corner(triangle, 0);
  return glm::dot(glm::cross(corner(triangle, 1) - a, corner(triangle, 2) - a), ray.direction) < 0;
}

Hit TracedScene::hit(const Meeting& meeting) const {
  const std::uint32_t* corners = &corners_[3 * std::size_t{meeting.triangle}];
  const glm::vec3 weights(1 - meeting.u - meeting.v, meeting.u, meeting.v);
  const auto blended = [&](const std::vector<glm::vec3>& of) {
    return weights.x * of[corners[0]] + weights.y * of[corners[1]] + weights.z * of[corners[2]];
  };
  Hit hit;
  const glm::vec3 a = positions_[corners[0]];
  hit.geometric_normal = glm::normalize(glm::cross(positions_[corners[1]] - a, positions_[corners[2]] - a));
  hit.position = blended(positions_) + lift_ * hit.geometric_normal;
  const glm::vec3 smooth = blended(normals_);
  const float length = glm::length(smooth);
  hit.normal = length > 0 ? smooth / length : hit.geometric_normal;
  hit.albedo =
      glm::min(blended(colors_) * materials_[triangle_materials_[meeting.triangle]].albedo, glm::vec3(k_most_albedo));
  hit.triangle = meeting.triangle;
  return hit;
}

}  // namespace bench
