// The solution of a collocation step at any time inside it, and the error at its end.
#pragma once

#include <seiche/core/numerics/quadrature.hpp>
#include <seiche/core/phi.hpp>
#include <seiche/core/step_cache.hpp>

#include <memory>
#include <vector>

namespace seiche {

// The collocation polynomial of the forces has degree s − 1, and the solution it gives inside the step the order s + 1.
// The polynomial of degree 2s − 1 through the forces of this step and of the one before has errors of the order of the
// method, 2s, everywhere; what it gives at the end beyond the collocation step is of the size of the local error,
// O(h^{2s+1}).
class ContinuousExtension {
 public:
  // Of a step of length h after one of length history_h; 0: no step before, and inside the step order s + 1 is all
  // there is.
  struct Step {
    double h = 0.0, history_h = 0.0;
  };

  // `phi` outlives the extension; states have `size` components.
  ContinuousExtension(const PhiEvaluator& phi, const GaussRule& rule, PhiRows::Forces kind, Index size);

  // z ← the solution at tₙ + θh, from zⁿ and the forces of both steps.
  void evaluate(const Step& step, double theta, const Vector& z_before, std::span<const Vector> forces_before,
                std::span<const Vector> forces, Vector& z);
  // Builds what `defect` needs for steps of one length, and of the same length as the one before.
  void prepare(double h) { defect_maps({h, h}); }
  // The difference at the end, in the coordinates of the state; a reference to scratch. history_h must not be 0.
  const Vector& defect(const Step& step, std::span<const Vector> forces_before, std::span<const Vector> forces);
  // m ← h²∫₀¹ (1 − θ)d(θ) dθ of the difference d of the two polynomials, as a force. With L = 0 the defect above is
  // zero, since Gauss's rule integrates d, which vanishes at its nodes, exactly: what is left of the error is N′m.
  void moment(const Step& step, std::span<const Vector> forces_before, std::span<const Vector> forces, Vector& m);

 private:
  struct Maps {
    double history_h = 0.0;
    std::unique_ptr<PhiMap> of_before, of_this;
    Eigen::VectorXd moments;  // weights of the forces before, then of these
  };
  Maps maps(const Step& step, double theta, bool difference) const;
  const Maps& defect_maps(const Step& step);

  const PhiEvaluator& phi_;
  GaussRule rule_;
  PhiRows::Forces kind_;
  StepCache<std::vector<Maps>> defects_;
  std::vector<Vector> out_, rest_;
};

}  // namespace seiche
