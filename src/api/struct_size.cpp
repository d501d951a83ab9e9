#include "api/struct_size.h"

#include <algorithm>
#include <cinttypes>

#include "base/error.h"

namespace radvor::api {

namespace {

// No struct of this ABI comes near it; a larger size is a stray number, and believing it would read beyond the struct.
constexpr std::uint32_t k_largest_struct = 1024;

constexpr std::size_t k_pointer = sizeof(void*);

// Layouts are part of the ABI. The numbers are those of 64-bit targets; 32-bit ones differ in their pointers alone.
#define RADVOR_PIN(type, size) static_assert(k_pointer != 8 || sizeof(type) == (size), #type " changed its size")
RADVOR_PIN(radvor_context_desc, 56);
RADVOR_PIN(radvor_material_desc, 44);
RADVOR_PIN(radvor_mesh_desc, 112);
RADVOR_PIN(radvor_light_desc, 96);
RADVOR_PIN(radvor_progress, 40);
RADVOR_PIN(radvor_bake_options, 80);
RADVOR_PIN(radvor_output_mesh, 88);
RADVOR_PIN(radvor_stats, 184);
#undef RADVOR_PIN

constexpr WideFields k_context_desc[] = {
    {offsetof(radvor_context_desc, embree_path), sizeof(radvor_context_desc), k_pointer}};
constexpr WideFields k_mesh_desc[] = {
    {offsetof(radvor_mesh_desc, positions), offsetof(radvor_mesh_desc, index_size), k_pointer},
    {offsetof(radvor_mesh_desc, triangle_materials), sizeof(radvor_mesh_desc), k_pointer}};
constexpr WideFields k_light_desc[] = {
    {offsetof(radvor_light_desc, position), offsetof(radvor_light_desc, direction), sizeof(double)},
    {offsetof(radvor_light_desc, image), offsetof(radvor_light_desc, image_width), k_pointer}};
constexpr WideFields k_progress[] = {{offsetof(radvor_progress, shots), sizeof(radvor_progress), sizeof(double)}};
constexpr WideFields k_bake_options[] = {
    {offsetof(radvor_bake_options, max_seconds), offsetof(radvor_bake_options, progress), sizeof(double)},
    {offsetof(radvor_bake_options, progress), offsetof(radvor_bake_options, progress) + 2 * k_pointer, k_pointer}};
constexpr WideFields k_output_mesh[] = {
    {offsetof(radvor_output_mesh, positions), sizeof(radvor_output_mesh), k_pointer}};
constexpr WideFields k_stats[] = {{offsetof(radvor_stats, shots), sizeof(radvor_stats), sizeof(double)}};

}  // namespace

template <>
std::span<const WideFields> wide_fields<radvor_context_desc>() noexcept {
  return k_context_desc;
}
template <>
std::span<const WideFields> wide_fields<radvor_material_desc>() noexcept {
  return {};
}
template <>
std::span<const WideFields> wide_fields<radvor_mesh_desc>() noexcept {
  return k_mesh_desc;
}
template <>
std::span<const WideFields> wide_fields<radvor_light_desc>() noexcept {
  return k_light_desc;
}
template <>
std::span<const WideFields> wide_fields<radvor_progress>() noexcept {
  return k_progress;
}
template <>
std::span<const WideFields> wide_fields<radvor_bake_options>() noexcept {
  return k_bake_options;
}
template <>
std::span<const WideFields> wide_fields<radvor_output_mesh>() noexcept {
  return k_output_mesh;
}
template <>
std::span<const WideFields> wide_fields<radvor_stats>() noexcept {
  return k_stats;
}

void check_struct_size(const void* given_struct, const char* name, std::uint32_t given, std::size_t known,
                       std::span<const WideFields> wide) {
  const bool cut = std::any_of(wide.begin(), wide.end(), [given](const WideFields& fields) {
    return given > fields.begin && given < fields.end && (given - fields.begin) % fields.width != 0;
  });
  if (given < sizeof(std::uint32_t) || given > k_largest_struct || given % sizeof(std::uint32_t) != 0 || cut) {
    throw Error(ErrorCode::invalid_argument, "%s: struct_size is %" PRIu32 ", not sizeof the struct (%zu here)", name,
                given, known);
  }
  const char* bytes = static_cast<const char*>(given_struct);
  for (std::size_t i = known; i < given; ++i) {
    if (bytes[i] != 0) {
      throw Error(ErrorCode::invalid_argument,
                  "%s: byte %zu of %" PRIu32 " is not 0, but this library knows %zu bytes of the struct", name, i,
                  given, known);
    }
  }
}

}  // namespace radvor::api
