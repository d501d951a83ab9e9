#include "radiosity/fate.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "radiosity/strata.h"

namespace radvor {

namespace {

constexpr double k_pi = 3.14159265358979323846;
constexpr std::uint32_t k_least_of_kind = 256, k_most_of_kind = 1u << 14;  // rays of one kind of source

double sum(const Color& color) {
  return color.r + color.g + color.b;
}

// Four numbers in [0, 1)^4, spread evenly over the indices of one stream: the R4 sequence (Roberts 2018), the powers of
// the inverse of the root of x^5 = x + 1, started where a hash says.
struct Point4 {
  double a, b, c, d;

  Point4(std::uint64_t stream, std::uint32_t index) {
    constexpr double k_root = 1.1673039782614187;
    const auto coordinate = [&](int power) {
      const double start = to_unit(hash(stream, static_cast<std::uint64_t>(power)));
      const double value = start + index * std::pow(k_root, -power);
      return value - std::floor(value);
    };
    a = coordinate(1);
    b = coordinate(2);
    c = coordinate(3);
    d = coordinate(4);
  }
};

Vec2 on_disk(double a, double b) {
  return square_to_disk(2 * a - 1, 2 * b - 1);
}

Vec3 on_sphere(double a, double b) {
  const double z = 1 - 2 * a;
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(2 * k_pi * b), r * std::sin(2 * k_pi * b), z};
}

Vec3 in_triangle(const std::array<Vec3, 3>& t, double a, double b) {
  const double root = std::sqrt(a);
  return t[0] * (1 - root) + t[1] * (root * (1 - b)) + t[2] * (root * b);
}

}  // namespace

FateMeter::FateMeter(const Scene& scene, const WeldedScene& welded, const Visibility& visibility,
                     std::span<const std::uint32_t> occluders, double tolerance, std::uint64_t seed)
    : scene_(scene), welded_(welded), visibility_(visibility), occluders_(occluders), seed_(seed) {
  // A share that n rays tell has a standard error of 1 / (2 sqrt(n)) at most.
  const double root = 5 / (2 * tolerance);
  rays_per_kind_ = static_cast<std::uint32_t>(
      std::clamp(root * root, static_cast<double>(k_least_of_kind), static_cast<double>(k_most_of_kind)));
}

FateMeter::End FateMeter::follow(const Vec3& from, const Vec3& direction) const {
  const FirstHit hit = visibility_.first_hit(from, direction);
  if (hit.triangle == FirstHit::k_miss) {
    return End::escape;
  }
  const Triangle& triangle = welded_.triangles[occluders_[hit.triangle]];
  const bool takes = scene_.meshes[triangle.mesh].receives;
  return takes && (hit.front || scene_.materials[triangle.material].two_sided) ? End::receiver : End::back;
}

FateMeter::Powers FateMeter::of_sources(const DirectLight& light, Host& host) const {
  struct Source {
    double power;
    std::uint32_t rays;
  };
  // In order: punctual lights, the sky, emitters. Each kind shares its rays out by power.
  const auto punctual = light.punctual_lights();
  const auto emitters = light.emitters();
  const Vec3 middle = 0.5 * (welded_.low + welded_.high);
  const double radius = std::max(0.5 * glm::length(welded_.high - welded_.low), 1e-9) * (1 + 1e-6);
  std::pmr::vector<Source> sources(&host.memory);
  double shone = 0;
  for (const Light& lamp : punctual) {
    double power = 0;
    if (lamp.type == LightType::directional) {
      power = k_pi * radius * radius * sum(lamp.color);
    } else if (lamp.type == LightType::point) {
      power = 4 * k_pi * sum(lamp.color);
    } else {
      // Integral of the squared ramp over the cone: closed form in c = cos(angle), with the 0.001 of the falloff.
      const double inner = std::cos(lamp.inner_angle), outer = std::cos(lamp.outer_angle);
      const double width = std::max(0.001, inner - outer);
      const double full = std::min(1.0, outer + width);
      power = 2 * k_pi * sum(lamp.color) * ((1 - full) + std::pow(full - outer, 3) / (3 * width * width));
    }
    sources.push_back({power, 0});
    shone += power;
  }
  const auto rays_of = [&](double power, double all, std::uint32_t least) {
    const double share = power / all;
    return share > 0 ? std::max(least, static_cast<std::uint32_t>(rays_per_kind_ * std::min(share, 1.0))) : least;
  };
  for (Source& source : sources) {
    source.rays = rays_of(source.power, shone, k_least_of_kind);
  }
  const auto sky_index = static_cast<std::uint32_t>(sources.size());
  sources.push_back({4 * k_pi * k_pi * radius * radius * sum(light.sky_radiance()), rays_per_kind_});
  double emitted = 0;
  for (const Emitter& emitter : emitters) {
    emitted += emitter.area * sum(emitter.radiosity);
  }
  for (const Emitter& emitter : emitters) {
    const double power = emitter.area * sum(emitter.radiosity);
    sources.push_back({power, rays_of(power, emitted, 1)});
  }

  const auto ray = [&](std::uint32_t source, std::uint32_t index) {
    const Point4 p(hash(seed_, source), index);
    if (source > sky_index) {
      const Emitter& emitter = emitters[source - sky_index - 1];
      const Vec3 from = in_triangle(emitter.corners, p.a, p.b) + emitter.normal * visibility_.lift();
      return follow(from, Basis(emitter.normal).on_hemisphere(on_disk(p.c, p.d)));
    }
    if (source == sky_index) {
      const Vec3 outwards = on_sphere(p.a, p.b);
      return follow(middle + radius * outwards, Basis(-outwards).on_hemisphere(on_disk(p.c, p.d)));
    }
    const Light& lamp = punctual[source];
    if (lamp.type == LightType::directional) {
      const Basis basis(lamp.direction);
      const Vec2 disk = radius * on_disk(p.a, p.b);
      return follow(middle - radius * lamp.direction + disk.x * basis.x + disk.y * basis.y, lamp.direction);
    }
    if (lamp.type == LightType::point) {
      return follow(lamp.position, on_sphere(p.a, p.b));
    }
    // By the inverse of the ramp's integral: full inside, cubic between the two angles.
    const double inner = std::cos(lamp.inner_angle), outer = std::cos(lamp.outer_angle);
    const double width = std::max(0.001, inner - outer);
    const double full = std::min(1.0, outer + width);
    const double middle_part = std::pow(full - outer, 3) / (3 * width * width);
    const double target = p.a * ((1 - full) + middle_part);
    const double z =
        target < middle_part ? outer + std::cbrt(3 * width * width * target) : full + (target - middle_part);
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    const Basis basis(lamp.direction);
    return follow(lamp.position,
                  z * lamp.direction + r * (std::cos(2 * k_pi * p.b) * basis.x + std::sin(2 * k_pi * p.b) * basis.y));
  };

  std::pmr::vector<Powers> results(sources.size(), &host.memory);
  host.jobs.for_each(static_cast<std::uint32_t>(sources.size()), [&](std::uint32_t source) {
    if (sources[source].power <= 0) {
      return;
    }
    std::uint32_t escaped = 0, backs = 0;
    for (std::uint32_t index = 0; index < sources[source].rays; ++index) {
      const End end = ray(source, index);
      escaped += end == End::escape;
      backs += end == End::back;
    }
    const double per_ray = sources[source].power / sources[source].rays;
    results[source] = {sources[source].power, per_ray * escaped, per_ray * backs, sources[source].rays};
  });
  Powers all;
  for (const Powers& result : results) {
    all.emitted += result.emitted;
    all.escaped += result.escaped;
    all.backs += result.backs;
    all.rays += result.rays;
  }
  return all;
}

}  // namespace radvor
