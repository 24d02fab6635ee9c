#include <seiche/damping/rates.hpp>
#include <seiche/study/one_step.hpp>

#include <fmt/format.h>

#include <algorithm>
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
  return linear;
}

Vector OneStep::operator()(const Vector& z) {
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
