#include <seiche/core/base/error.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/study/physical_equation.hpp>
#include <seiche/study/reference.hpp>

#include <boost/numeric/odeint/integrate/integrate_times.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

namespace seiche {
namespace {

namespace odeint = boost::numeric::odeint;

// Of the smallest step: nearer times are the same time, reached by different products k h.
constexpr double same_time = 1e-6;

constexpr double most_steps = 1e10;  // of a reference by steps of one size

using Record = std::function<void(std::size_t k, std::span<const double> z)>;  // the state at the k-th time

void heed(const std::atomic<bool>* stop, double t) {
  if (stop && stop->load(std::memory_order_relaxed)) throw Error("the reference solution was interrupted at t = {}", t);
}

void check(std::span<const double> z, double t, const std::atomic<bool>* stop) {
  heed(stop, t);
  if (!std::all_of(z.begin(), z.end(), [](double x) { return std::isfinite(x); })) {
    throw Error(
        "the exact solution is no longer finite before t = {:.6g}: it blows up, and there is no reference beyond", t);
  }
}

double largest_entry(std::span<const double> z) {
  double largest = 0;
  for (const double x : z) largest = std::max(largest, std::abs(x));
  return largest;
}

// A hundredth of the time in which z changes by its size, or ż by its own along a short step of Euler.
double careful_step(const PhysicalEquation& equation, std::vector<double> z) {
  std::vector<double> rate(z.size()), later(z.size());
  equation.right_hand_side(0, z, rate);
  const double size = largest_entry(z), change = largest_entry(rate);
  if (!(size > 0 && change > 0)) return 0.01;
  const double time = size / change, short_time = 1e-6 * time;
  for (std::size_t i = 0; i < z.size(); ++i) z[i] += short_time * rate[i];
  equation.right_hand_side(short_time, z, later);
  for (std::size_t i = 0; i < z.size(); ++i) later[i] -= rate[i];
  const double bend = largest_entry(later) / (short_time * change);
  return 0.01 * (bend > 0 ? std::min(time, 1 / bend) : time);
}

// Does an explicit scheme come to an end? Looked at now and then, from the share of the time that is behind it.
class Patience {
 public:
  Patience(const PhysicalEquation& equation, double t_end, const std::atomic<bool>* stop)
      : unknowns_(static_cast<double>(equation.initial().size())), t_end_(t_end), stop_(stop) {}

  void count(double t) {
    if (++evaluations_ % look_every != 0) return;
    heed(stop_, t);
    const double expected = static_cast<double>(evaluations_) * t_end_ / t;
    if (evaluations_ >= first_estimate && !(expected * unknowns_ <= most_work))
      throw Error(
          "no reference: up to t = {:.3g} it took {} evaluations of the right-hand side, and to t = {:.6g} it would take about {:.1g}; the "
          "equation is stiff, and an explicit scheme follows its fastest rate: choose an earlier end",
          t, evaluations_, t_end_, expected);
  }

 private:
  static constexpr std::int64_t look_every = 1024, first_estimate = std::int64_t{1} << 20;
  static constexpr double most_work = 1e13;  // evaluations × unknowns: hours
  double unknowns_, t_end_;
  const std::atomic<bool>* stop_;
  std::int64_t evaluations_ = 0;
};

void fehlberg78(const Problem& problem, const std::vector<double>& times, double tolerance,
                const std::atomic<bool>* stop, const Record& record) {
  using Values = std::vector<double>;
  const PhysicalEquation equation(problem);
  auto stepper = odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<Values>());
  Values z = equation.initial();
  // A first step over a whole gap may overflow where the equation is stiff, and the controller accepts what is NaN.
  const double first_step = std::min(times[1] - times[0], careful_step(equation, z));
  Patience patience(equation, times.back(), stop);
  std::size_t k = 0;
  try {
    odeint::integrate_times(
        std::ref(stepper),
        [&](const Values& x, Values& dxdt, double t) {
          patience.count(t);
          equation.right_hand_side(t, x, dxdt);
        },
        z, times.begin(), times.end(), first_step,
        [&](const Values& x, double t) {
          check(x, t, stop);
          record(k++, x);
        });
  } catch (const odeint::odeint_error&) {
    throw Error("no reference beyond t = {:.6g}: the step size that {:g} asks for became too small, as near a blow-up",
                times[k > 0 ? k - 1 : 0], tolerance);
  }
}

void seavf(const Problem& problem, const std::vector<double>& times, double h_wanted, const std::atomic<bool>* stop,
           const Record& record) {
  if (const double steps = times.back() / h_wanted; steps > most_steps)
    throw Error("the reference by seavf at h = {:.3g} would take {:.1g} steps to t = {:.6g}; choose an earlier end",
                h_wanted, steps, times.back());
  Simulation simulation(problem, {.method = "seavf"});
  Vector values = simulation.physical();
  double h = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (k > 0) {
      const double gap = times[k] - times[k - 1];
      const double steps = std::max(1.0, std::round(gap / h_wanted));
      if (std::abs(h - gap / steps) > same_time * h_wanted) h = gap / steps;  // else round-off would need new operators
      for (double n = 0; n < steps; ++n) {
        const StepReport report = simulation.step(h);
        if (!report.solved()) throw Error("the reference by seavf failed: {}", report.message);
      }
    }
    simulation.system().space->to_physical(simulation.state().z, values);
    const std::span<const double> z(values.data(), static_cast<std::size_t>(values.size()));
    check(z, times[k], stop);
    record(k, z);
  }
}

double distance(std::span<const double> a, std::span<const double> b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace

std::vector<double> sample_times(std::span<const double> step_sizes, double t_end) {
  if (!std::isfinite(t_end) || t_end <= 0) throw Error("the end time must be finite and > 0, but it is {}", t_end);
  if (step_sizes.empty()) throw Error("there must be at least one step size");
  double smallest = t_end;
  std::vector<double> times{0.0};
  for (const double h : step_sizes) {
    if (!std::isfinite(h) || h <= 0) throw Error("the step size h must be finite and > 0, but it is {}", h);
    if (t_end / h > 1e7)
      throw Error("h = {} would take {:.3g} reference times to t = {}; 1e7 are allowed", h, t_end / h, t_end);
    smallest = std::min(smallest, h);
    for (double k = 1; k * h < t_end * (1 - same_time * h / t_end); ++k) times.push_back(k * h);
  }
  times.push_back(t_end);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end(),
                          [&](double a, double b) { return b - a <= same_time * smallest; }),
              times.end());
  return times;
}

std::size_t Reference::index_of(double t) const {
  const auto next = std::lower_bound(t_.begin(), t_.end(), t);
  const std::size_t above = std::min(static_cast<std::size_t>(next - t_.begin()), t_.size() - 1);
  const std::size_t below = above > 0 ? above - 1 : 0;
  const std::size_t k = std::abs(t_[above] - t) <= std::abs(t_[below] - t) ? above : below;
  if (std::abs(t_[k] - t) > same_time * (t_[1] - t_[0])) throw Error("the reference was not sampled at t = {:.17g}", t);
  return k;
}

Reference make_reference(const Problem& problem, const std::vector<double>& times, const ReferenceOptions& options) {
  constexpr double memory = 2e9;  // bytes
  const double bytes = 8.0 * static_cast<double>(times.size()) * static_cast<double>(problem.size());
  if (bytes > memory) {
    throw Error("the reference at {} times of {} unknowns would fill {:.1f} GB; choose a larger h or an earlier end",
                times.size(), problem.size(), bytes / 1e9);
  }
  Reference reference;
  reference.t_ = times;
  reference.size_ = static_cast<std::size_t>(problem.size());
  reference.states_.resize(times.size() * reference.size_);
  reference.energy_.resize(times.size());
  reference.potential_.resize(times.size());
  const PhysicalEquation equation(problem);
  const Record record = [&](std::size_t k, std::span<const double> z) {
    std::copy(z.begin(), z.end(), reference.states_.begin() + static_cast<std::ptrdiff_t>(k * reference.size_));
    reference.energy_[k] = equation.energy(z);
    reference.potential_[k] = equation.potential(z);
  };

  // The second trajectory takes every fourth time (and the last), hence longer steps, at a tolerance ten times as
  // large: the distance between the two is an estimate of the error of the first.
  constexpr std::size_t stride = 4;
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k + 1 < times.size(); k += stride) chosen.push_back(k);
  chosen.push_back(times.size() - 1);
  std::vector<double> coarse;
  for (const std::size_t k : chosen) coarse.push_back(times[k]);
  const Record compare = [&](std::size_t i, std::span<const double> z) {
    const std::size_t k = chosen[i];
    reference.error = std::max(reference.error, distance(z, reference.state(k)));
    reference.energy_error = std::max(reference.energy_error, std::abs(equation.energy(z) - reference.energy(k)));
  };

  if (options.kind == ReferenceKind::fehlberg78) {
    fehlberg78(problem, times, options.tolerance, options.stop, record);
    fehlberg78(problem, coarse, 10 * options.tolerance, options.stop, compare);
    reference.description =
        fmt::format("Fehlberg 7(8) of Boost.odeint at tolerance {:g}, stopping at every sample time",
                    options.tolerance);
  } else {
    seavf(problem, times, options.seavf_h, options.stop, record);
    fehlberg78(problem, coarse, options.tolerance, options.stop, compare);
    reference.description = fmt::format("SEAVF at h = {:.6g}", options.seavf_h);
  }
  reference.description +=
      fmt::format("; error ≤ {:.1e} (energy {:.1e}) by comparison with {}", reference.error, reference.energy_error,
                  options.kind == ReferenceKind::fehlberg78 ? "longer steps at a looser tolerance" : "Fehlberg 7(8)");
  return reference;
}

}  // namespace seiche
