#include <bench/work_precision/measure.hpp>
#include <seiche/core/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace seiche::bench {
namespace {

constexpr double all_repeats_below = 0.1;      // seconds
constexpr double several_repeats_below = 0.5;  // above it one run is enough to see a difference
constexpr double enough_seconds = 0.005;       // of short runs, however many that takes …
constexpr std::size_t most_repeats = 99;       // … up to so many

// Of all threads, so that none could work for free.
double process_cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

// What two readings of the clock cost by themselves: it is a system call.
double clock_seconds() {
  static const double seconds = [] {
    std::vector<double> empty;
    for (int i = 0; i < 999; ++i) {
      const double begin = process_cpu_seconds();
      empty.push_back(process_cpu_seconds() - begin);
    }
    return median(empty);
  }();
  return seconds;
}

double timed_advance(Run& run, double t, std::string& failure) {
  const double begin = process_cpu_seconds();
  failure = run.advance(t);
  return std::max(process_cpu_seconds() - begin - clock_seconds(), 1e-9);
}

// Rises of one energy, as loop/energy_book judges them: against the round-off of all steps since the last reading.
class Rises {
 public:
  void add(double value, double round_off, std::int64_t steps) {
    const auto between = static_cast<double>(std::max<std::int64_t>(steps - last_steps_, 1));
    if (readings_ > 0 && value - last_ > std::max(round_off, last_round_off_) * between) ++rises_;
    last_ = value;
    last_round_off_ = round_off;
    last_steps_ = steps;
    ++readings_;
  }
  std::int64_t count() const { return rises_; }
  std::int64_t readings() const { return readings_; }

 private:
  double last_ = 0;
  double last_round_off_ = 0;
  std::int64_t last_steps_ = 0;
  std::int64_t rises_ = 0;
  std::int64_t readings_ = 0;
};

// After every step of h where that is affordable, otherwise at every so many; adaptive integrators stop at 200 times.
std::int64_t output_count(const Row& row, const Equation& equation) {
  constexpr std::int64_t adaptive = 200;
  if (row.sweep == Sweep::tolerance) return adaptive;
  const std::int64_t steps = std::llround(equation.t_end / row.parameter);
  const auto affordable =
      std::clamp<std::int64_t>(4'000'000 / static_cast<std::int64_t>(equation.size()), adaptive, 4000);
  return std::min(steps, affordable);
}

void watch_energy(const Subject& subject, Contestant& c, double cap_seconds) {
  const Equation& equation = subject.test.equation;
  const std::int64_t outputs = output_count(c.row, equation);
  const std::int64_t steps = c.row.sweep == Sweep::step_size ? std::llround(equation.t_end / c.row.parameter) : 0;
  std::vector<double> z(equation.size());
  Rises rises, own;
  double spent = 0;
  c.run->restart();
  for (std::int64_t i = 0; i <= outputs; ++i) {
    double t = equation.t_end * static_cast<double>(i) / static_cast<double>(outputs);
    if (steps > 0) t = static_cast<double>(i * steps / outputs) * c.row.parameter;
    std::string failure;
    if (i > 0) spent += timed_advance(*c.run, t, failure);
    c.run->values(z);
    const double energy = subject.judge.energy(z);
    if (failure.empty() && !std::isfinite(energy)) failure = "not finite";
    if (!failure.empty()) {
      c.row.status = Status::failed;
      c.row.message = fmt::format("at t = {:.4g}: {}", t, failure);
      break;
    }
    const std::int64_t taken = std::max<std::int64_t>(c.run->work().steps, i);
    rises.add(energy, std::max(subject.judge.energy_round_off(z), c.run->energy_round_off()), taken);
    if (const auto reading = c.run->own_energy()) own.add(reading->value, reading->round_off, taken);
    if (spent > 1.5 * cap_seconds && i < outputs) {
      c.row.status = Status::skipped;
      c.row.message = fmt::format("takes about {:.2g} s, more than the cap of {:.2g} s",
                                  spent * static_cast<double>(outputs) / static_cast<double>(i), cap_seconds);
      break;
    }
  }
  c.row.energy_points = rises.readings();
  c.row.energy_rises = rises.count();
  c.row.own_rises = own.readings() > 0 ? own.count() : -1;
}

// Alone and in one go, as the timed runs are.
void integrate_once(const Subject& subject, Contestant& c) {
  std::vector<double> z(subject.test.equation.size());
  std::string failure;
  c.run->restart();
  const double seconds = timed_advance(*c.run, subject.test.equation.t_end, failure);
  c.run->values(z);
  c.row.work = c.run->work();
  c.row.energy_error = std::abs(subject.judge.energy(z) - subject.reference.energy);
  if (failure.empty() && !std::isfinite(c.row.energy_error)) failure = "not finite";
  if (!failure.empty()) {
    c.row.status = Status::failed;
    c.row.message = failure;
    return;
  }
  c.row.error = 0;
  for (std::size_t i = 0; i < z.size(); ++i)
    c.row.error = std::max(c.row.error, std::abs(z[i] - subject.reference.z[i]));
  c.row.cpu_seconds = seconds;
  if (seconds > several_repeats_below) c.seconds.push_back(seconds);  // otherwise it was the warm-up
}

}  // namespace

Contestant examine(const Subject& subject, const Peer& peer, double parameter, double cap_seconds) {
  Contestant c{.row = {.problem = subject.test.key,
                       .peer = peer.name,
                       .library = peer.library,
                       .origin = peer.origin,
                       .sweep = peer.sweep,
                       .parameter = parameter},
               .run = nullptr};
  try {
    const double begin = process_cpu_seconds();
    c.run = peer.make(subject.test.equation, parameter);
    c.row.setup_seconds = process_cpu_seconds() - begin;
    watch_energy(subject, c, cap_seconds);
    if (c.row.status == Status::solved) integrate_once(subject, c);
  } catch (const Error& error) {
    c.row.status = Status::failed;
    c.row.message = error.what();
  }
  return c;
}

int timed_runs(double seconds, int repeats) {
  constexpr int several = 3;
  if (seconds > several_repeats_below) return 1;
  return seconds > all_repeats_below ? std::min(several, repeats) : repeats;
}

void time_in_turn(std::vector<Contestant>& contestants, double t_end, int repeats) {
  const auto needs_more = [&](const Contestant& c) {
    if (c.row.status != Status::solved) return false;
    double sum = 0;
    for (const double seconds : c.seconds) sum += seconds;
    return std::ssize(c.seconds) < timed_runs(c.row.cpu_seconds, repeats) ||
           (sum < enough_seconds && c.seconds.size() < most_repeats);
  };
  while (std::any_of(contestants.begin(), contestants.end(), needs_more)) {
    for (Contestant& c : contestants) {
      if (!needs_more(c)) continue;
      std::string failure;
      c.run->restart();
      c.seconds.push_back(timed_advance(*c.run, t_end, failure));
    }
  }
  for (Contestant& c : contestants) {
    if (c.row.status != Status::solved) continue;
    c.row.cpu_seconds = median(c.seconds);
    c.row.repeats = static_cast<int>(c.seconds.size());
  }
}

}  // namespace seiche::bench
