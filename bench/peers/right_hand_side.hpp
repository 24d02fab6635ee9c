// ż by central differences, as a user of an ODE library writes it.
#pragma once

#include <bench/peers/equation.hpp>

#include <cstdint>
#include <vector>

namespace seiche::bench {

class RightHandSide {
 public:
  explicit RightHandSide(const Equation& equation);

  std::size_t size() const { return equation_.size(); }
  void full(const double* z, double* dz);
  void linear(const double* z, double* dz) const;                     // Az
  void nonlinear(const double* z, double* dz) const;                  // ż − Az
  void jacobian(const double* z, const double* w, double* jw) const;  // (∂ż/∂z) w

  std::int64_t evaluations = 0;  // of full

  void begin_advance() { first_ = evaluations; }
  bool is_exhausted() const { return evaluations - first_ > equation_.most_evaluations; }
  static constexpr const char* exhausted = "gave up: needs far more evaluations than the cap allows";

 private:
  void wave(const double* z, double* dz) const;
  void fpu(const double* z, double* dz) const;
  void gkdv(const double* z, double* dz) const;
  void allen_cahn(const double* u, double* du) const;
  void cahn_hilliard(const double* u, double* du) const;

  const Equation equation_;
  std::int64_t first_ = 0;            // evaluations when the advance began
  mutable std::vector<double> flux_;  // one value beyond each end
};

// out_j += factor (R u)_j / Δx² on the grid of the equation
void add_laplacian(const Equation& equation, double factor, const double* u, double* out);

}  // namespace seiche::bench
