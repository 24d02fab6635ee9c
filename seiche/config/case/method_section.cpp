#include <seiche/config/case/case_reading.hpp>
#include <seiche/config/case/method_section.hpp>
#include <seiche/core/error.hpp>

#include <array>
#include <optional>

namespace seiche {
namespace {

class MethodSection {
 public:
  explicit MethodSection(CaseReading& reading) : r_(reading), spec_(reading.spec) {}

  void read() {
    if (r_.problem != nullptr) spec_.method = r_.problem->default_method;
    const MethodEntry* method = &find_method(spec_.method);
    r_.on("method", "name", [&](const std::string&, const CaseValue& value) {
      method = nullptr;
      std::vector<std::string> names = method_names();
      names.emplace_back("auto");
      spec_.method = read_name("method", value, names);
      method = spec_.method == "auto" ? nullptr : &find_method(spec_.method);
    });
    read_tolerance();
    read_step_size();
    for (const MethodOptionKey& option : method_option_keys()) read_option(option, method);
  }

 private:
  // Each option is validated alone too, so that the complaint is at the key that caused it.
  void read_option(const MethodOptionKey& option, const MethodEntry* method) {
    r_.on("method", option.name, [&](const std::string& key, const CaseValue& value) {
      MethodOptions alone;
      option.read(alone, key, value);
      if (!r_.methods.empty())
        require_one_that_knows(alone);
      else if (spec_.method == "auto" && alone != MethodOptions{})
        throw Error(
            "{} belongs to one method, and method.name = \"auto\" is yet to choose it: leave {} out, or name a method",
            key, option.name);
      else if (method != nullptr)
        alone.validate(*method);
      option.read(spec_.method_options, key, value);
    });
  }

  void require_one_that_knows(const MethodOptions& options) const {
    std::optional<Error> first;
    for (const std::string& name : r_.methods) {
      try {
        return options.validate(find_method(name));
      } catch (const Error& error) {
        if (!first) first = error;
      }
    }
    throw Error(*first);
  }

  void read_tolerance() {
    r_.on("method", "tolerance", [&](const std::string& key, const CaseValue& value) {
      const double tolerance = read_number(key, value);
      if (tolerance <= 0)
        throw Error("{} = {} must be > 0: the error that steps add per unit of time, in the units of the fields", key,
                    value.shown());
      spec_.tolerance = tolerance;
    });
    r_.on("method", "h_max", [&](const std::string& key, const CaseValue& value) {
      const double h = read_number(key, value);
      if (h <= 0) throw Error("{} = {} must be > 0", key, value.shown());
      if (!r_.asks_for_tolerance())
        throw Error("{} = {} needs method.tolerance: it bounds steps of variable size", key, value.shown());
      spec_.h_max = h;
    });
  }

  void read_step_size() {
    const auto read = [&](const std::string& key, const CaseValue& value) {
      const double h = read_number(key, value);
      if (h <= 0) throw Error("{} = {} must be > 0", key, value.shown());
      if (r_.problem == nullptr && spec_.duration() == 0) return;
      if (h > spec_.duration())
        throw Error("{} = {} must be ≤ {}", key, value.shown(),
                    spec_.t_start == 0 ? fmt::format("time.end = {}", spec_.t_end)
                                       : fmt::format("{}, the time from time.start to time.end", spec_.duration()));
      if (spec_.duration() / h > 1e15)
        throw Error("{} = {} would take {:.3g} steps", key, value.shown(), spec_.duration() / h);
      spec_.h = h;
    };
    if (r_.on("method", "h", read) || r_.problem == nullptr || r_.asks_for_tolerance()) return;
    spec_.h = read_number("method.h", default_value(r_.problem->default_h));
    spec_.h_is_default = spec_.h <= spec_.duration();
    if (spec_.h_is_default) return;
    spec_.h = spec_.duration();
    spec_.notes.push_back(
        fmt::format("method.h is not given and its default {} is more than the time of the run: h = {}",
                    r_.problem->default_h, spec_.h));
  }

  CaseReading& r_;
  RunSpec& spec_;
};

}  // namespace

void read_method_section(CaseReading& reading) { MethodSection(reading).read(); }

std::span<const MethodOptionKey> method_option_keys() {
  static const std::array<MethodOptionKey, 6> keys = {{
      {"C",
       [](MethodOptions& options, const std::string& key, const CaseValue& value) {
         if (value.kind == CaseValue::Kind::text && value.text == "auto") return;
         if (value.kind != CaseValue::Kind::number && value.kind != CaseValue::Kind::text)
           throw Error("{} = {} must be a number or \"auto\"", key, value.shown());
         options.C = read_number(key, value);
       }},
      {"auxiliary",
       [](MethodOptions& options, const std::string& key, const CaseValue& value) {
         const std::string name = read_name(key, value, {"transport", "frozen", "refresh"});
         options.auxiliary = name == "frozen"    ? AuxiliaryMode::frozen
                             : name == "refresh" ? AuxiliaryMode::refresh
                                                 : AuxiliaryMode::transport;
       }},
      {"scalar_solver",
       [](MethodOptions& options, const std::string& key, const CaseValue& value) {
         const bool newton = read_name(key, value, {"robust", "newton"}) == "newton";
         options.scalar_solver = newton ? ScalarSolver::newton : ScalarSolver::robust;
       }},
      {"law",
       [](MethodOptions& options, const std::string& key, const CaseValue& value) {
         const std::string name = read_name(key, value, energy_law_names());
         options.law = name == "interval" ? EnergyLaw::interval : name == "guard" ? EnergyLaw::guard : EnergyLaw::none;
       }},
      {"linear",
       [](MethodOptions& options, const std::string& key, const CaseValue& value) {
         const bool kicks = read_name(key, value, {"exact", "explicit"}) == "explicit";
         options.linear = kicks ? LinearTreatment::explicit_kicks : LinearTreatment::exact;
       }},
      {"predictor",
       [](MethodOptions& options, const std::string& key, const CaseValue& value) {
         const bool remembered = read_name(key, value, {"remembered", "gradient"}) == "remembered";
         options.predictor = remembered ? Predictor::remembered : Predictor::gradient;
       }},
  }};
  return keys;
}

}  // namespace seiche
