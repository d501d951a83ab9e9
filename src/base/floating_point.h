// The floating-point environment that radvor's numbers rely on, set for a scope and given back after it.
#pragma once

#include <cfenv>
#include <cstdint>

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace radvor {

enum class Denormals { keep, flush };

#if defined(__SSE2__) || defined(_M_X64)

/// Round-to-nearest, no traps, denormals kept (entry points, exact predicates) or flushed (workers, as Embree
/// recommends); the caller's environment, sticky flags included, comes back at the end of the scope.
/// Only MXCSR is touched: nothing here computes on the x87 unit, and saving that one costs 190 ns a scope, where
/// reading MXCSR and writing it only if it differs costs 2, which matters to calls that insert one point.
class FloatingPointGuard {
 public:
  explicit FloatingPointGuard(Denormals denormals) noexcept : caller_(_mm_getcsr()) {
    const unsigned ours = k_nearest_without_traps | (denormals == Denormals::flush ? k_flush : 0u);
    if ((caller_ & ~k_sticky_flags) != ours) {
      _mm_setcsr(ours);
    }
    keep_order();
  }
  ~FloatingPointGuard() {
    keep_order();
    if (_mm_getcsr() != caller_) {
      _mm_setcsr(caller_);
    }
  }
  FloatingPointGuard(const FloatingPointGuard&) = delete;
  FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;

 private:
  static constexpr unsigned k_sticky_flags = 0x003f;
  static constexpr unsigned k_nearest_without_traps = 0x1f80;
  static constexpr unsigned k_flush = 0x8040;  // FTZ | DAZ

  // Compilers take arithmetic for independent of MXCSR; what is read from memory stays on this side of it.
  static void keep_order() noexcept {
#if defined(__GNUC__)
    __asm__ volatile("" ::: "memory");
#endif
  }

  unsigned caller_;
};

#else

/// As above, by the C library; denormals are flushed where the architecture is known here.
class FloatingPointGuard {
 public:
  explicit FloatingPointGuard(Denormals denormals) noexcept {
    std::feholdexcept(&caller_);
    std::fesetround(FE_TONEAREST);
    set(denormals);
  }
  ~FloatingPointGuard() { std::fesetenv(&caller_); }
  FloatingPointGuard(const FloatingPointGuard&) = delete;
  FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;

 private:
  static void set(Denormals denormals) noexcept {
#if defined(__aarch64__)
    constexpr std::uint64_t k_flush = std::uint64_t{1} << 24;  // FPCR.FZ; glibc's fesetenv restores all of FPCR
    std::uint64_t control;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control));
    control = denormals == Denormals::flush ? control | k_flush : control & ~k_flush;
    __asm__ volatile("msr fpcr, %0" : : "r"(control));
#else
    (void)denormals;
#endif
  }

  std::fenv_t caller_;
};

#endif

}  // namespace radvor
