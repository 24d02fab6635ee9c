#include <seiche/config/case/method_option_keys.hpp>
#include <seiche/core/error.hpp>

#include <array>

namespace seiche {

std::span<const MethodOptionKey> method_option_keys() {
  static const std::array<MethodOptionKey, 5> keys = {{
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
  }};
  return keys;
}

}  // namespace seiche
