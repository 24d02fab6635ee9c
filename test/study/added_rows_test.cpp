// One row is all it takes: a closure of this test's own, in a row beside the list, has the order, the law and the
// agreement that the row declares.
#include <test/support/cases.hpp>
#include <test/support/convergence.hpp>

#include <seiche/method/closure/closure.hpp>
#include <seiche/simulation/simulation.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

// The discrete gradient of Gonzalez, about the midpoint m = ½(z + z⁺) with δ = z⁺ − z:
//   f = ∇V(m) + [V(z⁺) − V(z) − ∇V(m)ᵀδ] δ/|δ|²
// by fixed-point sweeps, on the components that V depends on. V(z⁺) − V(z) = ḡᵀδ is free of cancellation.
class GonzalezClosure final : public Closure {
 public:
  GonzalezClosure(const System& system, const MethodOptions& options)
      : Closure(system, options.predictor), start_(system.space->size()), mean_(start_.g), f_(start_.g) {}

  StepReport advance(State& s, Propagators& propagators, double t, double h) override {
    const Propagator& propagator = propagators.at(h);
    predictor().predict(s, propagator, h, start_.z_mid);
    start_.prepare(potential(), propagator, s.z);
    double previous = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 100; ++i) {
      const double update = sweep(s.z, propagator);
      if (update <= 1 || (update <= 100 && update >= previous)) {
        s.z = start_.z_plus;
        return {.scalar_iterations = i + 1};
      }
      previous = update;
    }
    return {.status = StepReport::Status::failed,
            .message = fmt::format("no fixed point at t = {:.6g} with h = {:.6g}; a smaller h will do", t, h)};
  }

 private:
  Vector& midpoint_gradient() override { return start_.g; }

  // z⁺ ← Ez + Ff; returns its change in units of round-off.
  double sweep(const Vector& z, const Propagator& propagator) {
    Vector& z_plus = start_.z_plus;
    const auto [begin, size] = potential().support();
    middle_ = 0.5 * (z + z_plus);
    potential().gradient(middle_, f_);
    potential().mean_gradient(z, z_plus, mean_);
    delta_ = (z_plus - z).segment(begin, size);
    const double missed = space().dot((mean_ - f_).segment(begin, size), delta_);
    if (const double square = space().squared_norm(delta_); square > 0)
      f_.segment(begin, size) += missed / square * delta_;
    propagator.force(f_, start_.q);
    next_ = z + start_.dz + start_.q;
    const double update = space().max_norm(next_ - z_plus);
    z_plus.swap(next_);
    return update / (4 * epsilon * (space().max_norm(z_plus) + space().max_norm(start_.q)));
  }

  ExplicitStep start_;
  Vector mean_, f_, middle_, delta_, next_;
};

MethodEntry gonzalez() {
  MethodEntry row = find_method("seavf");  // for where the damping goes and how steps are judged
  row.name = "gonzalez";
  row.reference = "Gonzalez (1996), J. Nonlinear Sci. 6";
  row.kind.closure = "gonzalez";
  row.kind.make_closure = [](const System& system, const MethodOptions& options) -> std::unique_ptr<Closure> {
    return std::make_unique<GonzalezClosure>(system, options);
  };
  return row;
}

class OwnRun {
 public:
  OwnRun(const Problem& problem, const MethodEntry& method, std::string_view backend)
      : system_(find_backend(backend).system(problem, {})), stepper_(make_stepper(method, system_)) {
    state_.z = system_.initial;
    stepper_->begin(state_);
  }
  OwnRun& take(int steps, double h) {
    for (int n = 0; n < steps; ++n) {
      const StepReport report = stepper_->step(state_, h);
      EXPECT_TRUE(report.solved()) << report.message;
    }
    return *this;
  }
  EnergyReading energy() const { return stepper_->energy(state_); }
  Vector physical() const { return system_.space->physical(state_.z); }

 private:
  System system_;
  std::unique_ptr<Stepper> stepper_;
  State state_;
};

TEST(AddedRows, AGonzalezClosureHasItsOrderItsLawAndItsAgreement) {
  const Problem problem = klein_gordon_case(0.1, 1.0);
  const MethodEntry method = gonzalez();
  const Vector exact = OwnRun(problem, find_method("egc8"), "dense").take(64, 1.0 / 64).physical();
  std::vector<double> sizes, errors;
  for (const int n : {16, 32, 64}) {
    sizes.push_back(1.0 / n);
    errors.push_back((OwnRun(problem, method, "dense").take(n, 1.0 / n).physical() - exact).norm());
  }
  EXPECT_NEAR(fitted_order(sizes, errors), method.order, 0.1);

  // Without damping ∇V(m) alone changes H by more than a thousandth of it.
  OwnRun undamped(klein_gordon_case(0, 1.0), method, "modal");
  const double H = undamped.energy().H;
  for (int n = 0; n < 100; ++n) EXPECT_NEAR(undamped.take(1, 0.5).energy().H, H, 1e-12 * H) << n;

  const Vector expected = OwnRun(problem, method, "reference").take(64, 1.0 / 64).physical();
  for (const BackendEntry& backend : backends_for(problem))
    EXPECT_LE((OwnRun(problem, method, backend.name).take(64, 1.0 / 64).physical() - expected).norm(), 1e-12)
        << backend.name;
  const Vector by_avf = OwnRun(problem, find_method("seavf"), "reference").take(64, 1.0 / 64).physical();
  EXPECT_GT((by_avf - expected).norm(), 1e-9);  // it is another closure
}

}  // namespace TEST_FILE
}  // namespace seiche::test
