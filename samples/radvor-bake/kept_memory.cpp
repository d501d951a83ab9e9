#include "kept_memory.h"

#include <limits>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace bake {

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int k_at_once = 64 << 20;           // bytes taken from the system when there are too few
  constexpr int k_most_before_2_34 = 32 << 20;  // of the threshold, in older versions of glibc
  constexpr int k_never = std::numeric_limits<int>::max();
  if (mallopt(M_MMAP_THRESHOLD, k_never) == 0) {
    mallopt(M_MMAP_THRESHOLD, k_most_before_2_34);
  }
  mallopt(M_TRIM_THRESHOLD, k_never);
  mallopt(M_TOP_PAD, k_at_once);
#endif
}

}  // namespace bake
