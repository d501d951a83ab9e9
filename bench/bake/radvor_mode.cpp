// A bake through the public API: all-in processor time, from arrays to a solution, and the statistics.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "baked_scene.h"
#include "failure.h"
#include "modes.h"
#include "processor_time.h"
#include "scene_source.h"
#include "stats_file.h"

namespace bench {
namespace {

constexpr double k_point_distance = 1e-3;  // of the diagonal, as radvor-bake has it

void log_errors(void*, std::int32_t level, const char* words) {
  if (level == RADVOR_LOG_ERROR) {
    std::fprintf(stderr, "%s\n", words);
  }
}

/// The most so far, the scene as it was read included.
std::uint64_t resident_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// Cancels a bake at a limit of processor time: on a busy machine a limit of the clock would cut short what is not
/// slow.
struct ProcessorLimit {
  double until;
  static std::int32_t check(void* limit, const radvor_progress*) {
    return processor_seconds() > static_cast<const ProcessorLimit*>(limit)->until ? 1 : 0;
  }
};

void measure(const bake::Options& options, const bake::SceneData& scene, const bake::BakedScene& baked,
             const bake::Points& points, const std::string& file) {
  const bake::Bounds box = bake::bounds_of(scene);
  std::vector<float> rgb;
  std::vector<std::uint8_t> found;
  baked.measure(points, options.quantity, k_point_distance * glm::length(box.high - box.low), rgb, found);
  bake::save_values(file, rgb, found);
}

/// Direct light at the vertices as it is in the end. Another process bakes it, since a bake after another in the same
/// one finds its memory warm and takes up to a seventh less time.
std::vector<float> final_vertices(const bake::SceneData& scene, bake::Options options) {
  options.bake.disable |= RADVOR_DISABLE_INDIRECT;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), std::fclose);
  const pid_t child = file != nullptr ? fork() : -1;
  if (child == 0) {
    bake::BakedScene baked(scene, options, log_errors, nullptr);
    baked.run(nullptr, nullptr);
    const std::vector<float> values = baked.vertices(RADVOR_IRRADIANCE_DIRECT);
    const bool written = std::fwrite(values.data(), sizeof(float), values.size(), file.get()) == values.size() &&
                         std::fflush(file.get()) == 0;
    _exit(written ? 0 : 1);
  }
  int status = 1;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0) {
    throw bake::Failure(bake::ExitCode::bake, "no process to bake the final light in");
  }
  std::fseek(file.get(), 0, SEEK_END);
  std::vector<float> values(static_cast<std::size_t>(std::ftell(file.get())) / sizeof(float));
  std::rewind(file.get());
  values.resize(std::fread(values.data(), sizeof(float), values.size(), file.get()));
  return values;
}

/// Over the mean of what is expected; `kept`: the share of the values that are least off.
double relative_rms(const std::vector<float>& values, const std::vector<float>& expected, double kept) {
  std::vector<double> squares;
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double off = static_cast<double>(values[i]) - static_cast<double>(expected[i]);
    squares.push_back(off * off);
    sum += static_cast<double>(expected[i]);
  }
  std::sort(squares.begin(), squares.end());
  const double mean = sum / static_cast<double>(values.size());
  squares.resize(static_cast<std::size_t>(kept * static_cast<double>(squares.size())));
  const double all = std::accumulate(squares.begin(), squares.end(), 0.0);
  return mean > 0 && !squares.empty() ? std::sqrt(all / static_cast<double>(squares.size())) / mean : 0;
}

nlohmann::json statistics(const bake::BakedScene& baked, radvor_result result, const bake::Options& options,
                          const bake::SceneData& scene) {
  bake::Run run;
  run.result = result;
  run.stats = baked.stats();
  return nlohmann::json::parse(bake::stats_json(run, options, scene));
}

}  // namespace

int radvor_mode(int argc, const char* const* argv) {
  std::optional<bake::Options> options = bake::parse_options(argc, argv);
  if (!options) {
    return 0;
  }
  const bake::SceneData scene = load_scene(options->scene);
  const bake::Points points = options->points.empty() ? bake::Points{} : bake::load_points(options->points);
  ProcessorLimit limit{options->bake.max_seconds > 0 ? processor_seconds() + options->bake.max_seconds : 1e300};
  options->bake.max_seconds = 0;
  const auto begin = std::chrono::steady_clock::now();
  const double cpu_begin = processor_seconds();
  bake::BakedScene baked(scene, *options, log_errors, nullptr);
  const radvor_result result = baked.run(ProcessorLimit::check, &limit);
  const double cpu = processor_seconds() - cpu_begin;
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  nlohmann::json json = statistics(baked, result, *options, scene);
  json["seconds"] = wall;
  json["cpu_seconds"] = cpu;
  json["resident_bytes"] = resident_bytes();
  if (points.count() > 0) {
    const double points_begin = processor_seconds();
    measure(*options, scene, baked, points, options->points_out);
    json["points_cpu_seconds"] = processor_seconds() - points_begin;
  }
  std::printf("%s\n", json.dump().c_str());
  return 0;
}

int slices_mode(double slice, int argc, const char* const* argv) {
  const std::optional<bake::Options> options = bake::parse_options(argc, argv);
  if (!options) {
    return 0;
  }
  const bake::SceneData scene = load_scene(options->scene);
  const bake::Points points = options->points.empty() ? bake::Points{} : bake::load_points(options->points);
  const double given = options->bake.max_seconds > 0 ? options->bake.max_seconds : 60;
  bake::Options unlimited = *options;
  unlimited.bake.max_seconds = 0;
  const std::vector<float> vertices = final_vertices(scene, unlimited);
  bake::BakedScene baked(scene, unlimited, log_errors, nullptr);
  double total = 0;
  int number = 0;
  radvor_result result = RADVOR_TIME_SPENT;
  while (result == RADVOR_TIME_SPENT && total < given) {
    const auto begin = std::chrono::steady_clock::now();
    const double cpu_begin = processor_seconds();
    result = number == 0 ? baked.create() : baked.advance(slice);
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double cpu = processor_seconds() - cpu_begin;
    if (number == 0) {
      result = RADVOR_TIME_SPENT;  // created: dark, all of the work is still to come
    }
    total += wall;
    nlohmann::json json{{"slice", number}, {"seconds", wall}, {"cpu_seconds", cpu}, {"total_seconds", total}};
    const std::vector<float> now = baked.vertices(RADVOR_IRRADIANCE_DIRECT);
    json["vertex_rms"] = relative_rms(now, vertices, 1);
    json["vertex_rms99"] = relative_rms(now, vertices, 0.99);
    if (points.count() > 0) {
      const std::string file = options->points_out + "-" + std::to_string(number) + ".csv";
      measure(*options, scene, baked, points, file);
      json["points"] = file;
    }
    std::printf("%s\n", json.dump().c_str());
    std::fflush(stdout);
    ++number;
  }
  return 0;
}

}  // namespace bench
