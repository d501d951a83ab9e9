// Structs that grow: the one place that reads and writes them by their struct_size. Older (smaller) sizes leave the
// fields they lack at 0, larger ones pass where the bytes unknown here are 0, and no write goes beyond the size.
#pragma once

#include <radvor.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace radvor::api {

/// A run of equally wide fields that struct_size must not cut in two.
struct WideFields {
  std::size_t begin, end;  ///< bytes from the start of the struct
  std::size_t width;       ///< bytes of one field; all other fields are 4 bytes wide
};

/// The wide fields of a struct of the ABI, in order. struct_size.cpp has them and pins all sizes.
template <class Struct>
std::span<const WideFields> wide_fields() noexcept;

/// Throws RADVOR_ERROR_INVALID_ARGUMENT unless `given` is a size that a struct of `known` bytes may have, and the
/// bytes beyond `known` are 0.
void check_struct_size(const void* given_struct, const char* name, std::uint32_t given, std::size_t known,
                       std::span<const WideFields> wide);

/// A copy of the caller's struct as this library knows it: what the caller's size lacks is 0.
template <class Struct>
Struct read_struct(const Struct* given, const char* name) {
  static_assert(std::is_trivially_copyable_v<Struct>);
  std::uint32_t size;
  std::memcpy(&size, given, sizeof size);
  check_struct_size(given, name, size, sizeof(Struct), wide_fields<Struct>());
  Struct known{};
  std::memcpy(static_cast<void*>(&known), given, size < sizeof(Struct) ? size : sizeof(Struct));
  return known;
}

/// Checks the caller's struct before any work is done for it; write_struct then cannot fail.
template <class Struct>
void check_output_struct(const Struct* given, const char* name) {
  (void)read_struct(given, name);
}

/// Fills the caller's struct as far as its size reaches; struct_size itself stays as the caller set it.
template <class Struct>
void write_struct(Struct* given, const Struct& value) noexcept {
  static_assert(std::is_trivially_copyable_v<Struct>);
  constexpr std::size_t k_head = sizeof(std::uint32_t);
  std::uint32_t size;
  std::memcpy(&size, given, sizeof size);
  const std::size_t bytes = size < sizeof(Struct) ? size : sizeof(Struct);
  std::memcpy(reinterpret_cast<char*>(given) + k_head, reinterpret_cast<const char*>(&value) + k_head, bytes - k_head);
}

}  // namespace radvor::api
