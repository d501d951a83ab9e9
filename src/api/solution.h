// What radvor_solution points to: a bake, and what calls made from it on demand.
#pragma once

#include <memory_resource>
#include <mutex>
#include <optional>
#include <vector>

#include "api/entry.h"
#include "output/adaptive_mesh.h"
#include "output/points.h"
#include "radiosity/bake.h"

struct radvor_solution {
  radvor_solution(radvor_context* owner, radvor::Scene scene, const radvor::BakeOptions& options,
                  const radvor_bake_options& as_given);

  radvor_context* context;
  int32_t (*progress)(void* user, const radvor_progress* progress);
  void* progress_user;
  std::uint64_t visibility_bytes = 0;  ///< held by what answers visibility, Embree's own memory
  radvor::Bake bake;
  std::pmr::vector<std::optional<radvor::AdaptiveMesh>> meshes;  ///< views handed out, until the light changes
  mutable std::mutex point_index_mutex;                          ///< const calls may come at the same time
  mutable std::optional<radvor::PointIndex> point_index;         ///< made for the first points asked for
};
