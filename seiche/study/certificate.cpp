#include <seiche/core/error.hpp>
#include <seiche/core/law.hpp>
#include <seiche/core/operator_hypotheses.hpp>
#include <seiche/run/adaptive.hpp>
#include <seiche/study/certificate.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

Hypothesis hypothesis_of_rate(const Problem& problem, double t_end) {
  const std::string name = "γ ≥ 0";
  const LinearDamping& damping = problem.damping;
  if (!damping.rate && !damping.field_rate) return {name, Grade::by_structure, "there is no rate"};
  const std::string text = damping.rate ? damping.rate->text() : damping.field_rate->text();
  const double t =
      damping.rate ? damping.rate->first_negative_time(t_end) : damping.field_rate->first_negative_time(t_end);
  if (t >= 0)
    return {name, Grade::violated, fmt::format("γ = {} feeds energy", text), {}, fmt::format("t = {:.6g}", t)};
  const bool constant = damping.rate && damping.rate->is_constant();
  return {name, constant ? Grade::by_structure : Grade::sampled,
          fmt::format("γ = {} is nowhere negative{}", text,
                      constant ? "" : fmt::format(" at the times tried up to {:.6g}", t_end))};
}

Hypothesis hypothesis_of_touch(const Problem& problem) {
  const std::string name = "V is untouched by the damping";
  if (!problem.potential) return {name, Grade::by_structure, "there is no V"};
  if (!problem.damping_moves_potential())
    return {name, Grade::by_structure, "no damped field is one that V depends on"};
  for (Index f = 0; f < problem.field_count(); ++f)
    if (problem.potential_depends_on(f) && problem.damping_moves(f))
      return {name,
              Grade::violated,
              "the damping moves what V depends on: sym(MD) ⪰ 0 is not enough",
              {},
              "field " + problem.fields[static_cast<std::size_t>(f)]};
  throw Error("the fields of {} contradict one another", problem.name);
}

// ∇HᵀDz along a solution: where, and how small against the sizes of its terms.
class PowerWatch final : public Observer {
 public:
  explicit PowerWatch(const System& system)
      : system_(system), gradient_(Vector::Zero(system.space->size())), scratch_(gradient_), gradient_H_(gradient_) {}
  bool is_due(const State&, bool) const override { return true; }
  void observe(const State& state, const EnergyReading&) override {
    system_.potential->gradient(state.z, gradient_);
    const System::Dissipation q = system_.dissipation(state.t, state.z, gradient_, scratch_, gradient_H_);
    ++points;
    const double relative = q.round_off > 0 ? 100 * epsilon * q.rate / q.round_off : 0.0;
    if (relative >= smallest) return;
    smallest = relative;
    rate = q.rate;
    time = state.t;
  }
  void finish(const RunReport&) override {}

  double smallest = std::numeric_limits<double>::infinity();  // Q over the sum of its terms without their signs
  double rate = 0, time = 0;
  int points = 0;

 private:
  const System& system_;
  Vector gradient_, scratch_, gradient_H_;
};

Hypothesis sampled_condition(const Problem& problem, double t_end, const std::string& name) {
  Simulation simulation(problem, {.method = "egc4", .variable_steps = true});
  PowerWatch watch(simulation.system());
  const std::vector<Observer*> observers = {&watch};
  const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                              {.tolerance = 1e-5, .t_end = t_end}, observers);
  const std::string where = fmt::format("at {} points of a solution up to t = {:.6g}", watch.points, report.t);
  if (watch.smallest < -100 * epsilon)
    return {name, Grade::violated, "the exact energy rises where ∇HᵀDz − ∇HᵀS∇H < 0", watch.smallest,
            fmt::format("t = {:.6g}, where −dH/dt = {:.6g}", watch.time, watch.rate)};
  return {name, Grade::sampled,
          fmt::format("−dH/dt ≥ 0 {}; relative to its terms it is smallest at t = {:.6g}", where, watch.time),
          watch.smallest};
}

Hypothesis hypothesis_of_condition(const Problem& problem, const CertificateOptions& options, const Hypothesis& MD,
                                   const Hypothesis& touch) {
  const std::string name = "sym(P_H D) ⪰ 0";  // the energy-compatible damping condition (paper (1.2))
  const bool touched = touch.grade == Grade::violated;
  if (!problem.has_damping()) return {name, Grade::by_structure, "there is no damping"};
  if (!touched) {
    Hypothesis same = MD;
    same.name = name;
    same.statement = "P_H D is MD, as V is untouched: " + MD.statement;
    return same;
  }
  if (promise_energy_law(problem, options.t_end).promised)
    return {name, Grade::by_structure, "D = γI and u·∇V(u) ≥ 0 for every u, by the form of V"};
  if (!options.sample_solution || options.t_end <= 0)
    return {name, Grade::sampled, "not looked at: no solution was followed"};
  return sampled_condition(problem, options.t_end, name);
}

Hypothesis hypothesis_of_margin(const Problem& problem, const CertificateOptions& options) {
  const std::string name = "V + C > 0";
  Simulation simulation(problem, {.method = options.method, .method_options = options.method_options});
  const State& s = simulation.state();
  const double V = simulation.system().potential->value(s.z);
  return {
      name, Grade::verified,
      fmt::format(
          "at the start V + C = {:.6g} with C = {:.6g}; the guard of every step keeps it above a tenth of the energy",
          V + s.shift, s.shift),
      V + s.shift};
}

std::string theorem(const Problem& problem, const MethodEntry& method) {
  const std::string energy =
      method.law == "H" ? "H(zⁿ⁺¹) ≤ H(zⁿ)" : "the modified energy of step n + 1 ≤ that of step n";
  const std::string any = energy + " for every h: ";
  if (method.projects())
    return any + "the step ends with a projection on an energy of at most H(zⁿ) (docs/design.md, Order four to eight)";
  const std::string substep = "F + Fᵀ + FᵀMF ⪯ 0 for sym(S) ⪯ 0, and the closure keeps its energy exactly";
  if (method.composition == Composition::whole || !problem.has_damping()) return any + substep;
  return any + substep +
         "; the damping flow lets H fall where sym(P_H D) ⪰ 0 (Li, Li, Shang, Xu, Theorems 1 and 2, under (1.2))";
}

}  // namespace

Certificate certify(const Problem& problem, const CertificateOptions& options) {
  const MethodEntry& method = find_method(options.method);
  Certificate certificate;
  auto& list = certificate.hypotheses;
  list.push_back(hypothesis_of_S(problem));
  list.push_back(hypothesis_of_M(problem));
  list.push_back(hypothesis_of_rate(problem, options.t_end));
  certificate.law = promise_energy_law(problem, options.t_end);
  Hypothesis MD = hypothesis_of_MD(problem);
  // γ(x, t) does not commute with M where M couples points: the projector of the rate then says nothing.
  if (problem.damping.field_rate && !certificate.law.promised && MD.grade == Grade::verified)
    MD = {MD.name, Grade::sampled, "not decided: " + certificate.law.reason};
  list.push_back(MD);
  list.push_back(hypothesis_of_touch(problem));
  const Hypothesis touch = list.back();
  list.push_back(hypothesis_of_condition(problem, options, MD, touch));
  list.push_back(hypothesis_of_commuting(problem));
  if (method.closure == ClosureKind::sav) list.push_back(hypothesis_of_margin(problem, options));
  if (certificate.law.promised) certificate.theorem = theorem(problem, method);
  return certificate;
}

}  // namespace seiche
