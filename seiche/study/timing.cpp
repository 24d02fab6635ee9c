#include <seiche/loop/integrate.hpp>
#include <seiche/study/timing.hpp>

#include <algorithm>
#include <ctime>

namespace seiche {
namespace {

bool stopped(const TimingOptions& options) { return options.stop && options.stop->load(std::memory_order_relaxed); }

double timed_run(Simulation& simulation, double h, double t_end) {
  simulation.restart();
  const double begin = thread_cpu_seconds();
  integrate(simulation.system(), simulation.stepper(), simulation.state(), {.h = h, .t_end = t_end});
  return thread_cpu_seconds() - begin;
}

double median(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

}  // namespace

double thread_cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<double> time_runs(std::span<Simulation* const> simulations, double h, double t_end,
                              const TimingOptions& options) {
  struct Timed {
    std::vector<double> runs;
    double sum = 0;
  };
  std::vector<Timed> timed(simulations.size());
  for (Simulation* simulation : simulations) {
    double spent = 0;
    do {
      spent += timed_run(*simulation, h, std::min(t_end, 256 * h));
    } while (spent < options.warm_up_seconds && !stopped(options));
  }
  const auto needs_more = [&](const Timed& t) {
    return std::ssize(t.runs) < options.repeats || t.sum < options.seconds;
  };
  while (std::any_of(timed.begin(), timed.end(), needs_more) && !stopped(options)) {
    for (std::size_t i = 0; i < simulations.size(); ++i) {
      if (!needs_more(timed[i])) continue;
      timed[i].runs.push_back(timed_run(*simulations[i], h, t_end));
      timed[i].sum += timed[i].runs.back();
    }
  }
  std::vector<double> medians;
  for (const Timed& t : timed) medians.push_back(t.runs.empty() ? 0.0 : median(t.runs));
  return medians;
}

}  // namespace seiche
