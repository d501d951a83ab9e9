// Small checks of what a caller gives; each throws an Error whose sentence names the value.
#pragma once

#include <cinttypes>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/error.h"

namespace radvor::api {

/// World coordinates beyond it, in scene units, get RADVOR_ERROR_LIMIT: rays are traced in single precision, where
/// squares of larger ones come near the end of the range.
inline constexpr double k_largest_coordinate = 1e16;

inline void check_flags(const char* what, std::uint32_t flags, std::uint32_t known) {
  if ((flags & ~known) != 0) {
    throw Error(ErrorCode::invalid_argument, "%s is 0x%" PRIx32 ", of which 0x%" PRIx32 " is unknown", what, flags,
                flags & ~known);
  }
}

/// Finite and low <= value <= high; NaN fails.
inline void check_range(const char* what, double value, double low, double high) {
  if (!(value >= low && value <= high) || !std::isfinite(value)) {
    throw Error(ErrorCode::invalid_argument, "%s is %.9g, not from %.9g to %.9g", what, value, low, high);
  }
}

/// Finite and not negative.
inline void check_not_negative(const char* what, double value) {
  if (!(value >= 0) || !std::isfinite(value)) {
    throw Error(ErrorCode::invalid_argument, "%s is %.9g, not a finite number of at least 0", what, value);
  }
}

/// The stride of an array of floats in bytes, where 0 stands for a dense one.
inline std::size_t checked_stride(const char* what, std::size_t given, std::size_t floats, std::uint32_t count) {
  const std::size_t dense = floats * sizeof(float);
  const std::size_t stride = given == 0 ? dense : given;
  if (stride < dense || stride > SIZE_MAX / (count == 0 ? 1 : count)) {
    throw Error(ErrorCode::invalid_argument, "%s is %zu bytes, for elements of %zu", what, given, dense);
  }
  return stride;
}

/// Element `index` of a strided array, wherever it lies.
template <class Element>
Element read_element(const void* array, std::size_t stride, std::size_t index) {
  Element element;
  std::memcpy(&element, static_cast<const char*>(array) + index * stride, sizeof element);
  return element;
}

}  // namespace radvor::api
