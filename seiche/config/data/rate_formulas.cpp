#include <seiche/config/data/rate_formulas.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>

namespace seiche {
namespace {

class FormulaOfState final : public StateFunction {
 public:
  explicit FormulaOfState(FormulaPointer formula) : formula_(std::move(formula)) {}
  double operator()(double u) const override { return (*formula_)(u); }
  std::string text() const override { return formula_->text(); }

 private:
  FormulaPointer formula_;
};

}  // namespace

FormulaPointer compiled_or_null(const std::string& text, const std::vector<std::string>& variables,
                                const FormulaConstants& constants) {
  try {
    return compile_formula(text, variables, constants);
  } catch (const Error&) {
    return nullptr;
  }
}

SpaceRatePointer compile_space_rate(const std::string& key, const std::string& text, const FormulaConstants& constants,
                                    const NameAdvice& advice) {
  const std::vector<std::string> names = {"t", "x", "y", "z"};
  const auto end = [&](Index axes) { return names.begin() + axes + 1; };
  if (FormulaPointer formula = compiled_or_null(text, {"t"}, constants))
    return uniform_space_rate(formula_rate(std::move(formula)));
  Index axes = 1;
  while (axes < 3 && !compiled_or_null(text, {names.begin(), end(axes)}, constants)) ++axes;
  try {
    FormulaPointer formula = compile_formula(text, {names.begin(), end(axes)}, constants, advice);
    const bool constant_in_time = compiled_or_null(text, {names.begin() + 1, end(axes)}, constants) != nullptr;
    return formula_space_rate(std::move(formula), axes, constant_in_time);
  } catch (const Error& error) {
    throw Error("{}: {}", key, error.what());
  }
}

DampingRate compile_damping_rate(const std::string& key, const std::string& text, const FormulaConstants& constants) {
  if (FormulaPointer formula = compiled_or_null(text, {"t"}, constants)) return formula_rate(std::move(formula));
  return compile_space_rate(key, text, constants);
}

StateFunctionPointer compile_state_function(const std::string& text, const std::string& field,
                                            const FormulaConstants& constants) {
  return std::make_shared<FormulaOfState>(compile_formula(text, {field}, constants));
}

}  // namespace seiche
