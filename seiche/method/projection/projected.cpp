#include <seiche/core/base/error.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/method/projection/energy_interval.hpp>
#include <seiche/method/projection/projected.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

constexpr int max_halvings = 8;
constexpr int max_strict_halvings = 4;  // of parts that take as much work as the whole

}  // namespace

Projected::Projected(const System& system, const PhiEvaluator& phi, BaseStep& base, EnergyLaw law)
    : system_(system),
      phi_(phi),
      base_(base),
      law_(law),
      may_flow_freely_(!system.force && system.damping->is_linear()),
      feeds_(phi.dissipation().is_quadratic && !phi.dissipation().is_nonnegative),
      rests_(system.damping->is_zero() && is_gradient_flow(system)),
      projection_(system, phi),
      rate_(system),
      free_(cached_step_sizes(system.space->size_of_all())),
      z_(Vector::Zero(system.space->size())) {
  saved_.z = z_;
}

void Projected::read_energy(State& s) const {
  const EnergyTerms terms = system_.energy_terms(s.z);
  s.energy = terms.sum();
  s.energy_terms = terms.quadratic.magnitude + terms.potential.magnitude;
}

void Projected::begin(State& s) {
  read_energy(s);
  if (law_ == EnergyLaw::interval && base_.dissipation_kind() != StepDissipation::Kind::none)
    rate_.largest(s.t, 0, s.z, s.z);                            // allocates now
  if (law_ != EnergyLaw::none) phi_.without_casimirs(s.z, z_);  // so may this
  if (!std::isfinite(s.energy))
    throw Error("the energy of the initial state is not a finite number (H = {})", number_text(s.energy));
}

EnergyReading Projected::energy(const State& s) const {
  EnergyReading reading;
  const EnergyTerms terms = system_.energy_terms(s.z);
  reading.H = reading.modified = terms.sum();
  reading.round_off = reading.modified_round_off = terms.round_off();
  reading.size = terms.size();
  return reading;
}

StepReport Projected::step(State& s, double h) {
  StepReport report;
  const double t = s.t;
  const std::int64_t n = s.n;
  prepare(h);
  const bool parts_first = law_ != EnergyLaw::none && base_.may_be_solved_in_parts();
  Taken taken = take(s, t, h, parts_first, report);
  if (taken == Taken::unresolved && law_ == EnergyLaw::none) {
    fail(report, s, h, taken, 0);
    return report;
  }
  if (taken != Taken::whole) {
    saved_ = s;
    const StepReport attempted = report;
    const auto take_parts = [&](bool strict) {
      report.halved = take_halves(s, t, h, 1, strict, report) ? 1 : 0;
      if (report.halved > 0) return true;
      s = saved_;
      report = attempted;
      return false;
    };
    const bool taken_in_parts = parts_first && take_parts(true);
    if (parts_first && !taken_in_parts) taken = take(s, t, h, false, report);
    if (!taken_in_parts && taken != Taken::whole && !take_parts(false)) {
      fail(report, s, h, taken, max_halvings);
      return report;
    }
  }
  s.n = n + 1;
  s.t = t + h;
  return report;
}

StepReport Projected::attempt(State& s, double h) {
  StepReport report;
  const Taken taken = take(s, s.t, h, true, report);
  if (taken != Taken::whole) {
    fail(report, s, h, taken, 0);
    return report;
  }
  ++s.n;
  s.t += h;
  return report;
}

void Projected::undo(State& s) {
  s.z.swap(z_);
  s.energy = last_.energy;
  s.energy_terms = last_.energy_terms;
  s.t = last_.t;
  --s.n;
}

void Projected::keep_between(const State& s, Vector& z) {
  if (law_ == EnergyLaw::none || last_.gained) return;  // H may rise between: no law to keep
  const double low = std::min(s.energy, last_.energy);
  const double computed = projection_.measure(z);
  projection_.project(z,
                      {.H = std::clamp(computed, low, last_.energy), .cap = last_.energy, .terms = last_.energy_terms});
}

void Projected::fail(StepReport& report, const State& s, double h, Taken taken, int halvings) const {
  report.status = StepReport::Status::failed;
  if (taken == Taken::unresolved)
    report.message = fmt::format("{} in the step from t = {:.6g} with h = {:.6g}{}", base_.failure(), s.t, h,
                                 halvings > 0 ? fmt::format(", nor in {} halvings of it", halvings) : "");
  else
    report.message = fmt::format(
        "no point near the solution has an energy H ≤ {:.9g} in the step from t = {:.6g} with h = {:.6g}{}: H(0) = {}",
        s.energy, s.t, h, halvings > 0 ? fmt::format(", nor after {} halvings of it", halvings) : "",
        number_text(projection_.energy_of_rest(), 6));
}

// One step; s stays as it was where it is not taken. t and n are the caller's.
Projected::Taken Projected::take(State& s, double t, double h, bool strict, StepReport& report) {
  if (law_ == EnergyLaw::none) return take_without_law(s, t, h, report);
  const bool is_solution = base_.compute(s, t, h, z_);  // propose ẑ
  report.fallbacks += base_.fallbacks();
  if (is_solution) {
    const double computed = projection_.measure(z_, base_.potential_energy(z_));    // Ĥ = H(ẑ)
    const StepDissipation::Amount amount = measure_dissipation(s, t, h, computed);  // D, its doubt u: (E3)
    const EnergyTarget target = choose_energy(s, t, h, computed, amount);           // E*: (E4)
    const EnergyProjection::Outcome outcome = projection_.project(z_, target);  // zⁿ⁺¹ with H(zⁿ⁺¹) = E*: (E5)
    if (std::isfinite(outcome.terms) && !has_grown_beyond_reason(outcome, s, t, h))
      return end_with(s, t, h, &target, amount, outcome, report);
  }
  if (strict || !may_flow_freely_) return Taken::unresolved;
  const std::optional<EnergyProjection::Outcome> outcome = flow_freely(s, h);
  if (!outcome) return Taken::unresolved;
  ++report.fallbacks;
  return end_with(s, t, h, nullptr, {}, *outcome, report);
}

// With z_ in the place of s.z, where it has an energy that the law allows. target: of ẑ; null: z_ is another solution.
Projected::Taken Projected::end_with(State& s, double t, double h, const EnergyTarget* target,
                                     const StepDissipation::Amount& amount, const EnergyProjection::Outcome& outcome,
                                     StepReport& report) {
  const bool resolved = target != nullptr;
  report.scalar_iterations += outcome.iterations;
  report.fallbacks += outcome.by_bisection ? 1 : 0;
  if (!outcome.admissible || !std::isfinite(outcome.terms)) return Taken::inadmissible;
  if (!resolved)
    note_replaced(report, s, base_.failure());
  else if (base_.moved_far() || projection_.moved_far(outcome, z_))
    note_replaced(
        report, s,
        "what the scheme gave was moved by more than a tenth of its length to have an energy that the law allows");
  // Of a gradient flow that says nothing: what has come to rest dissipates less than round-off shows.
  if (resolved && target->widened && !rests_) report.widened = 1;
  commit(s, t, h, resolved, amount, outcome, report);
  return Taken::whole;
}

// Now: later steps of this length are to allocate nothing.
void Projected::prepare(double h) {
  if (law_ == EnergyLaw::none) return;
  if (may_flow_freely_) free_map(h);
  if (law_ == EnergyLaw::interval) base_.prepare_flow(h);
}

// The guard asks whether H may rise, and a nonnegative form says no.
StepDissipation::Amount Projected::measure_dissipation(const State& s, double t, double h, double computed) {
  const StepDissipation::Kind kind = base_.dissipation_kind();
  const bool asked = law_ == EnergyLaw::interval || kind == StepDissipation::Kind::general || keeps_ledger_;
  StepDissipation::Amount amount = asked && kind != StepDissipation::Kind::none
                                       ? base_.dissipated(s, t, h, z_, computed)
                                       : StepDissipation::Amount();
  // What is looked at node by node may be missed where steps do not resolve the flow. Gains below round-off H cannot
  // show.
  amount.negative = feeds_ || (amount.negative && amount.gain > 16 * epsilon * s.energy_terms);
  return amount;
}

EnergyTarget Projected::choose_energy(const State& s, double t, double h, double computed,
                                      const StepDissipation::Amount& amount) {
  EnergyTarget target = energy_target(
      law_, s.energy, computed, projection_.energy_of_rest(), amount, base_.dissipation_kind(),
      [&] { return h * rate_.largest(t, h, s.z, z_); }, [&] { return base_.flow_missed(s, h); });
  target.terms = s.energy_terms;
  return target;
}

// z_ ← e^{hL}z, with an energy of at most Hⁿ; nothing where that is not finite.
std::optional<EnergyProjection::Outcome> Projected::flow_freely(const State& s, double h) {
  free_map(h).apply(s.z, {}, {&z_, 1});
  if (!system_.space->is_finite(z_)) return std::nullopt;
  const bool conserves = base_.dissipation_kind() == StepDissipation::Kind::none;
  const double computed = projection_.measure(z_);
  return projection_.project(z_, {.H = conserves ? s.energy : std::min(computed, s.energy),
                                  .cap = s.energy,
                                  .terms = s.energy_terms});
}

const PhiMap& Projected::free_map(double h) {
  return free_.at(h, [&] { return phi_.map({.rows = {PhiRow{}}, .outputs = PhiRows::Outputs::all}, h); });
}

// Are |½ẑᵀMẑ| and |V(ẑ)| more than the terms of Hⁿ and what the force N gives z from rest within the step explain? s is
// still as it was before the step.
bool Projected::has_grown_beyond_reason(const EnergyProjection::Outcome& outcome, const State& s, double t, double h) {
  constexpr double growth = EnergyProjection::gross_growth;
  if (outcome.values <= growth * s.energy_terms) return false;
  if (!force_) force_ = std::make_unique<NonlinearForce>(system_, PhiRows::Forces::states);
  Vector push = s.z;
  force_->evaluate(t, push);
  push *= h;
  if (system_.force) system_.force->impulse(t, h, push);
  const ValueAndMagnitude pushed = system_.linear->quadratic(push);
  return !(outcome.values <= growth * (s.energy_terms + pushed.magnitude));
}

// s is still as it was before the step, and z_ what it is to become.
void Projected::note_replaced(StepReport& report, const State& s, std::string_view why) const {
  constexpr double least = 0.1;
  const bool lost_state = system_.space->squared_norm(z_) < square(least) * system_.space->squared_norm(s.z);
  report.replaced = {.count = 1,
                     .lost_state = report.replaced.lost_state || lost_state,
                     .why = why,
                     .remedy = base_.remedy()};
}

Projected::Taken Projected::take_without_law(State& s, double t, double h, StepReport& report) {
  const bool resolved = base_.compute(s, t, h, z_);
  report.fallbacks += base_.fallbacks();
  if (!resolved) return Taken::unresolved;
  StepDissipation::Amount amount;
  EnergyProjection::Outcome outcome;
  if (keeps_ledger_) {
    s.energy = system_.energy(s.z);
    outcome.H = outcome.computed = system_.energy(z_);
    if (base_.dissipation_kind() != StepDissipation::Kind::none) amount = base_.dissipated(s, t, h, z_, outcome.H);
  }
  commit(s, t, h, true, amount, outcome, report);
  return Taken::whole;
}

void Projected::commit(State& s, double t, double h, bool resolved, const StepDissipation::Amount& amount,
                       const EnergyProjection::Outcome& outcome, StepReport& report) {
  base_.accept(s, h, {.resolved = resolved, .factor = resolved ? outcome.factor : 0});
  const double asked = std::abs(outcome.computed - outcome.H);
  const double blurred = outcome.displacement > 0 ? std::min(1.0, outcome.loss / asked) : 0;
  last_.t = t;
  last_.energy = s.energy;
  last_.energy_terms = s.energy_terms;
  last_.displacement = outcome.displacement;
  last_.blur = blurred * outcome.displacement;
  last_.gained = amount.negative;
  s.energy = outcome.H;
  s.energy_terms = outcome.terms;
  report.ledger += {.work = amount.work,
                    .damping_left = -(amount.fine + amount.work),
                    .substep = outcome.computed - last_.energy + amount.fine,
                    .projection = outcome.H - outcome.computed};
  s.z.swap(z_);
}

// The same time in two steps, or more where that does not help either. Strict ones are all solved, and the next step
// may begin with what the last of them leaves.
bool Projected::take_halves(State& s, double t, double h, int depth, bool strict, StepReport& report) {
  if (depth > (strict ? max_strict_halvings : max_halvings)) return false;
  ++report.fallbacks;
  s.history_h = 0;
  for (const double begin : {t, t + h / 2}) {
    if (!strict) s.history_h = 0;
    prepare(h / 2);
    if (take(s, begin, h / 2, strict, report) != Taken::whole &&
        !take_halves(s, begin, h / 2, depth + 1, strict, report))
      return false;
  }
  if (!strict) s.history_h = 0;
  return true;
}

}  // namespace seiche
