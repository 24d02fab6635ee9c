// Whatever stands in a formula, it is read or refused with a sentence: no crash, no hang, no leak.
#include <seiche/config/custom/energy_split.hpp>
#include <seiche/config/custom/operator_formula.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/potential/formula_potential.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace seiche {
namespace {

const std::vector<std::string> variables = {"u", "v", "x", "t"};
const FormulaConstants constants = {{"kappa", 0.04}, {"k", 3.0}};

template <class Action>
void ignoring_refusals(const Action& action) {
  try {
    action();
  } catch (const Error&) {
  }
}

void read(const std::string& text) {
  const Grid grid{.axes = {{8, 2.0, Boundary::periodic}}};
  ignoring_refusals([&] {
    const FormulaPointer f = compile_formula(text, variables, constants);
    const std::vector<double> at = {0.3, -0.7, 1.1, 0.5};
    (*f)(at);
    (*differentiate(*f, "u"))(at);
  });
  ignoring_refusals([&] {
    const EnergySplit split = split_energy("H", text, {.fields = {"u", "v"}, .axes = 1}, constants, {});
    for (const FieldFormula& f : split.per_point) {
      const auto V = formula_potential(f.w, grid);
      const std::vector<double> a(8 * static_cast<std::size_t>(f.count), 0.3), b(a.size(), 0.4);
      std::vector<double> out(a.size());
      V->value_and_gradient(a, out);
      V->mean_gradient(a, b, out);
    }
  });
  ignoring_refusals([&] { compile_operator("D", text, grid, 1, Discretisation::fd2, constants, true); });
}

}  // namespace
}  // namespace seiche

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  seiche::read(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
