// How much of its memory a program has asked for and not given back. What the system says to be resident depends on the
// allocator, on what other programs do, and on when it is asked.
#pragma once

#include <cstddef>

#if defined(SEICHE_SANITIZED)
#include <sanitizer/allocator_interface.h>
#else
#include <malloc.h>
#endif

namespace seiche::test {

inline std::ptrdiff_t bytes_in_use() {
#if defined(SEICHE_SANITIZED)
  return static_cast<std::ptrdiff_t>(__sanitizer_get_current_allocated_bytes());
#else
  const struct mallinfo2 info = mallinfo2();
  return static_cast<std::ptrdiff_t>(info.uordblks + info.hblkhd);
#endif
}

}  // namespace seiche::test
