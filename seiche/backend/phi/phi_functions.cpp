#include <seiche/backend/phi/dense_kernel.hpp>
#include <seiche/backend/phi/energy_coordinates.hpp>
#include <seiche/backend/phi/force_map.hpp>
#include <seiche/backend/phi/phi_functions.hpp>
#include <seiche/core/numerics/congruence.hpp>
#include <seiche/core/numerics/gauss_rule.hpp>
#include <seiche/core/phi.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace seiche {
namespace {

// e^{2ʲA} − I by j doublings of the increment, X ← 2X + X²: I + X would lose the digits of what moves slowly beside
// fast motion.
template <class Matrix>
class FlowDoubling {
 public:
  static constexpr int harmless = 8;  // doublings whose round-off in |E| needs no correction

  // X = e^{small} − I, and ‖small‖ is about ½.
  FlowDoubling(Matrix X, const Matrix& small, const FlowLoss<Matrix>& loss, int doublings)
      : X_(std::move(X)), rank_(loss.rate.size() > 0 && doublings > harmless ? loss.rank : 0), left_(doublings) {
    if (rank_ > 0 && !loss.rate.isZero(0)) start_with_loss(small, std::ldexp(1.0, -doublings) * loss.rate);
  }

  const Matrix& increment() const { return X_; }

  void doubling() {
    if (W_.size() > 0) {
      const Matrix WE = W_ + W_ * X_;
      W_ += (WE + X_.adjoint() * WE).eval();
    }
    X_ = (2 * X_ + X_ * X_).eval();
    if (rank_ == 0 || --left_ % harmless != 0) return;
    correct();
    if (left_ == 0) correct();
  }

 private:
  void start_with_loss(const Matrix& small, const Matrix& rate) {
    std::array<Matrix, 16> term;
    term[0] = Matrix::Identity(small.rows(), small.cols());
    for (std::size_t k = 1; k < term.size(); ++k) term[k] = small * term[k - 1] / static_cast<double>(k);
    W_ = Matrix::Zero(small.rows(), small.cols());
    for (const GaussNode& node : gauss_rule(8)) {
      Matrix E = term[0];
      for (std::size_t k = 1; k < term.size(); ++k) E += std::pow(node.place, static_cast<double>(k)) * term[k];
      W_ += node.weight * congruence(rate, E);
    }
  }

  void correct() {
    const auto to_energy = X_.topRows(rank_);
    Matrix defect = to_energy.leftCols(rank_) + to_energy.leftCols(rank_).adjoint() +
                    to_energy.leftCols(rank_).adjoint() * to_energy.leftCols(rank_);
    if (W_.size() > 0) defect += W_.topLeftCorner(rank_, rank_);
    X_.leftCols(rank_) -= (0.5 * (X_.leftCols(rank_) * defect)).eval();
    X_.topLeftCorner(rank_, rank_) -= 0.5 * defect;
  }

  Matrix X_, W_;
  Index rank_;
  int left_;
};

}  // namespace

// By Taylor's series of φ_order at A/2ʲ, the recurrence φ_k = Aφ_{k+1} + I/k! down from it, and j doublings:
// φ_k(2A) = 2^{−k} [φ₀(A)φ_k(A) + Σ_{l=1}^{k} φ_l(A)/(k−l)!]. No division by A anywhere.
template <class Matrix>
void phi_functions(const Matrix& A, Index order, std::vector<Matrix>& phi, const FlowLoss<Matrix>& loss) {
  const Matrix I = Matrix::Identity(A.rows(), A.cols());
  const int doublings = doublings_for(scaled_norm(A));
  const Matrix small = std::ldexp(1.0, -doublings) * A;

  const Index top = std::max<Index>(order, 1);  // φ₀ comes from φ₁
  const auto count = static_cast<std::size_t>(top) + 1;
  phi.resize(count);
  double factorial = 1;  // of k
  for (Index k = 2; k <= top; ++k) factorial *= static_cast<double>(k);
  // Σ_i Aⁱ/(top + i)! up to i = 19, four powers at a time (Paterson and Stockmeyer): seven products instead of
  // nineteen.
  constexpr Index groups = 5;
  const Matrix A2 = small * small;
  const Matrix A3 = A2 * small;
  const Matrix A4 = A2 * A2;
  std::array<double, 4 * groups> c{};
  c[0] = 1 / factorial;
  for (std::size_t i = 1; i < c.size(); ++i) c[i] = c[i - 1] / static_cast<double>(top + static_cast<Index>(i));
  Matrix sum = Matrix::Zero(A.rows(), A.cols());
  for (std::size_t i = c.size(); i > 0; i -= 4) {
    sum = (A4 * sum).eval();
    sum += c[i - 4] * I + c[i - 3] * small + c[i - 2] * A2 + c[i - 1] * A3;
  }
  phi[count - 1] = sum;
  for (Index k = top - 1; k >= 1; --k) {
    factorial /= static_cast<double>(k + 1);
    phi[static_cast<std::size_t>(k)] = small * phi[static_cast<std::size_t>(k) + 1] + I / factorial;
  }
  FlowDoubling<Matrix> flow(small * phi[1], small, loss, doublings);
  for (int j = 0; j < doublings; ++j) {
    for (Index k = order; k >= 1; --k) {  // downwards: φ_k needs the undoubled φ_l with l ≤ k only
      Matrix& own = phi[static_cast<std::size_t>(k)];
      Matrix doubled = own + flow.increment() * own;
      double inverse_factorial = 1;  // of (k − l)
      for (Index l = k; l >= 1; --l) {
        doubled += inverse_factorial * phi[static_cast<std::size_t>(l)];
        inverse_factorial /= static_cast<double>(k - l + 1);
      }
      own = std::ldexp(1.0, -static_cast<int>(k)) * doubled;
    }
    flow.doubling();
  }
  phi[0] = I + flow.increment();
  phi.resize(static_cast<std::size_t>(order) + 1);
}

template <class Matrix>
PhiRowBlocks<Matrix>::PhiRowBlocks(const PhiRows& rows, const LinearBlocks<Matrix>& blocks, double h)
    : rows_(rows), S_(blocks.S), L_(blocks.L()), h_(h) {
  constexpr double plain_size = 128;
  blocks_.resize(static_cast<std::size_t>(rows.forces) + 1);
  if (scaled_norm<Matrix>(h * L_) > plain_size) use_energy(blocks);
}

template <class Matrix>
const std::vector<Matrix>& PhiRowBlocks<Matrix>::of(const PhiRow& row) {
  const double length = row.theta * h_;
  phi_functions<Matrix>(length * L_, rows_.order, phi_, {length * rate_, rank_});
  if (rate_.size() > 0) return_to_state(length);
  blocks_[0] = rows_.of_state ? phi_[0] : Matrix::Zero(L_.rows(), L_.cols());
  for (Index j = 0; j < rows_.forces; ++j) {
    Matrix sum = Matrix::Zero(L_.rows(), L_.cols());
    for (Index k = 0; k < rows_.order; ++k)
      sum += (h_ * row.weights[static_cast<std::size_t>(j * rows_.order + k)]) * phi_[static_cast<std::size_t>(k) + 1];
    if (rows_.kind == PhiRows::Forces::gradients) sum = (sum * S_).eval();
    blocks_[static_cast<std::size_t>(j) + 1] = sum;
  }
  return blocks_;
}

template <class Matrix>
void PhiRowBlocks<Matrix>::use_energy(const LinearBlocks<Matrix>& blocks) {
  auto c = energy_coordinates(blocks.M);
  if (!c) return;
  c->scale_kernel(kernel_unit(*c, blocks.S, h_));
  const Matrix M = c->metric();
  const Matrix D = c->inverse * blocks.D0 * c->T;
  L_ = c->structure(blocks.S) * M - D;
  const Matrix MD = M * D;
  rate_ = congruence(c->loss(blocks.S), M) + MD + MD.adjoint();
  rank_ = c->rank;
  T_ = std::move(c->T);
  inverse_ = std::move(c->inverse);
  find_casimirs(blocks.D0);
}

// Columns c with cᴴS = 0, as long as damping multiplies all of them by one number: then cᴴφ_k(hL) = φ_k(−hμ)cᴴ.
template <class Matrix>
void PhiRowBlocks<Matrix>::find_casimirs(const Matrix& D0) {
  casimirs_ = dense_kernel<Matrix>(S_.adjoint());
  if (casimirs_.cols() == 0) return;
  const Matrix damped = D0.adjoint() * casimirs_;
  decay_ = std::real((casimirs_.adjoint() * damped)(0, 0));
  if ((damped - decay_ * casimirs_).cwiseAbs().maxCoeff() > 4 * epsilon * std::abs(decay_))
    casimirs_.resize(S_.rows(), 0);
}

template <class Matrix>
void PhiRowBlocks<Matrix>::return_to_state(double length) {
  for (Matrix& phi : phi_) phi = (T_ * phi * inverse_).eval();
  if (casimirs_.cols() == 0) return;
  std::vector<Eigen::MatrixXd> exact;
  phi_functions<Eigen::MatrixXd>(Eigen::MatrixXd::Constant(1, 1, -length * decay_), rows_.order, exact);
  for (std::size_t k = 0; k < phi_.size(); ++k)
    phi_[k] += (casimirs_ * (exact[k](0, 0) * casimirs_.adjoint() - casimirs_.adjoint() * phi_[k])).eval();
}

template <class Matrix>
Matrix flow_dissipation(const LinearBlocks<Matrix>& blocks, double h) {
  const Index m = blocks.M.rows();
  const PhiRows of_z_and_n{.rows = {}, .forces = 1, .order = 2, .kind = PhiRows::Forces::states};
  PhiRowBlocks<Matrix> sums(of_z_and_n, blocks, h);
  Matrix start = Matrix::Zero(m, 2 * m), end(m, 2 * m), integral(m, 2 * m), force = start;
  start.leftCols(m).setIdentity();
  force.rightCols(m).setIdentity();
  const std::vector<Matrix>& first = sums.of({1.0, {1.0, 0.0}});
  end << first[0], first[1];
  integral.leftCols(m) = first[1];
  integral.rightCols(m) = sums.of({1.0, {0.0, h}})[1];
  const Matrix M_integral = blocks.M * integral;
  const Matrix work = force.adjoint() * M_integral;
  return 0.5 * (congruence(blocks.M, start) - congruence(blocks.M, end) + work + work.adjoint());
}

template void phi_functions(const Eigen::MatrixXd& A, Index order, std::vector<Eigen::MatrixXd>& phi,
                            const FlowLoss<Eigen::MatrixXd>& loss);
template class PhiRowBlocks<Eigen::MatrixXd>;
template Eigen::MatrixXd flow_dissipation(const LinearBlocks<Eigen::MatrixXd>& blocks, double h);
template void phi_functions(const Eigen::MatrixXcd& A, Index order, std::vector<Eigen::MatrixXcd>& phi,
                            const FlowLoss<Eigen::MatrixXcd>& loss);
template class PhiRowBlocks<Eigen::MatrixXcd>;
template Eigen::MatrixXcd flow_dissipation(const LinearBlocks<Eigen::MatrixXcd>& blocks, double h);

}  // namespace seiche
