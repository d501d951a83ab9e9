// Run time against error of whole bakes, and of a path tracer beside them. bake_bench.py drives it: ./dev bench bake
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include "bake/modes.h"

namespace {

constexpr const char* k_usage =
    "bake_bench radvor RADVOR-BAKE-ARGUMENT...\n"
    "bake_bench slices SECONDS RADVOR-BAKE-ARGUMENT...\n"
    "bake_bench replay RADVOR-BAKE-ARGUMENT...\n"
    "bake_bench mesh RADVOR-BAKE-ARGUMENT... --stats OUT.obj\n"
    "bake_bench trace SCENE --points IN.csv --prefix OUT [--lights FILE] [--samples N] [--max-seconds S] [--seed N] "
    "[--direct | --max-bounces N]\n"
    "bake_bench points SCENE --count N --out OUT.csv\n"
    "bake_bench describe SCENE\n"
    "SCENE may also be split:N:SCENE, city:TRIANGLES or hall:LAMPS:CELLS\n";

int trace(int argc, char** argv) {
  bench::TraceOptions options;
  CLI::App app("path tracer", "bake_bench trace");
  app.add_option("scene", options.scene)->required();
  app.add_option("--lights", options.lights);
  app.add_option("--points", options.points)->required();
  app.add_option("--prefix", options.prefix)->required();
  app.add_option("--samples", options.most_samples);
  app.add_option("--max-seconds", options.most_seconds);
  app.add_option("--seed", options.seed);
  app.add_flag("--direct", options.direct);
  app.add_option("--max-bounces", options.most_bounces);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  return bench::trace_mode(options);
}

int points(int argc, char** argv) {
  std::string scene, out;
  std::uint32_t count = 0;
  CLI::App app("points", "bake_bench points");
  app.add_option("scene", scene)->required();
  app.add_option("--count", count)->required()->check(CLI::PositiveNumber);
  app.add_option("--out", out)->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  return bench::points_mode(scene, count, out);
}

int run(int argc, char** argv) {
  const std::string_view mode = argc > 1 ? argv[1] : "";
  if (mode == "trace") {
    return trace(argc - 1, argv + 1);
  }
  if (mode == "radvor") {
    return bench::radvor_mode(argc - 1, argv + 1);
  }
  if (mode == "mesh") {
    return bench::mesh_mode(argc - 1, argv + 1);
  }
  if (mode == "replay") {
    return bench::replay_mode(argc - 1, argv + 1);
  }
  if (mode == "slices" && argc > 2) {
    return bench::slices_mode(std::stod(argv[2]), argc - 2, argv + 2);
  }
  if (mode == "points") {
    return points(argc - 1, argv + 1);
  }
  if (mode == "describe" && argc > 2) {
    return bench::describe_mode(argv[2]);
  }
  std::fputs(k_usage, stderr);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bake_bench: %s\n", error.what());
    return 1;
  }
}
