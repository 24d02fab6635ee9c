// What leaves H over one step, ∫(Q − ∇Hᵀf) dt with Q = ∇Hᵀ(Dz + R − S∇H), by two quadratures on the dense output of a
// method.
#pragma once

#include <seiche/core/numerics/quadrature.hpp>
#include <seiche/core/state.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/core/system.hpp>
#include <seiche/method/projection/flow_quadrature.hpp>

#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace seiche {

// The dense output of a method: its solution at θ = (t − tₙ)/h as a sum of φ-functions of the forces of the step.
struct StepOutput {
  Index forces = 0;
  Index order = 0;
  PhiRows::Forces kind = PhiRows::Forces::gradients;
  std::function<std::vector<double>(double theta)> weights;  // of PhiRow

  PhiRows at(const Eigen::VectorXd& thetas, PhiRows::Outputs outputs) const;
};

class StepDissipation {
 public:
  struct Rules {
    GaussRule coarse, fine;
    NestedRules nested;  // where Q is known from energies
  };
  // Where Q depends on ∇V the coarser rule looks at `coarse`: a dense output that is less accurate than the end of the
  // step errs in ∫Q by more than two rules on it differ by. `system` and `phi` outlive it.
  StepDissipation(const System& system, const PhiEvaluator& phi, StepOutput output, StepOutput coarse, Rules rules);

  // How Q can be known.
  enum class Kind {
    none,       // Q = 0
    quadratic,  // Q ⪰ 0 is a form of z: both quadratures together cost one pass over the modes, and no gradient
    general,    // Q is evaluated node by node
  };
  static Kind kind_of(const System& system, const PhiEvaluator& phi);
  Kind kind() const { return kind_; }

  struct Sum {
    double taken = 0.0;  // ∫Q − ∫∇Hᵀf
    double work = 0.0;   // ∫∇Hᵀf, what external forces give
    // Some integrand is beyond round-off below zero: then the energy-compatible damping condition fails, or a force
    // feeds: so much.
    bool negative = false;
    double gain = 0.0;
    void add(double weight, const System::Dissipation& q);
  };
  struct Amount {
    double fine = 0.0;   // of `taken`
    double doubt = 0.0;  // how far the coarser quadrature is from it
    double work = 0.0;
    bool negative = false;
    double gain = std::numeric_limits<double>::infinity();  // where that is so, and how much is not known
  };
  // Of the step from (t, z) with these forces. `coarse`: where it is known already (general), else null.
  Amount measure(double t, double h, const Vector& z, std::span<const Vector> forces, const Sum* coarse = nullptr);

  // sum += weight · the integrands at (t, z).
  void add(double t, const Vector& z, const Vector& potential_gradient, double weight, Sum& sum);

  // Of kind `general`, but Q follows from K = ½zᵀMz and V: with D = γI, S skew and V homogeneous of degree d, it is
  // γ(2K + dV): the ends of a step then cost no gradient and no transform, and the nodes between no gradient.
  bool follows_energies() const { return follows_energies_; }
  static bool energies_tell(const System& system, const PhiEvaluator& phi);
  struct Energies {
    double K = 0.0, V = 0.0;
  };
  static Energies energies(const System& system, const Vector& z, double H);  // of a state with this H
  Energies energies(const Vector& z, double H) const { return energies(system_, z, H); }
  // Q and its round-off, where energies tell them.
  static System::Dissipation of_energies(const System& system, double t, const Energies& e);
  // As above, from the states at both ends and at the coarse nodes of the nested rules, where a method knows these:
  // always or never.
  Amount measure(double t, double h, const Vector& z, std::span<const Vector> forces, const Energies& before,
                 const Energies& after, std::span<const Energies> at_nodes = {});

  // What the finer quadrature misses of the linear flow from s under the force of the step's start; 0 where it resolves
  // it.
  double flow_missed(double h, const State& s, std::span<const Vector> forces);
  void prepare_flow(double h);  // so that this allocates nothing

 private:
  using NodeMaps = std::vector<std::unique_ptr<PhiMap>>;  // one for each node of a rule
  struct Tables {
    std::unique_ptr<PhiForms> forms;  // quadratic
    NodeMaps fine, coarse;            // general; each made when it is first asked for
    std::unique_ptr<PhiMap> between;  // the nodes of the nested rules that are not known already
  };
  void add_nodes(double t, double h, const Vector& z, std::span<const Vector> forces, const StepOutput& output,
                 const GaussRule& rule, NodeMaps& maps, Sum& sum);
  Tables& tables(double h);

  const System& system_;
  const PhiEvaluator& phi_;
  StepOutput output_, coarse_output_;
  Rules rules_;
  Kind kind_;
  bool needs_gradient_, follows_energies_;
  StepCache<Tables> cache_;
  std::vector<Vector> node_;        // one, or as many as are looked at together
  Eigen::VectorXd between_;         // nodes of the nested rules but for the ends
  std::vector<Energies> energies_;  // there
  Vector gradient_, scratch_, gradient_H_;
  std::unique_ptr<FlowQuadrature> flow_;
  std::vector<double> at_end_;  // weights of the output at θ = 1
  Vector start_;                // the force of the step's start
};

}  // namespace seiche
