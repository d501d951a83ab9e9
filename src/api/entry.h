// What every entry point of the C ABI does: set the floating-point environment, call the core, and turn whatever is
// thrown into a result, a sentence in the context and a line in the log. Nothing passes this border.
#pragma once

#include <radvor.h>

#include <cstddef>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "base/error.h"
#include "base/floating_point.h"
#include "base/host.h"
#include "visibility/embree_library.h"

/// What radvor_context points to. Every other handle has a member `radvor_context* context`, the one it came from.
struct radvor_context {
  explicit radvor_context(const radvor_context_desc& desc);

  radvor_context_desc lent;  ///< the description as given; its embree_path is dead, the one below lives
  radvor::Host host;
  std::pmr::string embree_path;  ///< empty: the system's
  mutable std::mutex embree_mutex;
  mutable std::optional<radvor::EmbreeLibrary> embree;  ///< by embree_of(); outlives what is made from the context

  static constexpr std::size_t k_error_size = 640;  ///< the function's name and an Error's sentence
  mutable std::mutex error_mutex;                   ///< calls with const handles may fail at the same time
  mutable char error[k_error_size] = "";
};

namespace radvor::api {

/// What a failed call says of itself.
struct Failure {
  radvor_result result;
  char reason[512];
};

/// The failure that the exception being handled stands for. Allocates nothing.
Failure describe_exception() noexcept;

/// Turns the exception being handled into a result; the sentence goes into `context` and its log.
radvor_result report_exception(const radvor_context* context, const char* function) noexcept;

/// The body of every entry point that has a result: `return enter(context, __func__, [&] { ... });`. The call
/// returns nothing (RADVOR_OK) or a radvor_result. A context of NULL (from a handle of NULL) is an invalid argument.
template <class Call>
radvor_result enter(const radvor_context* context, const char* function, Call&& call) noexcept {
  if (!context) {
    return RADVOR_ERROR_INVALID_ARGUMENT;
  }
  const FloatingPointGuard guard(Denormals::keep);
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Call>>) {
      call();
      return RADVOR_OK;
    } else {
      return call();
    }
  } catch (...) {
    return report_exception(context, function);
  }
}

/// The context of a handle, NULL for NULL.
template <class Handle>
radvor_context* context_of(const Handle* handle) noexcept {
  return handle ? handle->context : nullptr;
}

/// Throws RADVOR_ERROR_INVALID_ARGUMENT for NULL; `name` is the parameter's.
inline void require(const void* pointer, const char* name) {
  if (!pointer) {
    throw Error(ErrorCode::invalid_argument, "%s is NULL", name);
  }
}

/// A new handle in the context's memory.
template <class Handle, class... Arguments>
Handle* make_handle(radvor_context* context, Arguments&&... arguments) {
  std::pmr::polymorphic_allocator<> allocator(&context->host.memory);
  return allocator.new_object<Handle>(std::forward<Arguments>(arguments)...);
}

/// The body of every radvor_*_destroy but the context's; NULL is fine.
template <class Handle>
void destroy_handle(Handle* handle) noexcept {
  if (handle) {
    const FloatingPointGuard guard(Denormals::keep);
    std::pmr::polymorphic_allocator<> allocator(&handle->context->host.memory);
    allocator.delete_object(handle);
  }
}

/// The body of every entry point that makes a handle: `*out` is NULL first and stays so on failure; `make` returns the
/// handle, from make_handle.
template <class Handle, class Make>
radvor_result enter_create(const radvor_context* context, const char* function, Handle** out, Make&& make) noexcept {
  if (out) {
    *out = nullptr;
  }
  return enter(context, function, [&] {
    require(out, "the pointer that gets the handle");
    *out = make();
  });
}

}  // namespace radvor::api
