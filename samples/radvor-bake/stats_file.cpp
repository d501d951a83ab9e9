#include "stats_file.h"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

namespace bake {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json or_null(Value value) {
  return value != Value(0) ? Json(value) : Json(nullptr);
}

const char* name_of(const std::vector<Named>& names, std::uint32_t value) {
  for (const Named& named : names) {
    if (named.value == value) {
      return named.name;
    }
  }
  return "?";
}

const char* words(radvor_result result) {
  return result == RADVOR_OK ? "converged" : result == RADVOR_TIME_SPENT ? "time spent" : "cancelled";
}

Json lights_json(const std::vector<radvor_light_desc>& lights) {
  Json all = Json::array();
  for (const radvor_light_desc& light : lights) {
    Json one;
    if (light.type == RADVOR_LIGHT_SKY) {
      one["type"] = "sky";
    } else if (light.type == RADVOR_LIGHT_DIRECTIONAL) {
      one["type"] = "sun";
      one["direction"] = {light.direction[0], light.direction[1], light.direction[2]};
      one["angle"] = light.angle;
    } else {
      one["type"] = "point";
      one["position"] = {light.position[0], light.position[1], light.position[2]};
      one["radius"] = light.radius;
    }
    one["color"] = {light.color[0], light.color[1], light.color[2]};
    all.push_back(std::move(one));
  }
  return all;
}

Json options_json(const Options& options) {
  const radvor_bake_options& bake = options.bake;
  Json json;
  json["scene"] = options.scene;
  json["tolerance"] = bake.tolerance > 0 ? bake.tolerance : 0.02f;
  json["lattice"] = name_of(k_lattice_names, bake.lattice);
  json["patch_spacing"] = or_null(bake.patch_spacing);
  json["min_spacing"] = or_null(bake.min_spacing);
  json["crease_angle"] = bake.crease_angle > 0 ? bake.crease_angle : std::numbers::pi_v<float> / 6;
  json["weld_distance"] = bake.weld_distance;
  json["element_levels"] = or_null(bake.element_levels);
  json["max_sites"] = or_null(bake.max_sites);
  json["max_bounces"] = or_null(bake.max_bounces);
  json["max_seconds"] = or_null(bake.max_seconds);
  json["seed"] = bake.seed;
  json["threads"] = or_null(options.threads);
  json["embree"] = options.embree.empty() ? Json(nullptr) : Json(options.embree);
  json["disable"] = Json::array();
  for (const Named& named : k_disable_names) {
    if ((bake.disable & named.value) != 0) {
      json["disable"].push_back(named.name);
    }
  }
  json["lights"] = lights_json(options.lights);
  return json;
}

template <class... Values>
std::string printed(const char* format, Values... values) {
  std::array<char, 512> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  return line.data();
}

}  // namespace

std::string stats_json(const Run& run, const Options& options, const SceneData& scene) {
  const radvor_stats& stats = run.stats;
  Json json;
#define RADVOR_FIELD(name) json[#name] = stats.name
  RADVOR_FIELD(facets);
  RADVOR_FIELD(patches);
  RADVOR_FIELD(elements);
  RADVOR_FIELD(sites);
  RADVOR_FIELD(triangles);
  RADVOR_FIELD(constraints);
  RADVOR_FIELD(repaired_triangles);
  RADVOR_FIELD(repaired_t_junctions);
  RADVOR_FIELD(intersections);
  RADVOR_FIELD(ties);
  RADVOR_FIELD(realigned_ties);
  RADVOR_FIELD(shots);
  RADVOR_FIELD(rays);
  RADVOR_FIELD(form_factors);
  RADVOR_FIELD(skipped_facing);
  RADVOR_FIELD(skipped_negligible);
  RADVOR_FIELD(skipped_lazy);
  RADVOR_FIELD(skipped_clear);
  RADVOR_FIELD(seconds_setup);
  RADVOR_FIELD(seconds_direct);
  RADVOR_FIELD(seconds_indirect);
  RADVOR_FIELD(seconds_rays);
  RADVOR_FIELD(emitted_power);
  RADVOR_FIELD(absorbed_power);
  RADVOR_FIELD(absorbed_back_power);
  RADVOR_FIELD(unshot_power);
  RADVOR_FIELD(escaped_power);
  RADVOR_FIELD(peak_bytes);
#undef RADVOR_FIELD
  json["seconds"] = run.seconds;
  json["result"] = words(run.result);
  json["version"] = radvor_version();
  json["input_meshes"] = scene.meshes.size();
  json["input_triangles"] = scene.triangle_count();
  json["options"] = options_json(options);
  // Names in the OBJ may be in any encoding; a file that is not UTF-8 would be no JSON.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summary(const Run& run, const SceneData& scene) {
  const radvor_stats& stats = run.stats;
  const auto share = [&](double power) { return stats.emitted_power > 0 ? 100 * power / stats.emitted_power : 0.0; };
  std::string lines =
      printed("%s in %.2f s: %zu triangles in, %u facets, %u sites, %u triangles out\n", words(run.result), run.seconds,
              scene.triangle_count(), stats.facets, stats.sites, stats.triangles);
  lines += printed("%.3g shots, %.3g rays, %.3g form factors; %.1f MB at most\n", static_cast<double>(stats.shots),
                   static_cast<double>(stats.rays), static_cast<double>(stats.form_factors),
                   static_cast<double>(stats.peak_bytes) / 1e6);
  lines += printed("of %.4g W emitted %.2f %% absorbed, %.2f %% on backs, %.2f %% escaped, %.2f %% unshot\n",
                   stats.emitted_power, share(stats.absorbed_power), share(stats.absorbed_back_power),
                   share(stats.escaped_power), share(stats.unshot_power));
  if (stats.repaired_triangles > 0 || stats.repaired_t_junctions > 0) {
    lines += printed("repaired: %u triangles, %u T-junctions\n", stats.repaired_triangles, stats.repaired_t_junctions);
  }
  return lines;
}

}  // namespace bake
