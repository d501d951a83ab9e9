// The floating-point environment that radvor's numbers rely on, set for a scope and given back after it.
#pragma once

#include <cfenv>
#include <cstdint>

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace radvor {

enum class Denormals { keep, flush };

/// Round-to-nearest, no traps, denormals kept (entry points, exact predicates) or flushed (workers, as Embree
/// recommends); the caller's environment comes back at the end of the scope.
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
#if defined(__SSE2__) || defined(_M_X64)
    constexpr unsigned k_flush = 0x8040;  // FTZ | DAZ; glibc's fesetenv restores all of MXCSR
    const unsigned control = _mm_getcsr() & ~k_flush;
    _mm_setcsr(denormals == Denormals::flush ? control | k_flush : control);
#elif defined(__aarch64__)
    constexpr std::uint64_t k_flush = std::uint64_t{1} << 24;  // FPCR.FZ
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

}  // namespace radvor
