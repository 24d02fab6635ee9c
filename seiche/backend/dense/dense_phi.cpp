#include <seiche/backend/dense/dense_phi.hpp>
#include <seiche/backend/dense/lane_matrix.hpp>
#include <seiche/backend/phi/dense_kernel.hpp>
#include <seiche/backend/phi/force_map.hpp>
#include <seiche/backend/phi/phi_functions.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace seiche {
namespace {

using Matrix = Eigen::MatrixXd;

// z and the forces, the latter on the support where they are gradients, one under the other.
class Stack {
 public:
  Stack(const PhiRows& rows, Index size, Potential::Support support)
      : size_(size),
        of_forces_(rows.kind == PhiRows::Forces::gradients ? support : Potential::Support{0, size}),
        y_(size + rows.forces * of_forces_.size) {}

  const double* of(const Vector& z, std::span<const Vector> forces) const {
    if (forces.empty()) return z.data();
    y_.head(size_) = z;
    Index begin = size_;
    for (const Vector& f : forces) {
      y_.segment(begin, of_forces_.size) = f.segment(of_forces_.begin, of_forces_.size);
      begin += of_forces_.size;
    }
    return y_.data();
  }
  Index size() const { return y_.size(); }

  // The blocks of a row side by side, with the columns that the stack has.
  Matrix joined(const std::vector<Matrix>& blocks) const {
    Matrix wide(size_, y_.size());
    wide.leftCols(size_) = blocks[0];
    for (std::size_t j = 1; j < blocks.size(); ++j)
      wide.middleCols(size_ + static_cast<Index>(j - 1) * of_forces_.size, of_forces_.size) =
          blocks[j].middleCols(of_forces_.begin, of_forces_.size);
    return wide;
  }

 private:
  Index size_;
  Potential::Support of_forces_;
  mutable Vector y_;
};

class DensePhiMap final : public PhiMap {
 public:
  DensePhiMap(const PhiRows& rows, const LinearBlocks<Matrix>& linear, double h, Potential::Support support)
      : stack_(rows, linear.S.rows(), support),
        out_(rows.outputs == PhiRows::Outputs::support ? support : Potential::Support{0, linear.S.rows()}) {
    PhiRowBlocks<Matrix> blocks(rows, linear, h);
    Matrix tall(static_cast<Index>(rows.rows.size()) * out_.size, stack_.size());
    for (std::size_t i = 0; i < rows.rows.size(); ++i)
      tall.middleRows(static_cast<Index>(i) * out_.size, out_.size) =
          stack_.joined(blocks.of(rows.rows[i])).middleRows(out_.begin, out_.size);
    matrix_ = LaneMatrix(tall);
    result_.resize(matrix_.padded_rows());
  }

  void apply(const Vector& z, std::span<const Vector> forces, std::span<Vector> out) const override {
    const double* const y = stack_.of(z, forces);
    if (double* const to = out[0].data() + out_.begin; matrix_.padded_rows() == out_.size && to != y + out_.begin)
      return matrix_.apply(y, to);
    matrix_.apply(y, result_.data());
    Index begin = 0;
    for (Vector& v : out) {
      v.segment(out_.begin, out_.size) = result_.segment(begin, out_.size);
      begin += out_.size;
    }
  }

 private:
  Stack stack_;
  Potential::Support out_;
  LaneMatrix matrix_;
  mutable Vector result_;
};

class DensePhiForms final : public PhiForms {
 public:
  DensePhiForms(std::span<const PhiEvaluator::Form> forms, const LinearBlocks<Matrix>& linear, const Matrix& Q,
                double h, Potential::Support support)
      : stack_(forms.front().rows, linear.S.rows(), support) {
    for (const PhiEvaluator::Form& form : forms) {
      PhiRowBlocks<Matrix> blocks(form.rows, linear, h);
      Matrix gram = Matrix::Zero(stack_.size(), stack_.size());
      for (std::size_t i = 0; i < form.rows.rows.size(); ++i) {
        const Matrix row = stack_.joined(blocks.of(form.rows.rows[i]));
        gram += form.coefficients[i] * congruence(Q, row);
      }
      if (form.minus_integral) gram -= integral_of_dissipation(form.rows, linear, h);
      grams_.emplace_back(gram);
    }
    image_.resize(grams_.front().padded_rows());
  }

  // The form of ∫Q, in z and the forces.
  Matrix integral_of_dissipation(const PhiRows& rows, const LinearBlocks<Matrix>& linear, double h) const {
    const Index n = linear.S.rows();
    const bool gradients = rows.kind == PhiRows::Forces::gradients;
    const Matrix to_state = gradients ? linear.S : Matrix(Matrix::Identity(n, n));
    std::vector<Matrix> zero_and_forces(static_cast<std::size_t>(rows.forces) + 1, to_state);
    zero_and_forces[0].setZero();
    Matrix z_and_n(2 * n, stack_.size());
    z_and_n << Matrix::Identity(n, stack_.size()), stack_.joined(zero_and_forces);
    return congruence(flow_dissipation(linear, h), z_and_n);
  }

  void apply(const Vector& z, std::span<const Vector> forces, std::span<double> values) const override {
    const double* y = stack_.of(z, forces);
    for (std::size_t l = 0; l < grams_.size(); ++l) {
      grams_[l].apply(y, image_.data());
      values[l] = image_.head(stack_.size()).dot(Eigen::Map<const Vector>(y, stack_.size()));
    }
  }

 private:
  Stack stack_;
  std::vector<LaneMatrix> grams_;
  mutable Vector image_;
};

class DensePhi final : public PhiEvaluator {
 public:
  bool has_tables() const override { return true; }
  double rate() const override { return rate_; }

  DensePhi(Matrix S, const Matrix& M, const Matrix& D0, Potential::Support support)
      : linear_{std::move(S), M, D0}, Q_(dissipation_matrix<Matrix>(linear_.S, M, D0)), support_(support) {
    const Matrix twice_sym = linear_.S + linear_.S.transpose();
    dissipation_.is_quadratic = D0.middleRows(support.begin, support.size).isZero(0) &&
                                twice_sym.middleRows(support.begin, support.size).isZero(0);
    dissipation_.is_zero = D0.isZero(0) && twice_sym.isZero(0);
    const Vector rates = Eigen::SelfAdjointEigenSolver<Matrix>(Q_, Eigen::EigenvaluesOnly).eigenvalues();
    dissipation_.is_nonnegative = rates.minCoeff() >= -1e-13 * rates.cwiseAbs().maxCoeff();
    rate_ = spectral_bound(linear_.L());
    kernel_ = dense_kernel<Eigen::MatrixXd>(linear_.S.transpose());
    products_.resize(kernel_.cols());
  }

  std::unique_ptr<PhiMap> map(const PhiRows& rows, double h) const override {
    return std::make_unique<DensePhiMap>(rows, linear_, h, support_);
  }
  std::unique_ptr<PhiForms> forms(std::span<const Form> forms, double h) const override {
    return std::make_unique<DensePhiForms>(forms, linear_, Q_, h, support_);
  }
  Dissipation dissipation() const override { return dissipation_; }

  bool without_casimirs(const Vector& z, Vector& d) const override {
    if (kernel_.cols() == 0) return false;
    products_.noalias() = kernel_.transpose() * z;
    d = z;
    d.noalias() -= kernel_ * products_;
    return true;
  }

 private:
  LinearBlocks<Matrix> linear_;
  Matrix Q_;
  double rate_ = 0;
  Potential::Support support_;
  Dissipation dissipation_;
  Matrix kernel_;  // orthonormal columns
  mutable Vector products_;
};

}  // namespace

std::unique_ptr<PhiEvaluator> dense_phi(Matrix S, const Matrix& M, const Matrix& D0, Potential::Support support) {
  return std::make_unique<DensePhi>(std::move(S), M, D0, support);
}

}  // namespace seiche
