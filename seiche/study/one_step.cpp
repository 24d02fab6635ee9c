#include <seiche/core/base/error.hpp>
#include <seiche/core/momenta.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/study/one_step.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace seiche {
namespace {

// γ(x, 0) at every time.
class FrozenFieldRate final : public FieldRate {
 public:
  FrozenFieldRate(const FieldRate& rate, Index unknowns) : gamma_(unknowns), text_(rate.text() + " at t = 0") {
    rate.values(0, {gamma_.data(), static_cast<std::size_t>(unknowns)});
  }
  explicit FrozenFieldRate(Vector gamma) : gamma_(std::move(gamma)), text_("damping and linear friction at t = 0") {}
  void values(double, std::span<double> gamma) const override {
    std::copy(gamma_.begin(), gamma_.end(), gamma.begin());
  }
  void integrals(double, double h, std::span<double> out) const override {
    std::transform(gamma_.begin(), gamma_.end(), out.begin(), [h](double gamma) { return h * gamma; });
  }
  bool is_constant() const override { return true; }
  double first_negative_time(double) const override { return gamma_.minCoeff() < 0 ? 0.0 : -1.0; }
  double negative_seen() const override { return first_negative_time(0); }
  std::string text() const override { return text_; }

 private:
  Vector gamma_;
  std::string text_;
};

// ∂R/∂v at rest and t = 0, of each point, times w: what friction adds to γ there. Nothing where R has no such
// derivative (it jumps, or is not finite), or where components of a velocity have slopes of their own.
std::optional<Vector> slope_of_friction(const Problem& problem, const Momenta& p) {
  constexpr double small = 1e-100;  // beside it v|v| and v³ are nothing
  const Index n = problem.grid.unknowns();
  const auto size = static_cast<std::size_t>(p.count * n);
  const Vector q = Vector::Zero(p.count * n);
  const auto slopes = [&](double v) -> Vector {
    const Vector velocity = Vector::Constant(q.size(), v);
    Vector r = Vector::Zero(q.size());
    problem.friction->force(0, {q.data(), size}, {velocity.data(), size}, {r.data(), size});
    return r / v;
  };
  const Vector right = slopes(small);
  if (!right.allFinite() || right.lpNorm<Eigen::Infinity>() > 1 / std::sqrt(small) || right != slopes(-small))
    return std::nullopt;
  for (Index i = 1; i < p.count; ++i)
    if (right.segment(i * n, n) != right.head(n)) return std::nullopt;
  return p.inverse_mass * right.head(n);
}

// The linear part of friction becomes damping, on the same momenta.
void add_linear_friction(const Problem& problem, LinearDamping& damping) {
  if (!problem.friction || problem.friction->smoothness() == Friction::Smoothness::jump) return;
  const std::optional<Momenta> p = momenta(problem);
  if (!p) return;
  std::vector<bool> of_momenta(static_cast<std::size_t>(problem.field_count()));
  for (Index i = p->first; i < p->first + p->count; ++i) of_momenta[static_cast<std::size_t>(i)] = true;
  if ((damping.rate || damping.field_rate) && damping.rate_fields != of_momenta) return;
  std::optional<Vector> slope = slope_of_friction(problem, *p);
  if (!slope || slope->isZero(0)) return;
  damping.rate_fields = of_momenta;
  if (slope->minCoeff() == slope->maxCoeff()) {
    damping.rate = constant_rate((damping.rate ? damping.rate->value(0) : 0.0) + (*slope)[0]);
    return;
  }
  if (damping.field_rate) {
    Vector gamma(slope->size());
    damping.field_rate->values(0, {gamma.data(), static_cast<std::size_t>(gamma.size())});
    *slope += gamma;
  }
  damping.field_rate = std::make_shared<FrozenFieldRate>(std::move(*slope));
}

}  // namespace

Problem linear_part_of(const Problem& problem) {
  Problem linear = problem;
  linear.potential = nullptr;
  linear.friction = nullptr;
  linear.forces.clear();
  linear.structure = nullptr;
  linear.initial.setZero();
  LinearDamping& damping = linear.damping;
  if (damping.rate && !damping.rate->is_constant()) damping.rate = constant_rate(damping.rate->value(0));
  if (damping.field_rate && !damping.field_rate->is_constant())
    damping.field_rate = std::make_shared<FrozenFieldRate>(*damping.field_rate, problem.grid.unknowns());
  add_linear_friction(problem, damping);
  return linear;
}

void OneStep::go_on() const {
  if (stop_ != nullptr && stop_->load(std::memory_order_relaxed)) throw Error("interrupted");
}

Vector OneStep::operator()(const Vector& z) {
  go_on();
  State state;
  state.z.setZero(simulation_.system().space->size());
  simulation_.system().space->from_physical(z, state.z);
  simulation_.stepper().begin(state);
  const StepReport report = simulation_.stepper().step(state, h_);
  if (!report.solved()) throw std::runtime_error(fmt::format("a step of the linear part failed: {}", report.message));
  return simulation_.system().space->physical(state.z);
}

Vector OneStep::derivative(const Vector& z) const {
  const System& system = simulation_.system();
  Vector coordinates = Vector::Zero(system.space->size());
  Vector derivative = coordinates;
  system.space->from_physical(z, coordinates);
  system.right_hand_side(0, coordinates, derivative);
  return system.space->physical(derivative);
}

Linearity linearity_of(OneStep& step, const Vector& y, const Vector& z) {
  constexpr double tolerance = 1e-11;  // above the round-off of a step, below any nonlinearity that would be felt
  const Vector of_y = step(y);
  const Vector of_z = step(z);
  const double size = of_y.lpNorm<Eigen::Infinity>() + of_z.lpNorm<Eigen::Infinity>();
  const auto vanishes = [&](const Vector& v) { return v.lpNorm<Eigen::Infinity>() <= tolerance * size; };
  Linearity seen;
  seen.is_homogeneous = vanishes(step(2 * z) - 2 * of_z);
  seen.is_linear = seen.is_homogeneous && vanishes(step(y + z) - of_y - of_z);
  return seen;
}

}  // namespace seiche
