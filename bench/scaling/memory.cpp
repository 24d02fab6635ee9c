#include <bench/scaling/memory.hpp>
#include <bench/scaling/problem.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/simulation/simulation.hpp>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <exception>

namespace seiche::bench {
namespace {

int two_steps(Index points, double limit) {
  const auto most = static_cast<rlim_t>(limit);
  const rlimit address_space{most, most};
  setrlimit(RLIMIT_AS, &address_space);
  try {
    constexpr double h = 1.0 / 256;
    Simulation simulation(line_problem(points), {.method = "seisav", .backend = "modal"});
    return simulation.step(h).solved() && simulation.step(h).solved() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%ld points: %s\n", static_cast<long>(points), error.what());
    return 1;
  }
}

}  // namespace

double peak_bytes(Index points, double limit) {
  constexpr double kibibyte = 1024;
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw Error("no second process could be started");
  if (child == 0) _exit(two_steps(points, limit));
  int status = 0;
  rusage used{};
  if (wait4(child, &status, 0, &used) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error("two steps on {} points were not possible within {:.3g} bytes", points, limit);
  return static_cast<double>(used.ru_maxrss) * kibibyte;
}

double spare_memory() {
  constexpr double part = 0.9;
  return part * static_cast<double>(sysconf(_SC_AVPHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

}  // namespace seiche::bench
