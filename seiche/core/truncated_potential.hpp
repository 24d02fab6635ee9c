// V(Pu), with P the projection on the modes that the two-thirds rule keeps (Orszag 1971).
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/core/grid/modes.hpp>
#include <seiche/core/potential.hpp>

#include <memory>
#include <vector>

namespace seiche {

// |k| < N/3 along every axis: products of two such modes then fold back onto none of them, and a quadratic force is
// free of aliases; a cubic one is rid of most.
bool is_kept(const Mode& mode);

// As the gradient of V∘P, the force P∇V(Pu) obeys every energy law that ∇V does. Physical values, N multiplications per
// point and axis; a backend with modes masks them instead.
class TruncatedPotential final : public PointwisePotential {
 public:
  // Throws Error unless the grid is periodic along every axis.
  TruncatedPotential(std::shared_ptr<const PointwisePotential> potential, const Grid& grid);
  const std::shared_ptr<const PointwisePotential>& whole() const { return potential_; }  // V

  Index fields() const override { return potential_->fields(); }
  std::shared_ptr<const PointwisePotential> at_points(Index first, Index count) const override;  // with all of P
  double value(std::span<const double> u) const override;
  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override;
  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override;
  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override;
  int degree() const override { return potential_->degree(); }
  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override;
  int homogeneity() const override { return potential_->homogeneity(); }
  bool grows_outward() const override { return potential_->grows_outward(); }  // u·P∇V(Pu) = Pu·∇V(Pu)

 private:
  struct Line {  // the projection along one axis, a convolution
    std::vector<double> kernel;
    std::size_t stride;
  };
  std::span<const double> projected(std::span<const double> u, std::vector<double>& out) const;
  void project(std::span<double> u) const;

  std::shared_ptr<const PointwisePotential> potential_;
  std::vector<Line> lines_;
};

}  // namespace seiche
