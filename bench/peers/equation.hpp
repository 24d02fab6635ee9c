// A problem of the work–precision bench in plain numbers: all that a peer is told. Peers are compiled for the processor
// at hand, and therefore share no type with the library whose layout depends on the instruction set (Eigen's do).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace seiche::bench {

// With R the central second difference and ∂ the central first difference of width Δx:
//   klein_gordon  u' = v, v' = κRu − m²u − αu³ − γv                              periodic, one or two dimensions
//   alpha_fpu     u' = v, v' = Ru − m²u − ∇W(u) + βRv − γv, W = ε/(6Δx³) Σ(u_{j+1} − u_j)³      u = 0 at both ends
//   gkdv          u' = ∂(−εRu − σu²) − μu                                                      periodic
//   allen_cahn    u' = κRu + u − u³                                                periodic, two dimensions
//   cahn_hilliard u' = R(u³ − u − κRu)                                             periodic, two dimensions
struct Equation {
  enum class Kind { klein_gordon, alpha_fpu, gkdv, allen_cahn, cahn_hilliard };

  Kind kind = Kind::klein_gordon;
  std::size_t rows = 1;  // of unknowns; 1 in one dimension
  std::size_t columns = 1;
  double dx = 1.0;            // length
  double stiffness = 1.0;     // κ, 1, ε or κ
  double mass_squared = 0.0;  // m²
  double strength = 0.0;      // α, ε or σ of the nonlinear term
  double gamma = 0.0;         // γ or μ, 1/time
  double beta = 0.0;          // length²/time
  double t_end = 1.0;
  // Of the right-hand side in one call of Run::advance: an adaptive integrator can sink into a stiff problem for hours.
  std::int64_t most_evaluations = std::numeric_limits<std::int64_t>::max();
  std::vector<double> initial;  // field-major

  std::size_t unknowns() const { return rows * columns; }  // per field
  std::size_t size() const { return initial.size(); }
  bool is_second_order() const { return kind == Kind::klein_gordon || kind == Kind::alpha_fpu; }  // in time
  bool is_gradient_flow() const { return kind == Kind::allen_cahn || kind == Kind::cahn_hilliard; }
  bool is_periodic() const { return kind != Kind::alpha_fpu; }
};

}  // namespace seiche::bench
