#pragma once

#include <pmmintrin.h>
#include <xmmintrin.h>

namespace avoidbench {

/// Flush-to-zero and denormals-are-zero for as long as it lives, which Embree wants for its speed;
/// what was set before comes back afterwards, so that nobody else's arithmetic changes.
class ScopedFlushToZero {
 public:
  ScopedFlushToZero() : before_(_mm_getcsr()) {
    _mm_setcsr(before_ | static_cast<unsigned>(_MM_FLUSH_ZERO_ON) |
               static_cast<unsigned>(_MM_DENORMALS_ZERO_ON));
  }
  ~ScopedFlushToZero() { _mm_setcsr(before_); }
  ScopedFlushToZero(const ScopedFlushToZero&) = delete;
  ScopedFlushToZero& operator=(const ScopedFlushToZero&) = delete;

 private:
  unsigned before_;
};

}  // namespace avoidbench
