// How much memory there is, so that what would not fit is refused before anything is allocated.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace seiche {

// How many processes of one run are on this machine, and share its memory. Set before they begin to compute.
inline int& processes_on_machine() {
  static int count = 1;
  return count;
}

// Bytes: this process's part of what the machine has, or what is left of a limit that the shell has set (ulimit -v).
inline double memory_limit() {
  const auto page = static_cast<double>(sysconf(_SC_PAGE_SIZE));
  const double of_machine = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * page / processes_on_machine();
  ::rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return of_machine;
  double pages = 0;  // that this process has already
  std::ifstream("/proc/self/statm") >> pages;
  return std::min(of_machine, std::max(static_cast<double>(limit.rlim_cur) - pages * page, 0.0));
}

}  // namespace seiche
