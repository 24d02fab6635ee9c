// The one scalar equation of the multiplier closures (lm, dm), in a form free of cancellation.
#pragma once

#include <seiche/core/potential.hpp>
#include <seiche/core/space.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace seiche {

// (3.9) of lm and (D2) of dm: on the line z⁺(x) = z₁ + xq with force f(x) = ĝ + xe and increment δ(x) = δ₁ + xq, find x
// with
//   F(x) = V(z⁺(x)) − V(z) − f(x)ᵀδ(x) = (ḡ(x) − ĝ − xe)ᵀδ(x) = 0,   ḡ(x) = ∫₀¹ ∇V(z + sδ(x)) ds.
// Expanded about x = 0, the explicit step, so that a small F is computed as a small number. For polynomial V the
// expansion is exact and an evaluation costs O(degree); otherwise each one costs a mean gradient and a gradient.
class MultiplierEquation {
 public:
  struct Line {
    const Vector& z;       // start
    const Vector& z_plus;  // z₁
    const Vector& delta;   // δ₁ = z₁ − z
    const Vector& q;       // direction
    const Vector& g;       // ĝ
    const Vector& e;       // change of the force with x
  };
  // Where V is measured at other points than the ends of δ (frozen auxiliary: zⁿ and Ψz⁺).
  struct MeasuredAt {
    const Vector& start;
    const Vector& end;        // at x = 0
    const Vector& direction;  // change of `end` with x
  };
  struct Value {
    double F;  // with what is to be made up for
    double slope;
    double scale;  // of the terms that F is the difference of: an upper bound, by |δ₁| + |x||q| for |δ(x)|
    bool is_resolved() const { return std::abs(F) <= 4 * epsilon * scale + std::numeric_limits<double>::min(); }
    // The terms themselves underflow: a solution that has decayed to nothing has no multiplier to find.
    bool is_negligible() const { return scale <= std::numeric_limits<double>::min() / epsilon; }
  };
  struct Root {
    double x = 0.0;
    int iterations = 0;
    bool converged = false;
  };
  enum class Stop { residual, residual_or_update };

  MultiplierEquation(const Space& space, const Potential& potential);  // which outlive it
  // The vectors of the line must live and keep their values for as long as the equation is evaluated.
  void set(const Line& line, const MeasuredAt* measured_at = nullptr);
  // What the steps before have left of the law, F is to make up for: F(x) + left = 0, until the next `set`. No more
  // than F is solved to: that outweighs what each step leaves, and the equation has a root wherever it had one.
  void make_up_for(double left) {
    const double most = 4 * epsilon * scales_[0];
    left_ = std::clamp(left, -most, most);
  }

  Value at(double x);
  // |F| ≤ 4ε scale, or (lm) |Δx| ≤ 4ε max(1, |1 + x|); or else |F| ≤ what round-off may make of it.
  Root newton(int max_iterations, Stop stop);

  double cosine() const { return cosine_; }                 // cos(ĝ, δ₁) over the support of V
  double mean_gradient_norm() const { return mean_norm_; }  // |ḡ(0)|
  double gradient_gap() const { return gap_norm_; }         // |ḡ(0) − ĝ|
  // Is that no more than round-off makes of a mean gradient, whose terms cancel?
  bool gap_is_round_off();
  double change(double x) { return at(x).F - left_; }  // V(z⁺) − V(z) − fᵀδ itself

 private:
  Value at_by_quadrature(double x);
  double round_off();  // of F, where the terms of ∇V cancel

  const Space& space_;
  const Potential& potential_;
  std::vector<double> coefficients_;  // of F, for polynomial V; empty otherwise
  std::array<double, 3> scales_{};    // of 1, |x|, x²
  double cosine_ = 0, mean_norm_ = 0, gap_norm_ = 0;
  double left_ = 0;
  double gd_ = 0, linear_ = 0, eq_ = 0;  // f(x)ᵀδ(x) = ĝᵀδ₁ + x (ĝᵀq + eᵀδ₁) + x² eᵀq
  Vector mean_;
  const Vector *delta_ = nullptr, *start_ = nullptr;
  // For general V only:
  const Vector *q_ = nullptr, *g_ = nullptr, *e_ = nullptr, *end_0_ = nullptr, *direction_ = nullptr;
  bool measured_elsewhere_ = false;
  Vector end_, gradient_, increment_;
};

}  // namespace seiche
