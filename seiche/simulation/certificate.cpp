#include <seiche/core/base/error.hpp>
#include <seiche/core/generic_state.hpp>
#include <seiche/law/ecld.hpp>
#include <seiche/law/law.hpp>
#include <seiche/law/operator_hypotheses.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/simulation/certificate.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

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

Hypothesis hypothesis_of_friction(const Problem& problem, double t_end) {
  const std::string name = "v·R(v) ≥ 0";
  const Friction& friction = *problem.friction;
  if (friction.is_dissipative())
    return {name, Grade::by_structure, fmt::format("R = {} opposes the velocity", friction.text())};
  const std::string place = friction.feeds_at(t_end);
  if (!place.empty()) return {name, Grade::violated, fmt::format("R = {} feeds energy", friction.text()), {}, place};
  return {name, Grade::sampled,
          fmt::format("R = {} feeds energy at none of the velocities, coordinates and times tried", friction.text())};
}

Hypothesis hypothesis_of_forces(const Problem& problem) {
  for (std::size_t f = 0; f < problem.forces.size(); ++f)
    if (problem.forces[f])
      return {"no external force",
              Grade::violated,
              "an external force does work, and H may rise",
              {},
              fmt::format("f = {} on the field {}", problem.forces[f]->text(), problem.fields[f])};
  throw Error("{} has no external force", problem.name);
}

// wᵀS(z)w ≤ 0 for the initial z and random w.
Hypothesis hypothesis_of_mobility(const Problem& problem, const System& system) {
  const Vector& z = system.initial;
  Vector w(z), out(z), linear(z);
  std::mt19937_64 random(1);
  constexpr int samples = 16;
  double largest = -std::numeric_limits<double>::infinity();  // of its terms
  for (int i = 0; i < samples; ++i) {
    w = random_state(*system.space, random);
    system.structure->apply(z, w, out);
    system.linear->apply_S(w, linear);
    out += linear;
    const ValueAndMagnitude form = system.space->dot_and_magnitude(w, out);
    largest = std::max(largest, form.value / std::max(form.magnitude, 1e-300));
  }
  return {"sym S(z) ⪯ 0", largest <= 1e3 * epsilon ? Grade::sampled : Grade::violated,
          fmt::format("{}, with 0 where the coefficient is negative", problem.structure->text()), -largest};
}

// wᵀS(z)w = 0 for random z and w, as far as round-off lets one see.
Hypothesis hypothesis_of_structure(const Problem& problem, const System& system) {
  if (problem.structure->dissipates()) return hypothesis_of_mobility(problem, system);
  const std::string name = "S(z) skew";
  Vector z(system.space->size()), w(z), out(z);
  std::mt19937_64 random(1);
  constexpr int samples = 16;
  double worst = 0;
  for (int i = 0; i < samples; ++i) {
    z = random_state(*system.space, random);
    w = random_state(*system.space, random);
    system.structure->apply(z, w, out);
    const ValueAndMagnitude form = system.space->dot_and_magnitude(w, out);
    worst = std::max(worst, std::abs(form.value) / std::max(form.magnitude, 1e-300));
  }
  const bool skew = worst <= 1e3 * epsilon;
  return {name, skew ? Grade::sampled : Grade::violated,
          fmt::format("{}: wᵀS(z)w is at most {:.2g} of its terms for {} random z and w", problem.structure->text(),
                      worst, samples)};
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
    const double taken = q.rate + q.work;  // by damping alone
    const double relative = q.round_off > 0 ? 100 * epsilon * taken / q.round_off : 0.0;
    if (relative >= smallest) return;
    smallest = relative;
    rate = taken;
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

Hypothesis sampled_condition(const Problem& problem, const CertificateOptions& options, const std::string& name) {
  Simulation simulation(problem, {.method = "egc4", .variable_steps = true});
  PowerWatch watch(simulation.system());
  simulation.state().t = options.t_start;
  const std::vector<Observer*> observers = {&watch};
  const RunReport report =
      integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                         {.tolerance = 1e-5, .t_end = options.t_end, .stop = options.stop}, observers);
  const std::string where = fmt::format("at {} points of a solution up to t = {:.6g}", watch.points, report.t);
  if (watch.smallest < -100 * epsilon)
    return {name, Grade::violated, "the exact energy rises where ∇HᵀDz − ∇HᵀS∇H < 0", watch.smallest,
            fmt::format("t = {:.6g}, where −dH/dt = {:.6g}", watch.time, watch.rate)};
  return {name, Grade::sampled,
          fmt::format("−dH/dt ≥ 0 {}; relative to its terms it is smallest at t = {:.6g}", where, watch.time),
          watch.smallest};
}

Hypothesis hypothesis_of_condition(const Problem& problem, const CertificateOptions& options, const LawPromise& law,
                                   const Hypothesis& MD, const Hypothesis& touch) {
  const std::string name = "sym(P_H D) ⪰ 0";  // the energy-compatible damping condition (paper (1.2))
  const bool touched = touch.grade == Grade::violated;
  if (!problem.has_damping()) return {name, Grade::by_structure, "there is no damping"};
  if (!touched) {
    Hypothesis same = MD;
    same.name = name;
    same.statement = "P_H D is MD, as V is untouched: " + MD.statement;
    return same;
  }
  if (law.promised) return {name, Grade::by_structure, law.reason + ", by the form of V"};
  if (!options.sample_solution || options.t_end <= options.t_start)
    return {name, Grade::sampled, "not looked at: no solution was followed; seiche check follows one"};
  return sampled_condition(problem, options, name);
}

Hypothesis hypothesis_of_margin(const Simulation& simulation) {
  const std::string name = "V + C > 0";
  const State& s = simulation.state();
  const double V = simulation.system().potential->value(s.z);
  return {name, Grade::verified,
          fmt::format("at the start V + C = {:.6g} with C = {:.6g}; every step keeps it above a tenth of the energy",
                      V + s.shift, s.shift),
          V + s.shift};
}

// Where a linear solver stops at a tolerance, what becomes of that on which the theorems stand.
Hypothesis hypothesis_of_solver(const std::string& objection) {
  const std::string name = "F + Fᵀ + FᵀMF ⪯ 0";
  if (!objection.empty()) return {name, Grade::violated, objection, {}, "every step"};
  return {name, Grade::verified,
          "the linear solver stops at its tolerance; what it misses is restored in every step, to round-off"};
}

std::string theorem(const Problem& problem, const MethodEntry& method, bool relaxes) {
  const std::string energy =
      method.kept_energy == "H" ? "H(zⁿ⁺¹) ≤ H(zⁿ)" : "the modified energy of step n + 1 ≤ that of step n";
  const std::string any = energy + " for every h: ";
  if (method.projects())
    return any +
           "whatever ẑ the step has computed, it ends with a projection of ẑ on an energy of at most H(zⁿ) (page Theory, "
           "Order four to eight)";
  std::string substep = "F + Fᵀ + FᵀMF ⪯ 0 for sym(S) ⪯ 0, and the closure keeps its energy exactly";
  if (method.kind.takes_predictor) substep += ", whatever midpoint ẑ was predicted";
  if (relaxes)
    substep +=
        "; behind it r² moves towards V + C, upwards by at most 95 % of what the step has dissipated, so that the modified "
        "energy is H but for what is left (Jiang, Zhang, Zhao 2022)";
  if (method.kind.merges_damping || !problem.has_damping()) return any + substep;
  return any + substep +
         "; the damping flow lets H fall where sym(P_H D) ⪰ 0 (Li, Li, Shang, Xu, Theorems 1 and 2, under (1.2))";
}

}  // namespace

Certificate certify(const Problem& problem, const CertificateOptions& options) {
  const MethodEntry& method = find_method(options.method);
  require_finite_rates(problem, options.t_start, options.t_end);
  if (options.noise.is_on())
    for (const std::string& complaint : {complaint_about_rate(problem.damping.rate.get(), options.t_end),
                                         complaint_about_rate(problem.damping.field_rate.get(), options.t_end)})
      if (!complaint.empty()) throw Error("no noise balances a negative damping: {}", complaint);
  const auto go_on = [&] {
    if (options.stop != nullptr && options.stop->load(std::memory_order_relaxed)) throw Error("interrupted");
  };
  const OperatorFindings findings = look_at_operators(problem, options.ranks);
  go_on();
  const LawPromise law = promise_energy_law(problem, options.t_end, findings);
  Certificate certificate;
  auto& list = certificate.hypotheses;
  list.push_back(hypothesis_of_S(problem, findings));
  list.push_back(hypothesis_of_M(problem, findings));
  list.push_back(hypothesis_of_rate(problem, options.t_end));
  go_on();
  Hypothesis MD = hypothesis_of_MD(problem, findings);
  // γ(x, t) does not commute with M where M couples points: the projector of the rate then says nothing.
  if (problem.damping.field_rate && !law.promised && MD.grade == Grade::verified)
    MD = {MD.name, Grade::sampled, "not decided: " + law.reason};
  list.push_back(MD);
  const Hypothesis touch = hypothesis_of_touch(problem);
  list.push_back(touch);
  go_on();
  list.push_back(hypothesis_of_condition(problem, options, law, MD, touch));
  go_on();
  list.push_back(hypothesis_of_commuting(problem));
  if (problem.friction) list.push_back(hypothesis_of_friction(problem, options.t_end));
  if (problem.has_forces()) list.push_back(hypothesis_of_forces(problem));
  std::optional<Simulation> own;
  const auto at_start = [&]() -> const Simulation& {
    if (options.at_start != nullptr) return *options.at_start;
    if (!own)
      own.emplace(problem, SimulationOptions{.method = options.method, .method_options = options.method_options});
    return *own;
  };
  go_on();
  if (problem.structure) list.push_back(hypothesis_of_structure(problem, at_start().system()));
  if (method.kind.takes_C) list.push_back(hypothesis_of_margin(at_start()));
  const bool bent = std::any_of(list.begin(), list.end(), [](const Hypothesis& h) {
    return (h.name == "S(z) skew" || h.name == "sym S(z) ⪯ 0") && h.grade == Grade::violated;
  });
  certificate.law = bent ? LawPromise{false, "S(z) feeds energy"} : law;
  if (const std::string given_up = options.method_options.objection(method); !bent && !given_up.empty())
    certificate.law.withdraw(given_up);
  if (options.noise.is_on()) {
    list.push_back({"no noise", Grade::violated, objection_of_noise(options.noise), {}, "every step"});
    certificate.law = {.promised = false, .reason = objection_of_noise(options.noise)};
  }
  if (options.at_start != nullptr && options.at_start->system().linear->solver_share() && !method.projects()) {
    const std::string of_solver = objection_of_solver(options.at_start->system(), method);
    list.push_back(hypothesis_of_solver(of_solver));
    if (certificate.law.promised && !of_solver.empty()) certificate.law.withdraw(of_solver);
  }
  if (certificate.law.promised) {
    const bool relaxes =
        method.kind.takes_C &&
        settled(method, at_start().system(), options.method_options).auxiliary == AuxiliaryMode::relaxed;
    certificate.theorem = theorem(problem, method, relaxes);
  }
  return certificate;
}

std::string certificate_json(const Certificate& certificate) {
  using Json = nlohmann::ordered_json;
  Json findings = Json::array();
  for (const Hypothesis& hypothesis : certificate.hypotheses) {
    Json item = {{"hypothesis", hypothesis.name},
                 {"grade", to_string(hypothesis.grade)},
                 {"statement", hypothesis.statement}};
    item["margin"] = hypothesis.margin ? Json(*hypothesis.margin) : Json(nullptr);
    item["witness"] = hypothesis.witness.empty() ? Json(nullptr) : Json(hypothesis.witness);
    findings.push_back(item);
  }
  const Json document = {{"hypotheses", findings},
                         {"law",
                          {{"promised", certificate.law.promised},
                           {"reason", certificate.law.reason},
                           {"theorem", certificate.theorem.empty() ? Json(nullptr) : Json(certificate.theorem)}}}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace seiche
