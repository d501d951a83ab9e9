// A fuzzer's bytes as a stream of small choices; past the end everything is 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace radvor::fuzz {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool empty() const { return left_ == 0; }

  std::uint8_t byte() {
    if (left_ == 0) {
      return 0;
    }
    --left_;
    return *data_++;
  }

  /// 0 to count - 1; count at most 256.
  std::uint32_t below(std::uint32_t count) { return byte() % count; }

  bool chance(std::uint32_t one_in) { return below(one_in) == one_in - 1; }

  /// The bits as they come: denormals, infinities and NaNs too.
  template <class Number>
  Number raw() {
    std::uint8_t bytes[sizeof(Number)];
    for (std::uint8_t& each : bytes) {
      each = byte();
    }
    Number number;
    std::memcpy(&number, bytes, sizeof number);
    return number;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace radvor::fuzz
