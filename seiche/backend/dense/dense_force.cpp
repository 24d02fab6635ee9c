#include <seiche/backend/dense/dense_force.hpp>
#include <seiche/backend/phi/dense_kernel.hpp>
#include <seiche/backend/phi/energy_coordinates.hpp>
#include <seiche/backend/phi/force_map.hpp>
#include <seiche/core/base/error.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace seiche {
namespace {

using Matrix = Eigen::MatrixXd;

// Up to this hρ, with ρ the spectral radius of SM, round-off in F itself leaves the energy law alone, if ‖hSM‖ is of
// that size or the contract says so.
constexpr double plain_size = 16;
constexpr double within_round_off = 1e-14;  // of a product with one matrix instead of two
constexpr double most_defect = 1e-13;

// G + Gᵀ + GᵀMG, of which the contract says that it is ⪯ 0, and how much of it may be round-off.
struct Contract {
  Contract(const Matrix& G, const Matrix& M, double h)
      : R((h < 0 ? -1 : 1) * (G + G.transpose() + congruence(M, G))),
        room(most_defect * std::max(1.0, G.cwiseAbs().maxCoeff())) {}
  bool holds() const {
    return R.allFinite() &&
           Eigen::LLT<Matrix>(room * Matrix::Identity(R.rows(), R.cols()) - R).info() == Eigen::Success;
  }
  Matrix R;
  double room;
};

// `size` and `norm`: hρ and ‖hSM‖.
void require_contract(const Matrix& G, const Matrix& M, double h, double size, double norm) {
  const Contract contract(G, M, h);
  if (contract.holds()) return;
  double defect = std::numeric_limits<double>::infinity();
  if (contract.R.allFinite()) {
    defect = Eigen::SelfAdjointEigenSolver<Matrix>(contract.R, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    if (defect <= contract.room) return;
  }
  throw Error(
      "the dense backend cannot keep the energy law of a step h = {:.6g}: its fastest frequency ρ has hρ = {:.3g}, ‖hSM‖ = {:.3g}, and H would rise "
      "by {:.2g} of itself; take a smaller h, backend \"modal\" on a grid, or backend \"sparse\" with [backend] pade_degree = 2",
      h, size, norm, defect);
}

// Is the product TA as good as first A, then T? Judged in the coordinates of energy.
bool may_join(const Matrix& TA, const EnergyCoordinates<Matrix>& c, const Matrix& right, const Matrix& G) {
  const Matrix back = c.inverse * TA * right;
  return (back - G).cwiseAbs().maxCoeff() <= within_round_off * std::max(1.0, G.cwiseAbs().maxCoeff());
}

// xᵀAx < 0 for some x, beyond round-off?
bool has_negative_direction(const Matrix& A) {
  const double round_off = 1e-13 * A.cwiseAbs().maxCoeff();
  if (round_off == 0) return false;
  const Matrix shifted = A + round_off * Matrix::Identity(A.rows(), A.cols());
  return Eigen::LLT<Matrix>(shifted).info() != Eigen::Success;
}

class InEnergyCoordinates {
 public:
  InEnergyCoordinates(PropagatorKind kind, EnergyCoordinates<Matrix> c, const Matrix& S)
      : kind_(kind),
        c_(std::move(c)),
        S_(c_.structure(S)),
        M_(c_.metric()),
        rate_(c_.loss(S)),
        feeds_(has_negative_direction(rate_)),
        casimirs_(dense_kernel<Matrix>(S.transpose())),
        unmoved_(feeds_ ? dense_kernel(S) : casimirs_),
        kernels_{orthonormal(c_.T.transpose() * casimirs_), orthonormal(c_.T.transpose() * unmoved_)} {}

  Matrix force(double h) const {
    if (kind_ == PropagatorKind::exponential) {
      Matrix G = exponential_force(S_, M_, rate_, h);
      kernels_.restore(G);
      return G;
    }
    return contracting_cayley_force(S_, M_, rate_, kernels_, h);
  }

  DenseForce maps(double h, double size, double norm) const {
    const Matrix G = force(h);
    if (!feeds_) require_contract(G, M_, h, size, norm);
    const Matrix T = without(casimirs_);  // else up to round-off of what is fast
    const Matrix of_force = feeds_ ? without(unmoved_) : T;
    const Matrix half = kind_ == PropagatorKind::cayley ? Matrix(G / 2) : force(h / 2);
    const Matrix of_state = M_ * c_.inverse;
    DenseForce maps{G * of_force.transpose(), G * of_state, half * of_force.transpose(), half * of_state, T};
    const Matrix F = T * maps.F;
    const Matrix FM = T * maps.FM;
    if (!may_join(FM, c_, c_.T, G * M_) || !may_join(F, c_, c_.inverse.transpose(), G)) return maps;
    return {F, FM, T * maps.Q, T * maps.QM, {}};
  }

 private:
  PropagatorKind kind_;
  static Matrix orthonormal(const Matrix& columns) {
    if (columns.cols() == 0) return columns;
    return Eigen::HouseholderQR<Matrix>(columns).householderQ() * Matrix::Identity(columns.rows(), columns.cols());
  }

  Matrix without(const Matrix& columns) const { return c_.T - columns * (columns.transpose() * c_.T); }

  EnergyCoordinates<Matrix> c_;
  Matrix S_, M_, rate_;
  bool feeds_;               // sym(S) ⪯ 0 fails: there is no contract to keep
  Matrix casimirs_;          // cᵀS = 0: their products with z do not move
  Matrix unmoved_;           // Sc = 0: forces that do nothing
  Kernels<Matrix> kernels_;  // both, in y
};

}  // namespace

DenseForce dense_force(PropagatorKind kind, const Matrix& S, const Matrix& M, double h) {
  const Matrix A = h * (S * M);
  const double size = scaled_norm<Matrix>(A);
  if (!std::isfinite(size))
    throw Error(
        "(hSM)³ of the dense backend is not finite for h = {:.6g}: take a smaller h, or other units of length and time",
        h);
  std::optional<EnergyCoordinates<Matrix>> coordinates;
  const double norm = force_map_detail::norm_1(A);
  if (norm > plain_size) coordinates = energy_coordinates(M);
  if (coordinates) coordinates->scale_kernel(kernel_unit(*coordinates, S, h));
  const auto in_energy_coordinates = [&] {
    return InEnergyCoordinates(kind, *std::move(coordinates), S).maps(h, size, norm);
  };
  if (coordinates && size > plain_size) return in_energy_coordinates();
  const ForceMaps<Matrix> maps = force_maps(kind, S, M, h);
  // Where A is far from normal, round-off is more than hρ tells; where S feeds, there is no contract to ask for.
  if (coordinates && !has_negative_direction(coordinates->loss(S))) {
    const Matrix G = coordinates->inverse * maps.F * coordinates->inverse.transpose();
    if (!Contract(G, coordinates->metric(), h).holds()) return in_energy_coordinates();
  }
  return {maps.F, maps.F * M, maps.Q, maps.Q * M, {}};
}

}  // namespace seiche
