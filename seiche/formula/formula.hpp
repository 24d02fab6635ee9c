// A compiled formula: all that the rest of the library sees of computer algebra. config/ compiles text into one.
#pragma once

#include <seiche/formula/formula_program.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace seiche {

// A real function of a few variables, f(x₀, x₁, …). Evaluation allocates nothing and never throws: what is not
// real or not finite comes back as NaN or ±∞, and the caller checks.
class Formula {
 public:
  virtual ~Formula() = default;
  virtual double operator()(std::span<const double> arguments) const = 0;
  virtual std::span<const Instruction> program() const = 0;
  virtual const std::string& text() const = 0;  // as the user wrote it
  // Coefficients c₀, c₁, … where f is a polynomial of one variable; nothing otherwise.
  virtual const std::optional<std::vector<double>>& polynomial() const = 0;

  double operator()(double x) const { return (*this)(std::span<const double>(&x, 1)); }
};

using FormulaPointer = std::shared_ptr<const Formula>;

}  // namespace seiche
