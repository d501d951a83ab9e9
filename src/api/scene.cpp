// radvor_scene_create, _destroy and _add_material.
#include "api/scene.h"

#include <cstdio>
#include <utility>

#include "api/checks.h"
#include "api/struct_size.h"

using namespace radvor;
using namespace radvor::api;

namespace {

template <class Vector>
void copy_into(Vector& to, const Vector& from) {
  to.assign(from.begin(), from.end());
}

Color checked_color(std::size_t material, const char* name, const float (&rgb)[3], double high) {
  for (int channel = 0; channel < 3; ++channel) {
    char what[64];
    std::snprintf(what, sizeof what, "material %zu: %s[%d]", material, name, channel);
    if (std::isfinite(high)) {
      check_range(what, rgb[channel], 0, high);
    } else {
      check_not_negative(what, rgb[channel]);
    }
  }
  return Color(rgb[0], rgb[1], rgb[2]);
}

Material checked_material(std::size_t index, const radvor_material_desc& desc) {
  char what[64];
  std::snprintf(what, sizeof what, "material %zu: flags", index);
  check_flags(what, desc.flags, RADVOR_MATERIAL_TWO_SIDED);
  Material material;
  material.albedo = checked_color(index, "albedo", desc.albedo, 1);
  material.emission = checked_color(index, "emission", desc.emission, INFINITY);
  const Color transmission = checked_color(index, "transmission", desc.transmission, 1);
  if (transmission != Color(0.0)) {
    throw Error(ErrorCode::unsupported,
                "material %zu: transmission is not 0: surfaces that let light through come later", index);
  }
  material.two_sided = (desc.flags & RADVOR_MATERIAL_TWO_SIDED) != 0;
  return material;
}

}  // namespace

namespace radvor::api {

Scene copy_scene(const Scene& scene, std::pmr::memory_resource* memory) {
  Scene copy(memory);
  copy_into(copy.materials, scene.materials);
  copy_into(copy.lights, scene.lights);
  copy.meshes.reserve(scene.meshes.size());
  for (const Mesh& mesh : scene.meshes) {
    Mesh& to = copy.meshes.emplace_back(memory);
    copy_into(to.positions, mesh.positions);
    copy_into(to.normals, mesh.normals);
    copy_into(to.colors, mesh.colors);
    copy_into(to.uvs, mesh.uvs);
    copy_into(to.indices, mesh.indices);
    copy_into(to.triangle_materials, mesh.triangle_materials);
    copy_into(to.sites, mesh.sites);
    to.transform = mesh.transform;
    to.receives = mesh.receives;
    to.casts = mesh.casts;
    to.clockwise = mesh.clockwise;
  }
  return copy;
}

}  // namespace radvor::api

radvor_result radvor_scene_create(radvor_context* context, radvor_scene** scene) {
  return enter_create(context, __func__, scene, [&] { return make_handle<radvor_scene>(context, context); });
}

void radvor_scene_destroy(radvor_scene* scene) {
  destroy_handle(scene);
}

radvor_result radvor_scene_add_material(radvor_scene* scene, const radvor_material_desc* desc, uint32_t* material) {
  return enter(context_of(scene), __func__, [&] {
    require(desc, "desc");
    require(material, "material");
    const radvor_material_desc known = read_struct(desc, "radvor_material_desc");
    auto& materials = scene->scene.materials;
    materials.push_back(checked_material(materials.size(), known));
    *material = static_cast<std::uint32_t>(materials.size() - 1);
  });
}
