// A bake of a small scene made of the fuzzer's bytes, through the C ABI: whatever the caller hands over, radvor answers
// with light that is finite or with an error that is not its own fault, and gives all memory back.
//
// Corners lie mostly on a lattice of few points, so that triangles touch, overlap, cut and degenerate all the time;
// some are any bits at all. The engine runs tasks on the calling thread and lends at most k_most_bytes.
#include <radvor.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "bytes.h"

namespace {

using radvor::fuzz::Bytes;

constexpr std::size_t k_most_bytes = std::size_t{1} << 28;

struct MeshInput {
  std::vector<float> positions, normals, colors, uvs;
  std::vector<std::uint32_t> indices, materials;
  std::vector<double> transform;
  radvor_mesh_desc desc{};
};

// What was handed over, kept for print(): an input that fails shows itself as a scene.
struct Input {
  std::vector<radvor_material_desc> materials;
  std::vector<MeshInput> meshes;
  std::vector<radvor_light_desc> lights;
  radvor_bake_options options{};
};

void print(const Input& input) {
  unsigned first = 1;
  for (const MeshInput& mesh : input.meshes) {
    std::fprintf(stderr, "# flags %u, transformed %d\n", mesh.desc.flags, !mesh.transform.empty());
    for (std::size_t i = 0; i + 2 < mesh.positions.size(); i += 3) {
      std::fprintf(stderr, "v %.9g %.9g %.9g\n", static_cast<double>(mesh.positions[i]),
                   static_cast<double>(mesh.positions[i + 1]), static_cast<double>(mesh.positions[i + 2]));
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      std::fprintf(stderr, "f %u %u %u\n", mesh.indices[i] + first, mesh.indices[i + 1] + first,
                   mesh.indices[i + 2] + first);
    }
    first += static_cast<unsigned>(mesh.positions.size() / 3);
  }
  for (const radvor_light_desc& light : input.lights) {
    std::fprintf(stderr, "# light of type %u at %g %g %g along %g %g %g\n", light.type, light.position[0],
                 light.position[1], light.position[2], static_cast<double>(light.direction[0]),
                 static_cast<double>(light.direction[1]), static_cast<double>(light.direction[2]));
  }
  std::fprintf(stderr, "# lattice %u, patch_spacing %g, disable 0x%x\n", input.options.lattice,
               static_cast<double>(input.options.patch_spacing), input.options.disable);
}

[[noreturn]] void fail(const Input& input, const char* what) {
  std::fprintf(stderr, "bake_fuzz: %s\n", what);
  print(input);
  std::abort();
}

float coordinate(Bytes& bytes, bool wild) {
  if (wild && bytes.chance(16)) {
    return bytes.raw<float>();
  }
  static constexpr float k_lattice[] = {0, 1, -1, 0.5f, 2, 1e-6f, 1.0f / 3, 1 + 1e-6f};
  return k_lattice[bytes.below(8)];
}

radvor_material_desc make_material(Bytes& bytes) {
  static constexpr float k_albedo[] = {0, 0.5f, 0.9f, 1};
  radvor_material_desc material{};
  material.struct_size = sizeof material;
  material.flags = bytes.below(2);
  for (int channel = 0; channel < 3; ++channel) {
    const std::uint32_t choice = bytes.below(16);
    material.albedo[channel] = k_albedo[choice % 4];
    material.emission[channel] = choice / 4 == 3 ? 1.0f + static_cast<float>(channel) : 0;
  }
  if (bytes.chance(64)) {
    material.emission[0] = bytes.raw<float>();
  }
  return material;
}

std::vector<float> make_floats(Bytes& bytes, std::size_t count, bool wild) {
  std::vector<float> made;
  for (std::size_t i = 0; i < count; ++i) {
    made.push_back(coordinate(bytes, wild));
  }
  return made;
}

MeshInput make_mesh(Bytes& bytes, std::uint32_t material_count) {
  MeshInput mesh;
  const bool wild = bytes.chance(8);
  const std::uint32_t vertices = 3 + bytes.below(10), triangles = 1 + bytes.below(12);
  mesh.positions = make_floats(bytes, std::size_t{3} * vertices, wild);
  for (std::uint32_t i = 0; i < 3 * triangles; ++i) {
    mesh.indices.push_back(bytes.below(wild ? vertices + 1 : vertices));
  }
  for (std::uint32_t i = 0; i < triangles; ++i) {
    mesh.materials.push_back(bytes.below(material_count));
  }
  radvor_mesh_desc& desc = mesh.desc;
  desc.struct_size = sizeof desc;
  desc.flags = bytes.chance(4) ? bytes.below(8) : 0;
  desc.vertex_count = vertices;
  desc.triangle_count = triangles;
  if (bytes.chance(4)) {
    mesh.normals = make_floats(bytes, std::size_t{3} * vertices, wild);
  }
  if (bytes.chance(4)) {
    mesh.colors = make_floats(bytes, std::size_t{3} * vertices, wild);
    for (float& color : mesh.colors) {
      color = std::abs(color);
    }
  }
  if (bytes.chance(4)) {
    mesh.uvs = make_floats(bytes, std::size_t{2} * vertices, wild);
  }
  if (bytes.chance(4)) {
    for (int i = 0; i < 12; ++i) {
      mesh.transform.push_back(bytes.chance(4) ? bytes.raw<float>() : static_cast<double>(coordinate(bytes, wild)));
    }
  }
  return mesh;
}

// After the mesh has come to rest in its vector.
void point_to_arrays(MeshInput& mesh) {
  mesh.desc.positions = mesh.positions.data();
  mesh.desc.normals = mesh.normals.empty() ? nullptr : mesh.normals.data();
  mesh.desc.colors = mesh.colors.empty() ? nullptr : mesh.colors.data();
  mesh.desc.uvs = mesh.uvs.empty() ? nullptr : mesh.uvs.data();
  mesh.desc.indices = mesh.indices.data();
  mesh.desc.triangle_materials = mesh.materials.data();
  mesh.desc.transform = mesh.transform.empty() ? nullptr : mesh.transform.data();
}

radvor_light_desc make_light(Bytes& bytes) {
  radvor_light_desc light{};
  light.struct_size = sizeof light;
  light.type = bytes.below(4);
  const bool wild = bytes.chance(16);
  for (int axis = 0; axis < 3; ++axis) {
    light.position[axis] = static_cast<double>(coordinate(bytes, wild));
    light.direction[axis] = coordinate(bytes, wild);
    light.color[axis] = std::abs(coordinate(bytes, wild));
  }
  light.radius = bytes.chance(4) ? 0.25f : 0;
  light.angle = bytes.chance(4) ? 0.01f : 0;
  light.outer_angle = bytes.chance(4) ? 1 : 0;
  return light;
}

Input make_input(Bytes& bytes) {
  Input input;
  radvor_bake_options& options = input.options;
  options.struct_size = sizeof options;
  options.lattice = bytes.below(2);
  options.disable = bytes.chance(4) ? bytes.raw<std::uint16_t>() & 0x3ffu : 0;
  options.tolerance = 0.1f;
  options.patch_spacing = bytes.chance(2) ? 0.5f : 1;
  options.min_spacing = 0.2f;
  options.element_levels = 1;
  options.weld_distance = bytes.chance(4) ? 1e-5f : 0;
  options.max_sites = 500;
  options.max_bounces = 3;
  options.max_seconds = 1;
  const std::uint32_t materials = 1 + bytes.below(3), meshes = 1 + bytes.below(3), lights = bytes.below(3);
  for (std::uint32_t i = 0; i < materials; ++i) {
    input.materials.push_back(make_material(bytes));
  }
  for (std::uint32_t i = 0; i < meshes; ++i) {
    input.meshes.push_back(make_mesh(bytes, materials));
  }
  for (MeshInput& mesh : input.meshes) {
    point_to_arrays(mesh);
  }
  for (std::uint32_t i = 0; i < lights; ++i) {
    input.lights.push_back(make_light(bytes));
  }
  return input;
}

// The engine: memory with a limit, tasks on the calling thread.
struct Engine {
  std::size_t live = 0;

  static void* acquire(void* user, std::size_t bytes, std::size_t alignment) {
    auto& self = *static_cast<Engine*>(user);
    if (bytes > k_most_bytes - self.live) {
      return nullptr;
    }
    self.live += bytes;
    const std::size_t least = alignment < sizeof(void*) ? sizeof(void*) : alignment;
    return std::aligned_alloc(least, (bytes + least - 1) / least * least);
  }
  static void release(void* user, void* memory, std::size_t bytes, std::size_t) {
    static_cast<Engine*>(user)->live -= bytes;
    std::free(memory);
  }
  static void parallel_for(void*, std::uint32_t count, radvor_task task, void* data) {
    for (std::uint32_t i = 0; i < count; ++i) {
      task(data, i);
    }
  }
};

void check(const Input& input, radvor_result result, radvor_context* context) {
  if (result == RADVOR_ERROR_INTERNAL || result == RADVOR_ERROR_UNSUPPORTED) {
    fail(input, radvor_context_error(context));
  }
}

void check_floats(const Input& input, const float* values, std::size_t count, bool light) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(values[i]) || (light && values[i] < 0)) {
      fail(input, light ? "light is negative or no number" : "a coordinate is no number");
    }
  }
}

void read(const Input& input, radvor_solution* solution, radvor_context* context) {
  std::vector<float> rgb;
  for (std::uint32_t mesh = 0; mesh < input.meshes.size(); ++mesh) {
    const std::uint32_t vertices = input.meshes[mesh].desc.vertex_count;
    for (const std::uint32_t side : {std::uint32_t{0}, std::uint32_t{RADVOR_SIDE_BACK}}) {
      rgb.assign(std::size_t{3} * vertices, NAN);
      const radvor_result read = radvor_solution_vertices(solution, mesh, RADVOR_RADIANCE | side, RADVOR_VERTEX_SAMPLE,
                                                          rgb.data(), 0, vertices);
      check(input, read, context);
      if (read == RADVOR_OK) {
        check_floats(input, rgb.data(), rgb.size(), true);
      }
    }
    radvor_output_mesh output{};
    output.struct_size = sizeof output;
    const radvor_result made = radvor_solution_mesh(solution, mesh, &output);
    check(input, made, context);
    if (made == RADVOR_OK) {
      check_floats(input, output.positions, std::size_t{3} * output.vertex_count, false);
      check_floats(input, output.normals, std::size_t{3} * output.vertex_count, false);
      check_floats(input, output.irradiance, std::size_t{3} * output.vertex_count, true);
      check_floats(input, output.source_weights, std::size_t{9} * output.triangle_count, false);
      for (std::size_t i = 0; i < std::size_t{3} * output.triangle_count; ++i) {
        if (output.indices[i] >= output.vertex_count) {
          fail(input, "an index of the adaptive mesh is out of range");
        }
      }
    }
  }
  const double positions[6] = {0.5, 0.5, 0, 0, 0, 0};
  const float normals[6] = {0, 0, 1, 1, 1, 1};
  float light[6];
  const radvor_result points =
      radvor_solution_points(solution, RADVOR_IRRADIANCE, 2, positions, normals, 2, light, nullptr);
  check(input, points, context);
  if (points == RADVOR_OK) {
    check_floats(input, light, 6, true);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const Input input = make_input(bytes);
  Engine engine;
  radvor_context_desc desc{};
  desc.struct_size = sizeof desc;
  desc.user = &engine;
  desc.acquire = Engine::acquire;
  desc.release = Engine::release;
  desc.parallel_for = Engine::parallel_for;
  radvor_context* context = nullptr;
  radvor_scene* scene = nullptr;
  radvor_solution* solution = nullptr;
  if (radvor_context_create(&desc, &context) != RADVOR_OK || radvor_scene_create(context, &scene) != RADVOR_OK) {
    fail(input, "no context or scene");
  }
  std::uint32_t id = 0;
  bool whole = true;  // a refused material shifts the ids: such scenes end here
  for (const radvor_material_desc& material : input.materials) {
    whole = whole && radvor_scene_add_material(scene, &material, &id) == RADVOR_OK;
  }
  for (const MeshInput& mesh : input.meshes) {
    const radvor_result added = whole ? radvor_scene_add_mesh(scene, &mesh.desc, &id) : RADVOR_ERROR_LIMIT;
    check(input, added, context);
    whole = whole && added == RADVOR_OK;
  }
  for (const radvor_light_desc& light : input.lights) {
    check(input, radvor_scene_add_light(scene, &light, &id), context);
  }
  if (whole) {
    const radvor_result baked = radvor_bake(scene, &input.options, &solution);
    check(input, baked, context);
    if ((baked >= 0) != (solution != nullptr)) {
      fail(input, "the handle and the result disagree");
    }
    if (solution) {
      read(input, solution, context);
    }
  }
  radvor_solution_destroy(solution);
  radvor_scene_destroy(scene);
  radvor_context_destroy(context);
  if (engine.live != 0) {
    fail(input, "memory was not given back");
  }
  return 0;
}
