#include "radiosity/silhouettes.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace radvor {

namespace {

constexpr std::uint64_t k_most_pairs = 4'000'000;  // of more, as many spread evenly
constexpr double k_least_cosine = 0.02;            // of a shadow's length on a surface that light grazes

}  // namespace

std::uint64_t Silhouettes::stride() const {
  return std::max<std::uint64_t>(1, (pairs() + k_most_pairs - 1) / k_most_pairs);
}

std::uint32_t Silhouettes::block_count() const {
  const std::uint64_t chosen = (pairs() + stride() - 1) / stride();
  return static_cast<std::uint32_t>((chosen + k_block - 1) / k_block);
}

void Silhouettes::cast(std::uint32_t block, Tracer& tracer, std::span<std::optional<CastShadow>> shadows) const {
  for (std::uint32_t k = 0; k < k_block; ++k) {
    const std::uint64_t pair = (std::uint64_t{block} * k_block + k) * stride();
    if (pair < pairs()) {
      shadows[k] = cast(static_cast<std::uint32_t>(pair / occluders_.size()),
                        static_cast<std::uint32_t>(pair % occluders_.size()), tracer);
    }
  }
}

void Silhouettes::keep(std::span<const std::optional<CastShadow>> shadows) {
  for (const std::optional<CastShadow>& shadow : shadows) {
    if (shadow) {
      casts_.push_back(*shadow);
    }
  }
}

// From the middle of the triangle on, away from the source.
std::optional<CastShadow> Silhouettes::cast(std::uint32_t source, std::uint32_t occluder, Tracer& tracer) const {
  const WeldedScene& welded = surface_.welded();
  const auto& corners = welded.triangles[occluders_[occluder]].vertices;
  const Vec3 &a = welded.positions[corners[0]], &b = welded.positions[corners[1]], &c = welded.positions[corners[2]];
  const Vec3 middle = (a + b + c) / 3.0;
  const std::optional<DirectLight::Beam> beam = light_.beam(source, middle);
  const double facing = beam ? 0.5 * std::abs(glm::dot(glm::cross(b - a, c - a), beam->way)) : 0;
  if (facing <= 0) {
    return {};
  }
  const Vec3 from = middle + tracer.lift() * beam->way;
  const FirstHit hit = tracer.first_hit(from, beam->way);
  if (hit.triangle == FirstHit::k_miss) {
    return {};
  }
  const Scene& scene = surface_.scene();
  const std::uint32_t facet = surface_.facets().facet_of_triangle[occluders_[hit.triangle]];
  const Facet& described = surface_.facets().facets[facet];
  if (!scene.meshes[described.mesh].receives || (!hit.front && !scene.materials[described.material].two_sided)) {
    return {};
  }
  const double spread = std::isinf(beam->distance) ? 1 : (beam->distance + hit.distance) / beam->distance;
  const double cosine = std::abs(glm::dot(described.frame.normal, beam->way));
  const Vec3 point = from + hit.distance * beam->way;
  const Vec3 up = hit.front ? described.frame.normal : -described.frame.normal;
  return CastShadow{source,
                    facet,
                    !hit.front,
                    described.frame.to_plane(point),
                    facing * spread * spread / std::max(cosine, k_least_cosine),
                    {point, point + tracer.lift() * up, up}};
}

std::pmr::vector<CastShadow> Silhouettes::largest_of_each() {
  struct Keyed {
    std::array<std::uint32_t, 5> key;  // source, side, triangle
    std::uint32_t cast;
  };
  std::pmr::vector<Keyed> keyed(casts_.size(), &host_.memory);
  constexpr std::uint32_t k_task = 1024;
  const auto count = static_cast<std::uint32_t>(casts_.size());
  host_.jobs.for_each((count + k_task - 1) / k_task, [&](std::uint32_t task) {
    for (std::uint32_t k = task * k_task; k < std::min(count, (task + 1) * k_task); ++k) {
      const ShareTriangle triangle = surface_.locate(casts_[k].facet, casts_[k].at).shares;
      keyed[k] = {{casts_[k].source, casts_[k].back ? 1u : 0u, triangle[0], triangle[1], triangle[2]}, k};
    }
  });
  std::sort(keyed.begin(), keyed.end(), [&](const Keyed& x, const Keyed& y) {
    return std::tie(x.key, casts_[y.cast].area, x.cast) < std::tie(y.key, casts_[x.cast].area, y.cast);
  });
  std::pmr::vector<CastShadow> largest(&host_.memory);
  for (std::size_t k = 0; k < keyed.size(); ++k) {
    const CastShadow& cast = casts_[keyed[k].cast];
    if (k == 0 || keyed[k].key != keyed[k - 1].key) {
      largest.push_back(cast);
    } else {
      largest.back().area += cast.area;
    }
  }
  casts_ = std::pmr::vector<CastShadow>(&host_.memory);
  return largest;
}

}  // namespace radvor
