// The equations of a collocation step, solved by sweeps.
#pragma once

#include <seiche/core/numerics/quadrature.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/core/system.hpp>
#include <seiche/method/collocation/anderson_acceleration.hpp>
#include <seiche/method/common/nonlinear_force.hpp>
#include <seiche/method/projection/step_dissipation.hpp>

#include <Eigen/Dense>

#include <optional>
#include <vector>

namespace seiche {

//   Z_i = z(c_i),   F_i = N(t + c_i h, Z_i)   at the Gauss nodes c_i                                      (E1)
// with z(θ) of egc.hpp. The first guess extrapolates the forces of the step before. Sweeps, F from Z and Z from F, then
// contract as far as h∂N is small. In a gradient flow it is not: L and ∂N both damp, and a solution that hardly moves
// asks for steps in which they do so many times over. There sweeps are accelerated, and go on until what is left is
// small beside the error of the step; elsewhere there are about s of them (sweep_control.hpp).
class CollocationEquations {
 public:
  // What is kept of the nodes Z_i beside F_i = N(Z_i).
  enum class Kept { nothing, energies, samples };
  struct Sample {
    Vector node, gradient;  // Z_i and ∇V(Z_i)
  };

  static constexpr int memory = 5;  // of accelerated sweeps

  // Without tables of φ an error costs more to know than the sweeps that it saves.
  CollocationEquations(const System& system, const GaussRule& rule, Kept kept, bool has_tables);

  bool asks_for_errors() const { return has_tables_ && (stages() > 2 || are_accelerated()); }
  bool are_accelerated() const { return acceleration_.has_value(); }
  PhiRows::Forces kind() const { return force_.kind(); }
  // All components of Z_i, or those that V depends on?
  PhiRows::Outputs outputs() const;
  Potential::Support of_forces() const { return of_forces_; }  // the components of F_i that may differ from zero

  // The first guess, or without a step before N(zⁿ) throughout. Returns the largest of |F_i|.
  double predict(const State& s, double t, double h);
  // `nodes`: F_i → Z_i. `error`: about that of the step, by the forces so far. False where accelerated sweeps leave the
  // Z_i further from a solution than a thousandth of their size.
  bool solve(const State& s, double t, double h, const PhiMap& nodes, FunctionRef<double()> error);
  double force_at(double t, Vector& z) { return force_.evaluate(t, z); }  // z ← N(t, z)
  double external(double t) { return force_.external(t); }

  // Of what was solved last, whose last force is `last`: about what one more sweep would change z by at the end. What
  // all of them would is more where solutions move apart.
  const Vector& unsolved(double h, const Vector& last);
  void apply_S(Vector& f);  // f ← Sf of a force; the force itself where the kind is `states`

  std::vector<Vector>& forces() { return forces_; }
  const std::vector<Vector>& forces() const { return forces_; }
  std::span<const Sample> samples() const { return samples_; }
  std::span<const StepDissipation::Energies> energies() const { return energies_; }

 private:
  int stages() const { return static_cast<int>(forces_.size()); }
  void evaluate(double t, double h, bool keeps);  // Z_i → F_i, in place
  bool sweep(const State& s, double t, double h, const PhiMap& nodes, FunctionRef<double()> error);
  bool sweep_accelerated(const State& s, double t, double h, const PhiMap& nodes, FunctionRef<double()> error);

  const System& system_;
  GaussRule rule_;
  NonlinearForce force_;
  Potential::Support of_forces_;
  bool has_tables_;
  std::vector<Vector> forces_;
  std::vector<Sample> samples_;
  std::vector<StepDissipation::Energies> energies_;
  StepCache<Eigen::MatrixXd> extrapolations_{16};  // by the ratio of two step sizes
  std::optional<AndersonAcceleration> acceleration_;
  double convergence_ = 1;    // of the last two sweeps
  Vector components_before_;  // of the last force, a sweep ago
  Vector change_, rate_;
};

}  // namespace seiche
