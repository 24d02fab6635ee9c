#include <seiche/config/auto_method.hpp>
#include <seiche/core/error.hpp>
#include <seiche/core/momenta.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace seiche {
namespace {

// Some of the numbers below are crossings of measured curves, which are flat: a factor of two in them is a few per cent of time.
constexpr double stiff = 12;  // beyond so many times the rate of the solution explicit kicks go by stability
constexpr double rough_tolerance = 3e-5;  // above: order four
constexpr double fine_tolerance = 3e-8;   // below: order eight
constexpr double sharp_friction = 30;     // of slopes at small and at typical velocities: no smooth force

Vector random_state(const System& system) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Vector values(system.space->physical_size());
  for (double& x : values) x = normal(random);
  Vector z(system.space->size());
  system.space->from_physical(values, z);
  return z;
}

// L has eigenvalues in pairs ±iω: the growth over two applications.
double spectral_radius(const System& system) {
  constexpr int pairs = 20;
  Vector z = random_state(system), Mz(z.size()), Dz(z.size()), rest(z.size());
  const auto apply_L = [&] {
    system.damping->apply(0, z, Dz);
    system.damping->apply_rest(0, z, rest);
    system.linear->apply_M(z, Mz);
    system.linear->apply_S(Mz, z);
    z -= Dz - rest;
  };
  double growth = 0;
  for (int k = 0; k < pairs; ++k) {
    const double before = z.norm();
    if (!(before > 0)) return 0;
    z /= before;
    apply_L();
    apply_L();
    growth = std::sqrt(z.norm());
  }
  return growth;
}

double rate_of_solution(const System& system) {
  const Vector& z = system.initial;
  Vector f(z.size()), moved(z.size());
  system.right_hand_side(0, z, f);
  const auto derivative_along = [&](const Vector& direction) -> Vector {
    const double step = 1e-6 * (1 + z.norm()) / std::max(direction.norm(), 1e-300);
    Vector forward(z.size()), back(z.size());
    moved = z + step * direction;
    system.right_hand_side(0, moved, forward);
    moved = z - step * direction;
    system.right_hand_side(0, moved, back);
    return (forward - back) / (2 * step);
  };
  const double speed = f.norm();
  if (!(speed > 0)) return 0;
  return std::sqrt(derivative_along(derivative_along(f)).norm() / speed);
}

// Does R change its slope at once, as dry friction does, or one that saturates?
bool is_sharp(const Friction& friction) {
  const auto slope = [&](double v) {
    const double u = 0;
    double r = 0;
    friction.force(0, {&u, 1}, {&v, 1}, {&r, 1});
    return std::abs(r / v);
  };
  const double far = slope(1.0);
  return far > 0 && slope(1e-3) > sharp_friction * far;
}

bool exists(std::string_view name) {
  const std::vector<std::string> names = method_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string collocation_for(double tolerance) {
  return tolerance > rough_tolerance ? "egc4" : tolerance > fine_tolerance ? "egc6" : "egc8";
}

}  // namespace

ProblemRates rates_of(const System& system) {
  return {.linear = spectral_radius(system), .solution = rate_of_solution(system)};
}

MethodChoice choose_method(const Problem& problem, const System& system, double tolerance,
                           const MethodOptions& options) {
  const double wanted = tolerance > 0 ? tolerance : 1e-6;
  MethodChoice choice{.method = collocation_for(wanted), .options = options, .reason = {}};
  const ProblemRates rates = rates_of(system);
  const std::string seen = fmt::format("the linear part has rates up to {:.3g} and the solution starts with {:.3g}",
                                       rates.linear, rates.solution);
  const std::string accuracy = tolerance > 0 ? fmt::format("tolerance {:g}", tolerance) : "steps of one size";
  if (problem.structure) {
    choice.reason = fmt::format("{}, since S changes with z ({})", choice.method, accuracy);
    return choice;
  }
  if (problem.friction && is_sharp(*problem.friction)) {
    choice.method = "seisav";
    choice.reason = fmt::format("seisav, since the friction {} is no smooth force: its flow is taken exactly",
                                problem.friction->text());
    return choice;
  }
  const std::optional<Momenta> p = momenta(problem);
  const bool nystrom = exists("crkn6") && p && system.damping->is_linear() && !system.force &&
                       system.damping->is_frozen() && !system.damping->touches_potential();
  if (nystrom && rates.stiffness() <= stiff) {
    choice.method = wanted > 1e-4 ? "crkn4" : "crkn6";
    choice.reason = fmt::format("{} ({}): {}, which is not stiff", choice.method, accuracy, seen);
    return choice;
  }
  choice.reason = fmt::format("{} ({}): {}{}", choice.method, accuracy, seen,
                              rates.stiffness() > stiff ? ", which is stiff: L goes into exponentials" : "");
  return choice;
}

}  // namespace seiche
