#include "api/entry.h"

#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>

namespace radvor::api {

namespace {

constexpr radvor_result result_of(ErrorCode code) noexcept {
  return static_cast<radvor_result>(code);
}

static_assert(result_of(ErrorCode::invalid_argument) == RADVOR_ERROR_INVALID_ARGUMENT);
static_assert(result_of(ErrorCode::invalid_geometry) == RADVOR_ERROR_INVALID_GEOMETRY);
static_assert(result_of(ErrorCode::out_of_memory) == RADVOR_ERROR_OUT_OF_MEMORY);
static_assert(result_of(ErrorCode::limit) == RADVOR_ERROR_LIMIT);
static_assert(result_of(ErrorCode::constraint) == RADVOR_ERROR_CONSTRAINT);
static_assert(result_of(ErrorCode::unsupported) == RADVOR_ERROR_UNSUPPORTED);
static_assert(result_of(ErrorCode::internal) == RADVOR_ERROR_INTERNAL);

static_assert(static_cast<std::int32_t>(LogLevel::error) == RADVOR_LOG_ERROR);
static_assert(static_cast<std::int32_t>(LogLevel::warning) == RADVOR_LOG_WARNING);
static_assert(static_cast<std::int32_t>(LogLevel::info) == RADVOR_LOG_INFO);
static_assert(static_cast<std::int32_t>(LogLevel::debug) == RADVOR_LOG_DEBUG);

Failure failure(radvor_result result, const char* reason) noexcept {
  Failure made{result, ""};
  std::snprintf(made.reason, sizeof made.reason, "%s", reason);
  return made;
}

}  // namespace

Failure describe_exception() noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return failure(result_of(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    return failure(RADVOR_ERROR_OUT_OF_MEMORY, "out of memory");
  } catch (const std::length_error&) {  // a container that cannot be as large as asked
    return failure(RADVOR_ERROR_OUT_OF_MEMORY, "out of memory: an array would be too long");
  } catch (const std::exception& error) {
    return failure(RADVOR_ERROR_INTERNAL, error.what());
  } catch (...) {
    return failure(RADVOR_ERROR_INTERNAL, "an exception of unknown type");
  }
}

radvor_result report_exception(const radvor_context* context, const char* function) noexcept {
  const Failure failure = describe_exception();
  {
    const std::lock_guard<std::mutex> lock(context->error_mutex);
    std::snprintf(context->error, sizeof context->error, "%s: %s", function, failure.reason);
  }
  context->host.log(LogLevel::error, "%s: %s", function, failure.reason);
  return failure.result;
}

}  // namespace radvor::api
