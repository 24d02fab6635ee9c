#include <seiche/core/base/error.hpp>
#include <seiche/core/momenta.hpp>
#include <seiche/core/spectral_radius.hpp>
#include <seiche/method/splitting/momentum_form.hpp>
#include <seiche/simulation/auto_method.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

// Where the curves of time against tolerance cross (docs/performance.md, The choice of "auto"); they are flat there.
constexpr double stiff_damping = 12;  // times the rate of the solution: backward flows e^{−|a|hD} would grow
constexpr double stiff_friction =
    50;                               // times the rate of the solution: beside it exact flows of the friction cost less
constexpr double stiff_kicks = 10;    // times the rate of the solution: kicks would be bound by their stability
constexpr Index many_unknowns = 256;  // below them a transform costs no more than the differences it replaces
constexpr double faded = 20;  // γ · duration: by then exact flows take steps far beyond what is stable for kicks
constexpr double rough_tolerance = 3e-5;      // collocation above it: order four
constexpr double fine_tolerance = 3e-8;       // collocation below it: order eight
constexpr double nystrom_tolerance = 1.5e-7;  // Nyström splittings above it: order four, below it six

// Without D₀, which if it is stiff makes fast what will soon be over.
double rate_of_solution(const System& system) {
  const Vector& z = system.initial;
  Vector f(z.size()), moved(z.size()), Dz(z.size());
  const auto undamped = [&](const Vector& at, Vector& out) {
    system.right_hand_side(0, at, out);
    system.damping->apply_D0(at, Dz);
    out += Dz;
  };
  undamped(z, f);
  const auto derivative_along = [&](const Vector& direction) -> Vector {
    const double step = 1e-6 * (1 + system.space->norm(z)) / std::max(system.space->norm(direction), 1e-300);
    Vector forward(z.size()), back(z.size());
    moved = z + step * direction;
    undamped(moved, forward);
    moved = z - step * direction;
    undamped(moved, back);
    return (forward - back) / (2 * step);
  };
  const double speed = system.space->norm(f);
  if (!(speed > 0)) return 0;
  return std::sqrt(system.space->norm(derivative_along(derivative_along(f))) / speed);
}

// D = γ(t)P with P the projector on all momenta?
bool damps_momenta_alike(const Problem& problem) {
  if (problem.has_constant_damping() || problem.damping.field_rate) return false;
  if (!problem.damping.rate) return true;
  const std::optional<Momenta> p = momenta(problem);
  for (Index i = 0; p && i < problem.field_count(); ++i)
    if (problem.damping.rate_fields[static_cast<std::size_t>(i)] != (i >= p->first)) return false;
  return p.has_value();
}

// Is a solution still there at the end?
bool stays(const MethodRequest& request, const ProblemRates& rates) {
  return rates.damping == 0 || (request.duration > 0 && rates.damping * request.duration <= faded);
}

// Do kicks by all forces cost less than exact flows? The size of a step of one size is the user's, and may be beyond
// what is stable.
bool should_kick(const Problem& problem, const System& system, const MethodRequest& request,
                 const ProblemRates& rates) {
  if (!request.by_kicks || request.tolerance <= 0 || !damps_momenta_alike(problem)) return false;
  if (request.by_krylov) {
    const MomentumForm form = momentum_form(system);
    return form.separable && form.rate;
  }
  return problem.size() >= many_unknowns && rates.linear <= stiff_kicks * rates.solution && stays(request, rates);
}

std::string collocation_for(double tolerance) {
  return tolerance > rough_tolerance ? "egc4" : tolerance > fine_tolerance ? "egc6" : "egc8";
}

}  // namespace

ProblemRates rates_of(const System& system) {
  Vector Dz(system.space->size());
  const auto apply_D = [&](Vector& z) {
    system.damping->apply_D0(z, Dz);
    z.swap(Dz);
  };
  return {.linear = rate_of_linear_flow(system),
          .damping = spectral_radius(*system.space, apply_D),
          .solution = rate_of_solution(system)};
}

MethodChoice choose_method(const Problem& problem, const System& system, const MethodRequest& request,
                           const MethodOptions& options) {
  const double tolerance = request.tolerance;
  const double wanted = tolerance > 0 ? tolerance : 1e-6;
  MethodChoice choice{.method = collocation_for(wanted), .options = options, .reason = {}};
  const ProblemRates rates = rates_of(system);
  const bool is_known = std::isfinite(rates.solution);
  const std::string found =
      fmt::format("the linear part has rates up to {:.3g} and {}", rates.linear,
                  is_known ? fmt::format("the solution starts with {:.3g}", rates.solution)
                           : "the rate of the solution is not known, since the force is not finite close to the start");
  const std::string accuracy = tolerance > 0 ? fmt::format("tolerance {:g}", tolerance) : "steps of one size";
  if (problem.structure) {
    choice.reason = fmt::format("{}, since S changes with z ({})", choice.method, accuracy);
    return choice;
  }
  using enum Friction::Smoothness;
  const Friction::Smoothness smoothness = problem.friction ? problem.friction->smoothness() : smooth;
  // What turns within the solution's own pace is a smooth force to collocation, and resolved by its tolerance.
  const bool is_sharp = smoothness == sharp && problem.friction->steepness() > stiff_friction * rates.solution;
  if (is_sharp || smoothness == jump) {
    choice.method = "seisav";
    choice.reason = fmt::format("seisav, since the friction {} is no smooth force: its flow is taken exactly",
                                problem.friction->text());
    return choice;
  }
  const bool nystrom = momenta(problem) && system.damping->is_linear() && !system.force &&
                       system.damping->is_constant() && !system.damping->touches_potential();
  if (nystrom && rates.damping <= stiff_damping * rates.solution) {
    choice.method = wanted > nystrom_tolerance ? "crkn4" : "crkn6";
    if (should_kick(problem, system, request, rates)) {
      choice.options.linear = LinearTreatment::explicit_kicks;
      choice.reason =
          fmt::format("{} with linear = \"explicit\" ({}): {}; {}kicks by all forces cost least", choice.method,
                      accuracy, found,
                      request.by_krylov ? "exact flows would take Krylov spaces, and " : "nothing is stiff, and ");
      return choice;
    }
    choice.reason =
        fmt::format("{} ({}): {}; damping acts on momenta alone, where forces between exact linear flows cost least",
                    choice.method, accuracy, found);
    return choice;
  }
  if (smoothness == kink && choice.method != "egc4") {
    choice.method = "egc4";
    choice.reason = fmt::format("egc4 ({}): the friction {} has a kink at v = 0, and higher orders gain nothing",
                                accuracy, problem.friction->text());
    return choice;
  }
  choice.reason = fmt::format("{} ({}): {}{}", choice.method, accuracy, found,
                              nystrom && is_known ? "; damping so stiff must not be split into backward flows" : "");
  return choice;
}

}  // namespace seiche
