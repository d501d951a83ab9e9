// Random numbers that are hashes of what they are for, so that they do not depend on threads or order.
#pragma once

#include <cstdint>

namespace radvor {

/// Finaliser of MurmurHash3 in Stafford's variant 13: every bit of the input reaches every bit of the output.
inline std::uint64_t mix(std::uint64_t value) {
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
  return value ^ (value >> 31);
}

inline std::uint64_t hash(std::uint64_t a, std::uint64_t b) {
  return mix(mix(a + 0x9e3779b97f4a7c15u) ^ b);
}

template <class... More>
std::uint64_t hash(std::uint64_t a, std::uint64_t b, More... more) {
  return hash(hash(a, b), static_cast<std::uint64_t>(more)...);
}

/// Uniform in [0, 1), 53 bits.
inline double to_unit(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

}  // namespace radvor
