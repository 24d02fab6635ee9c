#include <seiche/method/projection/energy_projection.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

constexpr int max_secants = 8;
constexpr double max_lambda = 0.9;
constexpr int max_bisections = 60;
constexpr double blurred = 1e-13;     // moves relative to z that round-off in H may ask for
constexpr double least_slope = 0.05;  // relative to its terms: below, H hardly changes along the line

// By how much H may pass the cap: its round-off at a point, but for points whose energies have grown beyond reason. The
// terms alone may grow by much, where a mean drifts and ½zᵀMz sees none of it.
double slack(const EnergyLine::Parts& parts, const EnergyTarget& aim) {
  const double most = EnergyProjection::gross_growth * aim.terms;
  const bool grown = most > 0 && !(parts.values() <= most);  // at rest nothing has a size yet
  return grown ? std::min(parts.loss(), 16 * epsilon * most) : parts.loss();
}

}  // namespace

EnergyProjection::EnergyProjection(const System& system, const PhiEvaluator& phi)
    : system_(system),
      phi_(phi),
      rest_(system.potential->value(Vector::Zero(system.space->size()))),
      scratch_(system) {}

double EnergyProjection::measure(const Vector& z, const double* V) {
  line_.reset();
  known_.reset();
  if (V != nullptr) {
    known_ = EnergyLine::Known{system_.linear->quadratic(z), *V};
    start_ = {.K = known_->K.value, .V = *V, .size = known_->K.magnitude + std::abs(*V)};
  } else {
    begin_line(z);
  }
  return start_.H();
}

void EnergyProjection::begin_line(const Vector& z) {
  line_.emplace(system_, phi_, scratch_, z, EnergyLine::Direction::casimir_free, known_);
  start_ = line_->at(0);
}

//   zⁿ⁺¹ = ẑ + λ(ẑ − Πẑ),   H(zⁿ⁺¹) = E*                                                                       (E5)
EnergyProjection::Outcome EnergyProjection::project(Vector& z, const EnergyTarget& aim) {
  using Direction = EnergyLine::Direction;
  if (!line_ && !(knows_sizes(aim) && start_.H() == aim.H && start_.H() <= aim.cap)) begin_line(z);
  Outcome outcome{
      .computed = start_.H(), .H = start_.H(), .loss = start_.loss(), .values = start_.values(), .terms = start_.size};
  if (!line_ && system_.potential->homogeneity() == 0) outcome.terms = std::max(aim.terms, start_.size);
  if (!line_ || is_there(aim)) {
    outcome.admissible = true;
    outcome.H = aim.H;
    return outcome;
  }
  const EnergyLine::Slope slope = line_->slope();
  const bool conditioned = std::abs(slope.value) >= least_slope * slope.size;
  if (!conditioned && aim.H < aim.cap && start_.H() <= aim.cap) {
    outcome.admissible = true;
    return outcome;
  }
  if (conditioned && !aim.strong && solve(*line_, start_, aim, z, outcome)) return outcome;
  line_.reset();  // the lines below use its scratch
  const auto solve_along = [&](Direction direction) {
    EnergyLine line(system_, phi_, scratch_, z, direction);
    return solve(line, line.at(0), aim, z, outcome);
  };
  if (solve_along(Direction::steepest)) return outcome;
  if (conditioned && aim.strong && solve_along(Direction::casimir_free)) return outcome;
  outcome.by_bisection = true;
  outcome.H = std::min(start_.H(), aim.cap);
  outcome.admissible = start_.H() <= aim.cap + slack(start_, aim);  // below what it should be: safe all the same
  if (outcome.admissible) return outcome;

  // H falls from H(z) > goal to H(Πz) or H(0) ≤ goal: there is a root between (intermediate value theorem).
  const double goal = rest_ <= aim.cap ? std::max(aim.H, rest_) : aim.H;
  for (const Direction direction : {Direction::casimir_free, Direction::ray})
    if (bisect(EnergyLine(system_, phi_, scratch_, z, direction), goal, z, outcome)) break;
  return outcome;
}

// True where the sizes of the terms of H(ẑ) are known well enough without looking at V again: of a homogeneous V the
// line knows |V| alone anyway, and others are taken to stay of their size until the energies have fallen far below it.
bool EnergyProjection::knows_sizes(const EnergyTarget& aim) const {
  constexpr double far = 0.25;
  return system_.potential->homogeneity() > 0 || start_.size >= far * aim.terms;
}

// True where H(ẑ) = E* to round-off. Near rest, where H is flat, to all that round-off makes of it: to mend that,
// z would move by far more than its own.
bool EnergyProjection::is_there(const EnergyTarget& aim) {
  const double miss = std::abs(start_.H() - aim.H);
  if (!(miss <= start_.loss()) || !(start_.H() <= aim.cap + slack(start_, aim))) return false;
  return miss <= start_.round_off() || start_.loss() > blurred * std::abs(line_->slope().value);
}

bool EnergyProjection::moved_far(const Outcome& outcome, const Vector& z) const {
  if (std::abs(outcome.computed - outcome.H) <= 0.01 * std::abs(outcome.H - rest_)) return false;  // saves the norm
  return system_.space->squared_norm(z) < square(10 * outcome.displacement);
}

// z from `here` on its line to where H is what it should be; false, with z as it was, if the secant iteration does not
// find it.
bool EnergyProjection::solve(EnergyLine& line, EnergyLine::Parts here, const EnergyTarget& aim, Vector& z,
                             Outcome& outcome) {
  const auto miss = [&](const EnergyLine::Parts& p) { return std::abs(p.H() - aim.H); };
  double lambda = (aim.H - here.H()) / line.slope().value;
  for (int i = 0; miss(here) > here.round_off() && i < max_secants; ++i) {
    if (!(std::abs(lambda) < max_lambda)) return false;  // or NaN
    const EnergyLine::Parts next = line.at(lambda);
    ++outcome.iterations;
    if (next.H() == here.H()) break;  // as near as numbers come
    lambda = next.lambda + (aim.H - next.H()) * (next.lambda - here.lambda) / (next.H() - here.H());
    here = next;
  }
  if (!(miss(here) <= here.loss()) || !(here.H() <= aim.cap + slack(here, aim))) return false;
  if (here.lambda != 0) {
    outcome.factor = line.factor(here.lambda);
    outcome.displacement = std::abs(here.lambda) * system_.space->norm(line.direction());
    line.move(z, here.lambda);
  }
  outcome.admissible = true;
  outcome.H = aim.H;
  outcome.terms = here.size;
  return true;
}

// z towards the origin of the line, λ = −1, to a point with H ≤ goal; false, with z as it was, if H is above it even
// there.
bool EnergyProjection::bisect(EnergyLine line, double goal, Vector& z, Outcome& outcome) {
  EnergyLine::Parts low = line.at(-1);
  double high = 0;
  if (!(low.H() <= goal)) return false;
  for (int i = 0; i < max_bisections; ++i) {
    const EnergyLine::Parts parts = line.at((low.lambda + high) / 2);
    ++outcome.iterations;
    if (parts.H() <= goal)
      low = parts;
    else
      high = parts.lambda;
  }
  outcome.factor = line.factor(low.lambda);
  outcome.displacement = std::abs(low.lambda) * system_.space->norm(line.direction());
  line.move(z, low.lambda);
  outcome.admissible = true;
  outcome.H = low.H();
  outcome.terms = low.size;
  return true;
}

}  // namespace seiche
