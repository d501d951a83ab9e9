// A bake: a snapshot of a scene, its surface, and the light on it so far. Everything that light needs is made when a
// bake is created; advance() then spends time on light, in units of work whose order is fixed.
#pragma once

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>

#include "base/host.h"
#include "base/vector.h"
#include "scene/scene.h"
#include "surface/spacing.h"
#include "surface/surface.h"
#include "visibility/visibility.h"

namespace radvor {

/// Parts of the method that can be turned off to measure them; the bits of RADVOR_DISABLE_*.
struct Disable {
  static constexpr std::uint32_t facing = 1u << 0, negligible = 1u << 1, lazy = 1u << 2, clear_shafts = 1u << 3,
                                 refinement = 1u << 4, tie_alignment = 1u << 5, shadow_sites = 1u << 6,
                                 shadow_edges = 1u << 7, intersections = 1u << 8, indirect = 1u << 9;
};

/// All resolved: radvor_bake_options after its defaults.
struct BakeOptions {
  SpacingRequest spacing;
  double tolerance = 0.02;
  double tie_tolerance = 1e-9;
  double crease_angle = 0.5235987755982988;
  double weld_distance = 0;
  double max_seconds = 0;         ///< 0: no limit
  std::uint32_t max_bounces = 0;  ///< 0: until converged
  std::uint32_t disable = 0;
  std::uint32_t seed = 0;
};

struct BakeStats {
  std::uint64_t shots = 0, rays = 0, form_factors = 0;
  std::uint32_t ties = 0, realigned_ties = 0;
  std::uint64_t skipped_facing = 0, skipped_negligible = 0, skipped_lazy = 0, skipped_clear = 0;
  double seconds_setup = 0, seconds_direct = 0, seconds_indirect = 0, seconds_rays = 0;
  // W, summed over RGB; each measured, none the remainder of the others.
  double emitted_power = 0, absorbed_power = 0, absorbed_back_power = 0, unshot_power = 0, escaped_power = 0;
};

struct BakeProgress {
  std::uint32_t sites = 0;
  std::uint64_t shots = 0, rays = 0;
  double seconds = 0;    ///< spent since the bake was created
  double converged = 0;  ///< 0..1, never falls
};

enum class BakeStatus { converged, time_spent, cancelled };

/// Makes the answer to "what blocks": Embree's or brute force. user is the maker's own.
struct VisibilityMaker {
  Visibility* (*make)(void* user, const Occluders& occluders, Host& host);
  void (*destroy)(void* user, Visibility* visibility, Host& host);
  void* user;
};

/// Told between units of work, on the calling thread; true: cancel.
struct ProgressCallback {
  bool (*call)(void* user, const BakeProgress& progress) = nullptr;
  void* user = nullptr;
};

class Bake {
 public:
  /// Takes the scene over. Throws Error or std::bad_alloc; then nothing is left behind.
  Bake(Scene scene, const BakeOptions& options, const VisibilityMaker& visibility, Host& host);
  ~Bake();
  Bake(const Bake&) = delete;
  Bake& operator=(const Bake&) = delete;

  /// Works until converged, cancelled, or `seconds` are spent (<= 0: no limit of this call's; options.max_seconds holds
  /// over all calls). Where it throws (std::bad_alloc) the bake is broken: from then on this and all that reads light
  /// or surface throws Error. Any sequence of slices that converges gives the same bytes.
  BakeStatus advance(double seconds, const ProgressCallback& callback);

  const Scene& scene() const;
  const WeldedScene& welded() const;
  const Facets& facets() const;
  const Surface& surface() const;
  const BakeOptions& options() const;
  Host& host() const;

  /// Irradiance of each sample of the surface, W m^-2. After a slice that did not converge direct() has guesses where
  /// light is still to come (Solver::show).
  std::span<const Color> direct() const;
  std::span<const Color> indirect() const;
  /// What is added to direct() where triangles interpolate (fit.h); empty where nothing is.
  std::span<const Color> fit() const;

  BakeProgress progress() const;
  BakeStats stats() const;

 private:
  struct State;
  State* state_;
};

}  // namespace radvor
