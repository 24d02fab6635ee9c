#include <seiche/core/step_cache.hpp>
#include <seiche/method/collocation/collocation_weights.hpp>
#include <seiche/method/common/nonlinear_force.hpp>
#include <seiche/method/runge_kutta/exponential_runge_kutta.hpp>

namespace seiche {
namespace {

class ExponentialRungeKutta final : public BaseStep {
 public:
  ExponentialRungeKutta(const System& system, const PhiEvaluator& phi, const ExponentialTableau& tableau)
      : tableau_(tableau),
        space_(*system.space),
        phi_(phi),
        force_(system),
        output_(output_of(tableau.C)),
        dissipation_(system, phi, output_, output_of(tableau.C_coarse),
                     {GaussRule(tableau.coarse), GaussRule(tableau.fine), NestedRules(tableau.nested)}),
        cache_(cached_step_sizes(system.space->size_of_all())),
        forces_(tableau.stages.size() + 1, Vector::Zero(system.space->size())) {}

  bool compute(const State& s, double t, double h, Vector& z) override {
    const Tables& of_h = cache_.at(h, [&] { return std::make_unique<Tables>(make_tables(h)); });
    forces_[0] = s.z;
    force_.evaluate(t, forces_[0]);
    double pushed = space_.norm(forces_[0]);
    for (const double c : {0.5, 1.0}) pushed = std::max(pushed, force_.external(t + c * h));
    const double size = space_.norm(s.z) + h * pushed;
    for (std::size_t i = 1; i < forces_.size(); ++i) {
      of_h.stages[i - 1]->apply(s.z, {forces_.data(), i}, {&forces_[i], 1});
      force_.evaluate(t + tableau_.stages[i - 1].c * h, forces_[i]);
    }
    of_h.end->apply(s.z, used(), {&z, 1});
    return may_be_solution(space_, z, size);
  }

  std::string_view failure() const override { return "the result of the exponential Runge–Kutta scheme is not finite"; }
  StepDissipation::Kind dissipation_kind() const override { return dissipation_.kind(); }
  StepDissipation::Amount dissipated(const State& s, double t, double h, const Vector& z, double H) override {
    constexpr double safety = 2;  // the solution inside a step has an order less than its end
    StepDissipation::Amount amount =
        dissipation_.follows_energies()
            ? dissipation_.measure(t, h, s.z, used(), dissipation_.energies(s.z, s.energy), dissipation_.energies(z, H))
            : dissipation_.measure(t, h, s.z, used());
    amount.doubt *= safety;
    return amount;
  }
  void prepare_flow(double h) override { dissipation_.prepare_flow(h); }
  double flow_missed(const State& s, double h) override { return dissipation_.flow_missed(h, s, used()); }

 private:
  struct Tables {
    std::vector<std::unique_ptr<PhiMap>> stages;
    std::unique_ptr<PhiMap> end;
  };

  StepOutput output_of(const Eigen::MatrixXd& C) const {  // which outlives it
    return {.forces = C.cols(), .order = C.rows(), .kind = force_.kind(), .weights = [&C](double theta) {
              return collocation_weights(C, theta);
            }};
  }

  Tables make_tables(double h) const {
    const bool states = output_.kind == PhiRows::Forces::states;  // then all of U_i is looked at
    Tables made;
    for (const ExponentialTableau::Stage& stage : tableau_.stages)
      made.stages.push_back(phi_.map({.rows = {{stage.c, stage.weights}},
                                      .forces = static_cast<Index>(made.stages.size()) + 1,
                                      .order = stage.order,
                                      .kind = output_.kind,
                                      .outputs = states ? PhiRows::Outputs::all : PhiRows::Outputs::support},
                                     h));
    made.end = phi_.map(output_.at(Eigen::VectorXd::Ones(1), PhiRows::Outputs::all), h);
    return made;
  }

  std::span<const Vector> used() const {
    return std::span<const Vector>(forces_).subspan(static_cast<std::size_t>(tableau_.first_used));
  }

  const ExponentialTableau& tableau_;
  const Space& space_;
  const PhiEvaluator& phi_;
  NonlinearForce force_;
  StepOutput output_;
  StepDissipation dissipation_;
  StepCache<Tables> cache_;
  std::vector<Vector> forces_;
};

}  // namespace

// U₂ = φ₀zⁿ + (h/2)φ₁N₁,  ẑ = φ₀zⁿ + hφ₁N₂.
const ExponentialTableau& exponential_midpoint() {
  static const ExponentialTableau tableau{.stages = {{.c = 0.5, .order = 1, .weights = {0.5}}},
                                          .first_used = 1,
                                          .C = Eigen::MatrixXd::Ones(1, 1),
                                          .C_coarse = Eigen::MatrixXd::Ones(1, 1),
                                          .coarse = 1,
                                          .fine = 3,
                                          .nested = 1};
  return tableau;
}

// U₂ = φ₀zⁿ + (h/2)φ₁N₁,  U₃ = φ₀zⁿ + h[(φ₁/2 − φ₂)N₁ + φ₂N₂],  U₄ = φ₀zⁿ + h[(φ₁ − 2φ₂)N₁ + 2φ₂N₃],
// a₀ = N₁,  a₁ = −3N₁ + 2N₂ + 2N₃ − N₄,  a₂ = 2(N₁ − N₂ − N₃ + N₄).
const ExponentialTableau& krogstad() {
  static const ExponentialTableau tableau = [] {
    Eigen::MatrixXd C(3, 4);
    C << 1, 0, 0, 0,   //
        -3, 2, 2, -1,  //
        2, -2, -2, 2;
    Eigen::MatrixXd C_coarse(2, 4);
    C_coarse << 1, 0, 0, 0,  //
        -1, 0, 0, 1;
    return ExponentialTableau{.stages = {{.c = 0.5, .order = 1, .weights = {0.5}},
                                         {.c = 0.5, .order = 2, .weights = {0.5, -1, 0, 1}},
                                         {.c = 1.0, .order = 2, .weights = {1, -2, 0, 0, 0, 2}}},
                              .first_used = 0,
                              .C = C,
                              .C_coarse = C_coarse,
                              .coarse = 3,
                              .fine = 4,
                              .nested = 2};
  }();
  return tableau;
}

std::unique_ptr<BaseStep> exponential_runge_kutta(const System& system, const PhiEvaluator& phi,
                                                  const ExponentialTableau& tableau) {
  return std::make_unique<ExponentialRungeKutta>(system, phi, tableau);
}

}  // namespace seiche
