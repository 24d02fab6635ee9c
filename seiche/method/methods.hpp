// The list of methods. One row is one method, and holds all that is said of it.
#pragma once

#include <seiche/core/stepper.hpp>
#include <seiche/core/system.hpp>
#include <seiche/method/common/energy_law.hpp>
#include <seiche/method/common/method_options.hpp>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

class BaseStep;
class Closure;
struct MethodEntry;

enum class MembersTogether { none, avf, sav };  // how many members of an ensemble take a step side by side

// What methods of one kind have in common, whatever their order and propagator.
struct MethodKind {
  std::string_view closure = "none";  // of the nonlinear part
  std::string_view composition = {};  // of that with the linear part and the damping
  std::unique_ptr<Stepper> (*make)(const MethodEntry&, const System&, const MethodOptions&) = nullptr;
  // The same with errors of its steps, for variable ones.
  std::unique_ptr<AdaptiveStepper> (*make_adaptive)(const MethodEntry&, const System&, const MethodOptions&) = nullptr;
  // One of these, where `make` asks for it:
  std::unique_ptr<Closure> (*make_closure)(const System&, const MethodOptions&) = nullptr;
  std::unique_ptr<BaseStep> (*make_base)(const MethodEntry&, const System&, const PhiEvaluator&,
                                         const MethodOptions&) = nullptr;

  // Options that have a meaning for it, beside `law` of those that project:
  bool takes_C = false, takes_auxiliary = false, takes_refresh = false, takes_solver = false, takes_linear = false;
  bool takes_predictor = false;

  // Problems that it applies to:
  bool merges_damping = false;   // those that with_damping_merged can restate
  bool takes_structure = false;  // S(z) too
  bool takes_force = true;       // f(t) too

  bool splits_damping = false;       // by its flow before and after the rest
  bool holds_rate_of_start = false;  // what γ(t) − γ(0) does is a force for it
  MembersTogether members = MembersTogether::none;

  // What it keeps, in doubles per unknown: so many, or as many as its tables of φ-functions ask for, with `per_mode`
  // unknowns to a mode.
  double doubles = 0;
  double (*doubles_with_tables)(int order, Index size, bool variable_steps, double per_mode) = nullptr;
};

struct MethodEntry {
  std::string_view name;
  MethodKind kind;
  PropagatorKind propagator;
  int order;
  std::string_view kept_energy;            // the one that never grows: "H" or "H_modified"
  std::string_view reference;              // where the scheme comes from
  EnergyLaw projection = EnergyLaw::none;  // the strongest law a projection can give it; none: it keeps one of its own

  bool projects() const { return projection != EnergyLaw::none; }
  bool has_closure() const { return kind.make_closure != nullptr; }
};

std::span<const MethodEntry> methods();
std::vector<std::string> method_names();
const MethodEntry& find_method(std::string_view name);  // throws unknown_method(name)

// With the mode that `automatic` stands for.
MethodOptions settled(const MethodEntry& method, const System& system, MethodOptions options);

// `method` is a row of the list, or one like them. `system` outlives the stepper; for methods that merge the damping it
// comes from with_damping_merged(problem).
std::unique_ptr<Stepper> make_stepper(const MethodEntry& method, const System& system,
                                      const MethodOptions& options = {});
// The same with errors of its steps, for variable ones.
std::unique_ptr<AdaptiveStepper> make_adaptive_stepper(const MethodEntry& method, const System& system,
                                                       const MethodOptions& options = {});

std::string to_string(PropagatorKind propagator);

}  // namespace seiche
