// Exponentials of the whole linear part L = SM − D₀, for collocation and exponential Runge–Kutta methods.
//   φ₀(A) = e^A,   φ_k(A) = ∫₀¹ e^{(1−s)A} s^{k−1}/(k−1)! ds
#pragma once

#include <seiche/core/base/vector.hpp>

#include <memory>
#include <span>
#include <vector>

namespace seiche {

// One sum  φ₀(θhL)z + h Σ_j Σ_k w_jk φ_{k+1}(θhL) n_j  of φ-functions times a state z and forces n_j.
struct PhiRow {
  double theta = 1.0;
  std::vector<double> weights = {};  // w_jk at [j · order + k], k = 0 … order − 1
};

struct PhiRows {
  // n_j = S f_j with f_j a gradient, known on the support of V only; or n_j = f_j, any state
  enum class Forces { gradients, states };
  enum class Outputs { support, all };  // which components are asked for: those V depends on, or every one

  std::vector<PhiRow> rows;
  Index forces = 0;  // how many
  Index order = 0;   // how many φ-functions of each
  Forces kind = Forces::gradients;
  Outputs outputs = Outputs::all;
  bool of_state = true;  // without: no term φ₀(θhL)z
};

// hφ₁(hL) of one force: what it adds to z if it is constant over the step.
inline PhiRows rows_of_constant_force(PhiRows::Forces kind) {
  return {.rows = {{1.0, {1.0}}}, .forces = 1, .order = 1, .kind = kind, .of_state = false};
}

// A few such sums for one h.
class PhiMap {
 public:
  virtual ~PhiMap() = default;
  // As many forces and outputs as there are in the rows; outputs may be the vectors of the forces, but not z.
  virtual void apply(const Vector& z, std::span<const Vector> forces, std::span<Vector> out) const = 0;
};

// Σ_i c_i Q(row i), with Q(z) = zᵀ(sym(MD₀) − M sym(S) M)z: what linear damping takes from H per time.
class PhiForms {
 public:
  virtual ~PhiForms() = default;
  // values[l]: the sum with the coefficients of form l
  virtual void apply(const Vector& z, std::span<const Vector> forces, std::span<double> values) const = 0;
};

// Contract: for forces that are constant in time, a row with θ = 1 and weights 1, 0, … is the exact solution of
// ż = Lz + Σn_j after the time h.
class PhiEvaluator {
 public:
  struct Form {
    PhiRows rows;
    std::vector<double> coefficients;  // one per row
    // Less ∫₀ʰ Q(x) dt along ẋ = Lx + Σn_j from z: of a quadrature of Q along x, its error.
    bool minus_integral = false;
  };

  virtual ~PhiEvaluator() = default;
  // True if maps are tables, so that applying one costs at most a gradient of V or two. Where each is a Krylov space,
  // methods must ask for as few as they can.
  virtual bool has_tables() const { return false; }
  // Solutions of ż = Lz turn and decay no faster than this: at least the largest modulus of an eigenvalue, and seldom
  // much more.
  virtual double rate() const = 0;
  virtual std::unique_ptr<PhiMap> map(const PhiRows& rows, double h) const = 0;
  // Forms of the same forces and order.
  virtual std::unique_ptr<PhiForms> forms(std::span<const Form> forms, double h) const = 0;

  struct Dissipation {
    bool is_quadratic = false;    // −dH/dt = Q(z) along solutions, whatever V
    bool is_nonnegative = false;  // and Q ⪰ 0
    bool is_zero = false;         // and Q = 0
  };
  virtual Dissipation dissipation() const = 0;

  // d = z − Πz, with Π the orthogonal projector on ker S, whose products with z are the linear Casimirs; false if
  // ker S = {0}: then d is not written, and stands for z.
  virtual bool without_casimirs(const Vector& z, Vector& d) const = 0;
};

}  // namespace seiche
