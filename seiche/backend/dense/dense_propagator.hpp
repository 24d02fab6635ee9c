// The linear substep of the dense backend: each of its maps is one product with a matrix.
#pragma once

#include <seiche/backend/dense/dense_force.hpp>
#include <seiche/backend/dense/lane_matrix.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/propagator.hpp>

#include <memory>

namespace seiche {

// ½zᵀMz, at the cost of the part of M that is not the identity.
class DenseMetric {
 public:
  explicit DenseMetric(const Eigen::MatrixXd& M);
  double energy(const double* z) const;

  struct View {  // as that of a LaneMatrix
    LaneMatrix::View M;
    double* Mz;
    Index size;

    template <class V>
    [[gnu::always_inline]] inline double energy(const double* z) const;  // for dense_propagator.cpp alone
  };
  View view() const { return {M_.view(), Mz_.data(), size_}; }

 private:
  Index size_, leading_;  // rows and columns from leading_ on are those of the identity
  LaneMatrix M_;
  mutable Vector Mz_;
};

// `metric` outlives the propagator.
std::unique_ptr<Propagator> dense_propagator(const DenseForce& maps, const DenseMetric& metric,
                                             Potential::Support support);

}  // namespace seiche
