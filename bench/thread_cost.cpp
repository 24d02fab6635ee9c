// What two threads gain on an idle machine, and what they lose where every core has another program to run as well: a
// step on one thread and on two, in turns, in wall-clock time.
#include <seiche/damping/rates.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/simulation/simulation.hpp>

#include <benchmark/benchmark.h>

#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace seiche;

// A process on each core that does nothing but compute.
class Competitors {
 public:
  explicit Competitors(unsigned count) {
    for (unsigned core = 0; core < count; ++core) {
      const pid_t child = fork();
      if (child == 0) compute_on(core);
      if (child > 0) processes_.push_back(child);
    }
  }
  ~Competitors() {
    for (const pid_t process : processes_) kill(process, SIGKILL);
    for (const pid_t process : processes_) waitpid(process, nullptr, 0);
  }
  Competitors(const Competitors&) = delete;
  Competitors& operator=(const Competitors&) = delete;

 private:
  [[noreturn]] static void compute_on(unsigned core) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(core, &only);
    sched_setaffinity(0, sizeof only, &only);
    for (double x = 0;;) benchmark::DoNotOptimize(x += 1);
  }
  std::vector<pid_t> processes_;
};

double seconds_of_step(Simulation& simulation, int times) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  for (int i = 0; i < times; ++i) simulation.step(1.0 / 256);
  return std::chrono::duration<double>(Clock::now() - begin).count() / times;
}

void thread_cost(benchmark::State& state, const std::vector<Index>& points, bool is_busy) {
  constexpr int rounds = 15;
  constexpr double seconds_per_round = 0.1;  // many slices of the scheduler
  const Problem problem = klein_gordon({.grid = {.points = points, .length = {0.1 * static_cast<double>(points[0])}},
                                        .alpha = 1.0,
                                        .gamma = constant_rate(0.1)});
  const auto on_threads = [](int threads) {
    return SimulationOptions{.method = "seisav",
                             .backend = "modal",
                             .backend_options = {.measure_plans = true, .threads = threads}};
  };
  std::array<Simulation, 2> simulations = {Simulation(problem, on_threads(1)), Simulation(problem, on_threads(2))};
  const Competitors competitors(is_busy ? std::max(1U, std::thread::hardware_concurrency()) : 0);
  std::vector<double> median;
  for (auto _ : state) {
    std::vector<std::vector<double>> taken(simulations.size());
    seconds_of_step(simulations[0], 1);  // warm
    const double once = seconds_of_step(simulations[0], 2);
    const int times = static_cast<int>(std::max(1.0, seconds_per_round / once));
    for (int round = 0; round < rounds; ++round)
      for (std::size_t i = 0; i < simulations.size(); ++i) taken[i].push_back(seconds_of_step(simulations[i], times));
    median.clear();
    for (std::vector<double>& list : taken) {
      std::nth_element(list.begin(), list.begin() + rounds / 2, list.end());
      median.push_back(list[rounds / 2]);
    }
    state.SetIterationTime(median[1]);
  }
  const auto size = static_cast<double>(problem.grid.unknowns());
  state.counters["one_ns"] = 1e9 * median[0] / size;  // per point
  state.counters["two_ns"] = 1e9 * median[1] / size;
  state.counters["one/two"] = median[0] / median[1];
}

[[maybe_unused]] const bool registered = [] {
  struct Size {
    std::string name;
    std::vector<Index> points;
  };
  for (const bool is_busy : {false, true})
    for (const Size& size :
         {Size{"256x256", {256, 256}}, Size{"1024x1024", {1024, 1024}}, Size{"128x128x128", {128, 128, 128}}})
      benchmark::RegisterBenchmark((std::string(is_busy ? "threads/busy/" : "threads/idle/") + size.name).c_str(),
                                   thread_cost, size.points, is_busy)
          ->UseManualTime()
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
