#include "options.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <iostream>
#include <limits>
#include <numbers>

#include "failure.h"
#include "light_lines.h"
#include "text_lines.h"

namespace bake {

const std::vector<Named> k_disable_names{
    {"facing", RADVOR_DISABLE_FACING},
    {"negligible", RADVOR_DISABLE_NEGLIGIBLE},
    {"lazy", RADVOR_DISABLE_LAZY},
    {"clear-shafts", RADVOR_DISABLE_CLEAR_SHAFTS},
    {"refinement", RADVOR_DISABLE_REFINEMENT},
    {"tie-alignment", RADVOR_DISABLE_TIE_ALIGNMENT},
    {"shadow-sites", RADVOR_DISABLE_SHADOW_SITES},
    {"shadow-edges", RADVOR_DISABLE_SHADOW_EDGES},
    {"intersections", RADVOR_DISABLE_INTERSECTIONS},
    {"indirect", RADVOR_DISABLE_INDIRECT},
};
const std::vector<Named> k_lattice_names{{"hex", RADVOR_LATTICE_HEXAGONAL}, {"quad", RADVOR_LATTICE_QUADRILATERAL}};
const std::vector<Named> k_quantity_names{
    {"irradiance", RADVOR_IRRADIANCE},
    {"direct", RADVOR_IRRADIANCE_DIRECT},
    {"indirect", RADVOR_IRRADIANCE_INDIRECT},
    {"radiance", RADVOR_RADIANCE},
};

namespace {

constexpr const char* k_about =
    "Bakes diffuse global illumination into the vertices of a Wavefront OBJ scene.\n"
    "Kd is albedo, Ke emitted radiance; a missing material or file means albedo 0.5.";

constexpr const char* k_exit_codes =
    "Exit codes: 0 done (or --max-seconds spent), 2 wrong command line, 3 wrong input file,\n"
    "4 the bake failed, 5 an output file cannot be written, 128 + n stopped by signal n (Ctrl-C: 130)\n"
    "after writing what there was.";

/// Underscores are as good as hyphens: the bits are spelled so in radvor.h.
std::uint32_t named(const std::vector<Named>& names, std::string name, const char* option) {
  std::replace(name.begin(), name.end(), '_', '-');
  std::string known;
  for (const Named& candidate : names) {
    if (name == candidate.name) {
      return candidate.value;
    }
    known += std::string(known.empty() ? "" : ", ") + candidate.name;
  }
  throw Failure(ExitCode::usage, std::string(option) + ": \"" + name + "\" is none of " + known);
}

/// What was given in words, before it is understood.
struct Words {
  std::vector<std::string> disable, lights, light_files;
  std::string lattice = "hex";
  std::string quantity = "irradiance";
  std::string camera;
  bool version = false;
};

void add_output_options(CLI::App& app, Options& options, Words& words) {
  app.add_option("scene", options.scene, "The scene, an OBJ file")->type_name("SCENE.obj");
  app.add_option("-o,--output", options.output, "The adaptive mesh with its light, .glb or .ply")->type_name("FILE");
  app.add_option("--points", options.points, "Points to measure at: CSV with columns x,y,z,nx,ny,nz")
      ->type_name("IN.csv");
  app.add_option("--points-out", options.points_out, "What was measured: CSV r,g,b,found")->type_name("OUT.csv");
  app.add_option("--quantity", words.quantity, "Measured there: irradiance (default), direct, indirect, radiance")
      ->type_name("NAME");
  app.add_option("--stats", options.stats, "Statistics of the bake and the options used")->type_name("OUT.json");
  app.add_option("--preview", options.preview, "A picture")->type_name("OUT.png");
  app.add_flag("--wireframe", options.wireframe, "Draw the adaptive mesh over the picture");
  app.add_option("--camera", words.camera,
                 "Eye, target, vertical field of view in degrees (default: one that sees most of the scene)")
      ->type_name("\"EX EY EZ TX TY TZ FOV\"");
  app.add_flag("--quiet", options.quiet, "No progress, no summary, no warnings: errors alone");
  app.add_flag("--version", words.version, "Print the version of the library");
}

void add_bake_options(CLI::App& app, Options& options, Words& words) {
  radvor_bake_options& bake = options.bake;
  constexpr float k_most = std::numeric_limits<float>::max();
  app.add_option("--tolerance", bake.tolerance, "Aim: RMS error of the irradiance over its mean (default 0.02)")
      ->check(CLI::Range(0.0f, k_most));
  app.add_option("--lattice", words.lattice, "Of the sites: hex (default) or quad")->type_name("hex|quad");
  app.add_option("--patch-spacing", bake.patch_spacing,
                 "Between the first sites, scene units (default: from the scene)")
      ->check(CLI::Range(0.0f, k_most));
  app.add_option("--min-spacing", bake.min_spacing, "Refinement stops here, scene units (default: from the scene)")
      ->check(CLI::Range(0.0f, k_most));
  app.add_option("--element-levels", bake.element_levels,
                 "Lattice levels between patches and the first elements (default: from the scene and the tolerance)");
  app.add_option("--max-sites", bake.max_sites, "(default: no limit)");
  app.add_option("--max-bounces", bake.max_bounces, "(default: until converged)");
  app.add_option("--max-seconds", bake.max_seconds, "(default: no limit)")
      ->check(CLI::Range(0.0, std::numeric_limits<double>::max()));
  app.add_option("--crease-angle", bake.crease_angle, "Radians, where a mesh has no normals (default pi/6)")
      ->check(CLI::Range(0.0f, std::numbers::pi_v<float>));
  app.add_option("--weld-distance", bake.weld_distance, "Scene units (default: vertices equal to the bit are one)")
      ->check(CLI::Range(0.0f, k_most));
  app.add_option("--seed", bake.seed, "Of the random numbers (default 0)");
  app.add_option("--threads", options.threads, "(default: all cores)");
  app.add_option("--embree", options.embree, "The Embree library to load (default: the system's)")->type_name("PATH");
  app.add_option("--disable", words.disable,
                 "Parts of the method to leave out: facing, negligible, lazy, clear-shafts, refinement,\n"
                 "tie-alignment, shadow-sites, shadow-edges, intersections, indirect")
      ->delimiter(',')
      ->type_name("NAME,...");
  app.add_option("--light", words.lights,
                 "A light, repeatable: \"sky R G B\", \"sun DX DY DZ R G B [ANGLE]\" (the way it travels;\n"
                 "angular diameter in radians), \"point X Y Z R G B [RADIUS]\"")
      ->take_all()
      ->expected(1)
      ->type_name("\"KIND ...\"");
  app.add_option("--lights", words.light_files, "A file of such lines")->take_all()->expected(1)->type_name("FILE");
}

std::string extension(const std::string& file) {
  return std::filesystem::path(file).extension().string();
}

void check(const Options& options) {
  const auto refuse = [](const std::string& words) { throw Failure(ExitCode::usage, words); };
  if (options.scene.empty()) {
    refuse("no scene given; radvor-bake --help tells more");
  }
  const std::string kind = extension(options.output);
  if (!options.output.empty() && kind != ".glb" && kind != ".ply") {
    refuse("-o " + options.output + ": the name must end in .glb or .ply");
  }
  if (!options.preview.empty() && extension(options.preview) != ".png") {
    refuse("--preview " + options.preview + ": the name must end in .png");
  }
  if (options.points.empty() != options.points_out.empty()) {
    refuse("--points and --points-out need each other");
  }
  if (options.preview.empty() && (options.wireframe || options.camera)) {
    refuse("--wireframe and --camera need --preview");
  }
}

std::string version_text() {
  const std::uint32_t version = radvor_version();
  return std::to_string(version >> 22) + "." + std::to_string(version >> 12 & 0x3ff) + "." +
         std::to_string(version & 0xfff);
}

}  // namespace

std::optional<Options> parse_options(int argc, const char* const* argv) {
  Options options;
  options.bake.struct_size = sizeof options.bake;
  Words words;
  CLI::App app(k_about, "radvor-bake");
  app.footer(k_exit_codes);
  add_output_options(app, options, words);
  add_bake_options(app, options, words);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw Failure(ExitCode::usage, error.what());
  }
  if (words.version) {
    std::cout << "radvor " << version_text() << "\n";
    return std::nullopt;
  }
  options.bake.lattice = named(k_lattice_names, words.lattice, "--lattice");
  options.quantity = named(k_quantity_names, words.quantity, "--quantity");
  for (const std::string& name : words.disable) {
    options.bake.disable |= named(k_disable_names, name, "--disable");
  }
  for (const std::string& light : words.lights) {
    options.lights.push_back(parse_light(light));
  }
  for (const std::string& file : words.light_files) {
    const std::vector<radvor_light_desc> more = load_lights(file);
    options.lights.insert(options.lights.end(), more.begin(), more.end());
  }
  if (!words.camera.empty()) {
    options.camera = parse_camera(words.camera);
  }
  check(options);
  return options;
}

}  // namespace bake
