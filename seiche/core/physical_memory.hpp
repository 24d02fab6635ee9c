// What this machine has, so that what would not fit is refused before anything is allocated.
#pragma once

#include <unistd.h>

namespace seiche {

inline double physical_memory() {  // bytes
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

}  // namespace seiche
