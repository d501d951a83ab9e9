#include "api/bake_options.h"

#include <numbers>

#include "api/checks.h"
#include "api/struct_size.h"

namespace radvor::api {

namespace {

static_assert(static_cast<std::uint32_t>(Lattice::hexagonal) == RADVOR_LATTICE_HEXAGONAL);
static_assert(static_cast<std::uint32_t>(Lattice::quadrilateral) == RADVOR_LATTICE_QUADRILATERAL);
static_assert(Disable::facing == RADVOR_DISABLE_FACING);
static_assert(Disable::negligible == RADVOR_DISABLE_NEGLIGIBLE);
static_assert(Disable::lazy == RADVOR_DISABLE_LAZY);
static_assert(Disable::clear_shafts == RADVOR_DISABLE_CLEAR_SHAFTS);
static_assert(Disable::refinement == RADVOR_DISABLE_REFINEMENT);
static_assert(Disable::tie_alignment == RADVOR_DISABLE_TIE_ALIGNMENT);
static_assert(Disable::shadow_sites == RADVOR_DISABLE_SHADOW_SITES);
static_assert(Disable::shadow_edges == RADVOR_DISABLE_SHADOW_EDGES);
static_assert(Disable::intersections == RADVOR_DISABLE_INTERSECTIONS);
static_assert(Disable::indirect == RADVOR_DISABLE_INDIRECT);

constexpr std::uint32_t k_all_disable_bits = (RADVOR_DISABLE_INDIRECT << 1) - 1;
constexpr std::uint32_t k_most_element_levels = 16;  // spacings in a ratio of 65,536

double or_default(double given, double by_default) {
  return given == 0 ? by_default : given;
}

}  // namespace

BakeOptions resolve_options(const radvor_bake_options* options, radvor_bake_options& as_given) {
  as_given = {};
  if (options) {
    as_given = read_struct(options, "radvor_bake_options");
  }
  const radvor_bake_options& given = as_given;
  if (given.lattice > RADVOR_LATTICE_QUADRILATERAL) {
    throw Error(ErrorCode::invalid_argument, "options: lattice is %" PRIu32 ", which is no RADVOR_LATTICE_*",
                given.lattice);
  }
  if (given.reserved != 0) {
    throw Error(ErrorCode::invalid_argument, "options: reserved is %" PRIu32 ", not 0", given.reserved);
  }
  check_flags("options: disable", given.disable, k_all_disable_bits);
  check_range("options: tolerance", given.tolerance, 0, 1);
  check_range("options: tie_tolerance", given.tie_tolerance, 0, 1);
  check_not_negative("options: patch_spacing", given.patch_spacing);
  check_not_negative("options: min_spacing", given.min_spacing);
  if (given.patch_spacing > 0 && given.min_spacing > given.patch_spacing) {
    throw Error(ErrorCode::invalid_argument, "options: min_spacing is %g, above patch_spacing, %g",
                static_cast<double>(given.min_spacing), static_cast<double>(given.patch_spacing));
  }
  check_range("options: crease_angle", given.crease_angle, 0, std::numbers::pi_v<float>);
  check_not_negative("options: weld_distance", given.weld_distance);
  check_range("options: element_levels", given.element_levels, 0, k_most_element_levels);
  check_not_negative("options: max_seconds", given.max_seconds);

  const BakeOptions defaults;
  BakeOptions resolved;
  resolved.tolerance = or_default(given.tolerance, defaults.tolerance);
  resolved.tie_tolerance = or_default(given.tie_tolerance, defaults.tie_tolerance);
  resolved.crease_angle = or_default(given.crease_angle, defaults.crease_angle);
  resolved.weld_distance = given.weld_distance;
  resolved.max_seconds = given.max_seconds;
  resolved.max_bounces = given.max_bounces;
  resolved.disable = given.disable;
  resolved.seed = given.seed;
  resolved.spacing.lattice = static_cast<Lattice>(given.lattice);
  resolved.spacing.tolerance = resolved.tolerance;
  resolved.spacing.patch_spacing = given.patch_spacing;  // 0 in these four: choose_spacing finds it from the scene
  resolved.spacing.min_spacing = given.min_spacing;
  resolved.spacing.element_levels = given.element_levels;
  resolved.spacing.max_sites = given.max_sites;
  resolved.spacing.refines = k_refines_by_default && (given.disable & Disable::refinement) == 0;
  return resolved;
}

}  // namespace radvor::api
