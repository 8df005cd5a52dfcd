#pragma once

#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// GCC's sanitizers have the function, but Debian's package lacks the header.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();
#else
#include <malloc.h>
#endif

namespace castor::test {

/// What is allocated and not given back, in all threads.
inline std::size_t bytes_in_use() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return __sanitizer_get_current_allocated_bytes();
#else
  auto x = mallinfo2();
  return x.uordblks + x.hblkhd;
#endif
}

} // namespace castor::test
