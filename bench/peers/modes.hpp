// The modes of an equation's grid by FFTW, and its linear part on each.
#pragma once

#include <bench/peers/equation.hpp>

#include <complex>
#include <memory>
#include <span>
#include <vector>

namespace seiche::bench {

// Coefficients are pairs (Re, Im) of a real-to-complex transform on periodic grids, and real coefficients of sines
// otherwise. Transforms carry no factor: to_points(to_modes(u)) = u / scale().
class ModeTransform {
 public:
  explicit ModeTransform(const Equation& equation);
  ~ModeTransform();
  ModeTransform(const ModeTransform&) = delete;
  ModeTransform& operator=(const ModeTransform&) = delete;

  std::size_t slots() const { return slots_; }  // doubles per field
  double scale() const { return scale_; }
  void to_modes(const double* u, double* coefficients);
  void to_points(const double* coefficients, double* u);

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
  bool is_periodic_;
  std::size_t points_, slots_;
  double scale_;
};

// Eigenvalues on every slot of −R (λ) and of the central first difference (i·derivative).
struct Symbols {
  std::vector<double> lambda, derivative;
};
Symbols symbols(const Equation& equation);
// The linear part of an equation of first order in time on slot k.
std::complex<long double> scalar_symbol(const Equation& equation, const Symbols& symbols, std::size_t k);

// (I − cA)⁻¹, for implicit methods: a 2×2 block or a complex number per mode.
class LinearSolve {
 public:
  explicit LinearSolve(const Equation& equation);
  void operator()(double c, const double* right, double* solution);

 private:
  const Equation equation_;
  ModeTransform transform_;
  Symbols symbols_;
  std::vector<double> u_, v_;
};

}  // namespace seiche::bench
