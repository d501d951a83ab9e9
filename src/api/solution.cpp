// radvor_bake and the same a slice at a time: radvor_solution_create, _advance and _destroy.
#include "api/solution.h"

#include <cmath>
#include <utility>

#include "api/bake_options.h"
#include "api/checks.h"
#include "api/embree.h"
#include "api/scene.h"
#include "api/struct_size.h"
#include "visibility/embree_visibility.h"

using namespace radvor;
using namespace radvor::api;

namespace {

Visibility* make_visibility(void* user, const Occluders& occluders, Host& host) {
  auto* solution = static_cast<radvor_solution*>(user);
  const EmbreeLibrary& library = embree_of(*solution->context);
  auto* made = std::pmr::polymorphic_allocator<>(&host.memory).new_object<EmbreeVisibility>(library, occluders, host);
  solution->visibility_bytes = made->bytes();
  return made;
}

void destroy_visibility(void*, Visibility* visibility, Host& host) {
  std::pmr::polymorphic_allocator<>(&host.memory).delete_object(static_cast<EmbreeVisibility*>(visibility));
}

radvor_progress to_abi(const BakeProgress& progress) {
  radvor_progress out{};
  out.struct_size = sizeof out;
  out.sites = progress.sites;
  out.shots = progress.shots;
  out.rays = progress.rays;
  out.seconds = progress.seconds;
  out.converged = progress.converged;
  return out;
}

radvor_result to_abi(BakeStatus status) {
  switch (status) {
    case BakeStatus::converged:
      return RADVOR_OK;
    case BakeStatus::time_spent:
      return RADVOR_TIME_SPENT;
    case BakeStatus::cancelled:
      return RADVOR_CANCELLED;
  }
  throw Error(ErrorCode::internal, "a bake ended in an unknown way");
}

radvor_result advance(radvor_solution& solution, double seconds) {
  solution.meshes.clear();  // their light is about to change
  const auto tell = [](void* user, const BakeProgress& progress) {
    const auto& told = *static_cast<radvor_solution*>(user);
    const radvor_progress out = to_abi(progress);
    return told.progress(told.progress_user, &out) != 0;
  };
  ProgressCallback callback;
  if (solution.progress) {
    callback = {tell, &solution};
  }
  return to_abi(solution.bake.advance(seconds, callback));
}

radvor_solution* make_solution(const radvor_scene& scene, const radvor_bake_options* options) {
  radvor_bake_options as_given;
  const BakeOptions resolved = resolve_options(options, as_given);
  if (scene.scene.meshes.empty()) {
    throw Error(ErrorCode::invalid_argument, "the scene has no mesh");
  }
  return make_handle<radvor_solution>(scene.context, scene.context,
                                      copy_scene(scene.scene, &scene.context->host.memory), resolved, as_given);
}

}  // namespace

radvor_solution::radvor_solution(radvor_context* owner, Scene scene, const BakeOptions& options,
                                 const radvor_bake_options& as_given)
    : context(owner),
      progress(as_given.progress),
      progress_user(as_given.progress_user),
      bake(std::move(scene), options, VisibilityMaker{make_visibility, destroy_visibility, this}, owner->host),
      meshes(&owner->host.memory) {}

radvor_result radvor_solution_create(const radvor_scene* scene, const radvor_bake_options* options,
                                     radvor_solution** solution) {
  return enter_create(context_of(scene), __func__, solution, [&] { return make_solution(*scene, options); });
}

radvor_result radvor_bake(const radvor_scene* scene, const radvor_bake_options* options, radvor_solution** solution) {
  radvor_result result = RADVOR_OK;
  const radvor_result made = enter_create(context_of(scene), __func__, solution, [&] {
    radvor_solution* baked = make_solution(*scene, options);
    try {
      result = advance(*baked, 0);
    } catch (...) {
      destroy_handle(baked);
      throw;
    }
    return baked;
  });
  return made == RADVOR_OK ? result : made;
}

radvor_result radvor_solution_advance(radvor_solution* solution, double seconds, radvor_progress* progress) {
  return enter(context_of(solution), __func__, [&] {
    if (!(seconds >= 0)) {
      throw Error(ErrorCode::invalid_argument, "seconds is %g, not at least 0", seconds);
    }
    if (progress) {
      check_output_struct(progress, "radvor_progress");
    }
    const radvor_result result = advance(*solution, std::isinf(seconds) ? 0 : seconds);
    if (progress) {
      write_struct(progress, to_abi(solution->bake.progress()));
    }
    return result;
  });
}

void radvor_solution_destroy(radvor_solution* solution) {
  destroy_handle(solution);
}
