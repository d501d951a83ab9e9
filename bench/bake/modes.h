// What bake_bench can be asked to do; bake_bench.py asks, and makes curves of the answers.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace bench {

struct TraceOptions {
  std::string scene, lights, points, prefix;
  bool direct = false;
  std::uint32_t most_bounces = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t seed = 1;
  std::uint32_t most_samples = 1u << 20;
  double most_seconds = 60;  ///< no doubling begins after that
};
int trace_mode(const TraceOptions& options);

/// Bakes as radvor-bake does with the same arguments, and prints its statistics as JSON, processor time with them;
/// --max-seconds counts processor time.
int radvor_mode(int argc, const char* const* argv);

/// The same in slices of so many seconds, direct light alone: what each took, and the light at the points after it.
int slices_mode(double slice, int argc, const char* const* argv);

/// Bakes with the rays recorded on their way to Embree, then casts them again in a bare loop.
int replay_mode(int argc, const char* const* argv);

/// Writes the undone bake's mesh to the file that --stats names, as OBJ, its materials beside it.
int mesh_mode(int argc, const char* const* argv);

/// Writes count random points of a scene's surface as CSV x,y,z,nx,ny,nz.
int points_mode(const std::string& scene, std::uint32_t count, const std::string& file);

/// Prints a scene's triangles, area and diagonal as JSON.
int describe_mode(const std::string& scene);

}  // namespace bench
