// radvor_version, radvor_result_string and the context: what the engine lends, checked and kept.
#include <cinttypes>
#include <memory>
#include <new>

#include "api/entry.h"
#include "api/struct_size.h"

using namespace radvor;
using namespace radvor::api;

namespace {

constexpr std::uint32_t k_most_threads = 4096;

void check(const radvor_context_desc& desc) {
  if (desc.thread_count > k_most_threads) {
    throw Error(ErrorCode::invalid_argument, "thread_count is %" PRIu32 ", above %" PRIu32, desc.thread_count,
                k_most_threads);
  }
  if (desc.release && !desc.acquire) {
    throw Error(ErrorCode::invalid_argument, "release without acquire: memory would go back to who never lent it");
  }
}

}  // namespace

radvor_context::radvor_context(const radvor_context_desc& desc)
    : lent(desc),
      host{HostMemory(desc.acquire, desc.release, desc.user), Log(desc.log, desc.user),
           Jobs(desc.thread_count, desc.parallel_for, desc.user, std::addressof(host.memory))},
      embree_path(desc.embree_path ? desc.embree_path : "", &host.memory) {
  lent.embree_path = nullptr;
}

uint32_t radvor_version(void) {
  return std::uint32_t{RADVOR_VERSION_MAJOR} << 22 | std::uint32_t{RADVOR_VERSION_MINOR} << 12 | RADVOR_VERSION_PATCH;
}

const char* radvor_result_string(radvor_result result) {
  switch (result) {
    case RADVOR_OK:
      return "ok";
    case RADVOR_CANCELLED:
      return "cancelled by the progress callback; what was computed is readable";
    case RADVOR_TIME_SPENT:
      return "the time given is over; what was computed is readable";
    case RADVOR_ERROR_INVALID_ARGUMENT:
      return "invalid argument";
    case RADVOR_ERROR_INVALID_GEOMETRY:
      return "invalid geometry";
    case RADVOR_ERROR_OUT_OF_MEMORY:
      return "out of memory";
    case RADVOR_ERROR_LIMIT:
      return "beyond a limit";
    case RADVOR_ERROR_CONSTRAINT:
      return "a constraint edge would cross another";
    case RADVOR_ERROR_UNSUPPORTED:
      return "not supported by this build or device";
    case RADVOR_ERROR_INTERNAL:
      return "internal error: a bug in radvor";
    default:
      return "unknown result";
  }
}

radvor_result radvor_context_create(const radvor_context_desc* desc, radvor_context** context) {
  if (context) {
    *context = nullptr;
  }
  const FloatingPointGuard guard(Denormals::keep);
  radvor_context_desc known{};
  try {
    if (desc) {
      known = read_struct(desc, "radvor_context_desc");
    }
    require(context, "context");
    check(known);
    // The context itself lies in the host's memory, apart from the one it counts; not in regions of the lender's.
    static_assert(sizeof(radvor_context) < Regions::k_least);
    HostMemory lender(known.acquire, known.release, known.user);
    *context = std::pmr::polymorphic_allocator<>(&lender).new_object<radvor_context>(known);
    return RADVOR_OK;
  } catch (...) {  // there is no context to keep the reason: the log of the description has it
    const Failure failure = describe_exception();
    Log(known.log, known.user)(LogLevel::error, "radvor_context_create: %s", failure.reason);
    return failure.result;
  }
}

void radvor_context_destroy(radvor_context* context) {
  if (!context) {
    return;
  }
  const FloatingPointGuard guard(Denormals::keep);
  HostMemory lender(context->lent.acquire, context->lent.release, context->lent.user);
  std::pmr::polymorphic_allocator<>(&lender).delete_object(context);
}

const char* radvor_context_error(const radvor_context* context) {
  return context ? context->error : "no context: the handle is NULL, or the context could not be created";
}
