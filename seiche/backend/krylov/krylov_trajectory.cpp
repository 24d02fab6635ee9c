#include <seiche/backend/krylov/krylov_trajectory.hpp>
#include <seiche/core/control/stop_request.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

// The last columns of a longer basis cost more than they add to the substep (measured on waves in two dimensions).
constexpr Index most_columns = 30;
constexpr double settled = epsilon;
constexpr double within_round_off = 1e-15;  // a remainder this small against its vector is round-off
constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

KrylovTrajectory::KrylovTrajectory(std::shared_ptr<const Product> balanced_L, Vector scales, const Space& space,
                                   bool holds_s)
    : L_(std::move(balanced_L)),
      scales_(std::move(scales)),
      space_(space),
      holds_s_(holds_s),
      unknowns_of_all_(static_cast<Index>(space.sum(static_cast<double>(scales_.size())))),
      flow_(most_columns),
      end_(most_columns + 1),
      column_(most_columns + 1),
      products_(most_columns + 1) {}

void KrylovTrajectory::reserve(Index forces, std::size_t outputs) {
  if (passed_.size() < outputs) passed_.resize(outputs, Vector(most_columns + 1));
  if (tail_.size() >= forces && V_.rows() > 0) return;
  constexpr Index aligned = 8;  // so that sums over columns are made the same way, whatever was reserved before
  V_.resize((unknowns() + forces + aligned - 1) / aligned * aligned, most_columns + 1);
  w_.resize(unknowns() + forces);
  tail_.resize(forces);
}

// The first vector of the basis: w at σ, whose tail is known exactly. Returns its norm.
double KrylovTrajectory::begin(const Equation& equation, double sigma) {
  double power = equation.unit;  // unit · σᵏ/k!
  rows_ = unknowns() + equation.B.cols();
  for (Index k = 0; k < equation.B.cols(); ++k) {
    w_[unknowns() + k] = power;
    power *= sigma / static_cast<double>(k + 1);
  }
  flow_.clear();
  const double norm = this->norm(w_);
  if (norm > 0) V_.col(0).head(rows_) = w_.head(rows_) / norm;
  return norm;
}

// Appends A times the last vector to the basis. Returns the new entry h_{m+1,m}, which is 0 where the space is
// invariant.
double KrylovTrajectory::append(const Equation& equation) {
  const Index n = unknowns();
  const Index m = flow_.columns() + 1;
  const auto last = V_.col(m - 1).head(rows_);
  auto next = V_.col(m).head(rows_);
  const auto count = static_cast<std::size_t>(n);
  L_->apply({last.data(), count}, {next.data(), count});
  next.head(n) *= equation.x;
  next.tail(next.size() - n).setZero();
  const Index p = equation.B.cols();
  if (equation.unit > 0 && p > 0) {
    tail_.head(p) = last.segment(n, p) / equation.unit;
    next.head(n).noalias() += equation.B * tail_.head(p);
    next.segment(n + 1, p - 1) = last.segment(n, p - 1);
  }
  const double whole = norm(next);
  column_.head(m).setZero();
  double before = whole;
  double rest = whole;
  for (int pass = 0; pass == 0 || (pass == 1 && rest < before / 2); ++pass) {  // twice is enough
    before = rest;
    products_.head(m).noalias() = V_.topLeftCorner(counted(), m).transpose() * next.head(counted());
    space_.sum(std::span(products_.data(), static_cast<std::size_t>(m)));
    next.noalias() -= V_.topLeftCorner(rows_, m) * products_.head(m);
    column_.head(m) += products_.head(m);
    rest = norm(next);
  }
  const bool is_invariant = rest <= within_round_off * whole || m == unknowns_of_all_ + (equation.unit > 0 ? p : 0);
  column_[m] = is_invariant ? 0.0 : rest;
  next *= is_invariant ? 0.0 : 1 / rest;
  flow_.append(column_);
  return column_[m];
}

// As far as the estimate is below the tolerance.
KrylovTrajectory::Walk KrylovTrajectory::walk(double length, double sigma, std::span<const Output> ahead, double piece,
                                              double tolerance) {
  Walk walked;
  flow_.start();
  while (walked.length < length) {
    end_if_asked();
    double to = std::min(length, walked.length + piece);
    if (walked.outputs < ahead.size()) to = std::min(to, ahead[walked.outputs].sigma - sigma);
    flow_.advance(to - walked.length);
    if (!(flow_.error() <= tolerance)) break;
    walked.length = to;
    end_ = flow_.y();
    while (walked.outputs < ahead.size() && ahead[walked.outputs].sigma - sigma <= to)
      passed_[walked.outputs++] = flow_.y();
  }
  return walked;
}

KrylovTrajectory::Walk KrylovTrajectory::substep(const Equation& equation, double sigma,
                                                 std::span<const Output> ahead) {
  const double length = ahead.back().sigma - sigma;
  double log_estimate = 0;  // the first term of the estimate in powers of the length
  while (true) {
    const double entry = append(equation);
    if (!std::isfinite(entry)) return {};
    if (entry == 0) return walk(length, sigma, ahead, flow_.reach(), never);
    log_estimate += std::log(length * entry / static_cast<double>(flow_.columns()));
    const bool is_full = flow_.columns() == most_columns;
    if (!is_full && log_estimate > std::log(10 * settled)) continue;
    Walk walked = walk(length, sigma, ahead, flow_.reach(), settled);
    for (double piece = flow_.reach(); is_full && walked.length == 0 && piece > 0; piece /= 2)
      walked = walk(length, sigma, ahead, piece, settled);
    if (is_full || walked.length == length) return walked;
  }
}

void KrylovTrajectory::write(const Vector& coordinates, double norm, Potential::Support range, Vector& value) const {
  const Index size = flow_.columns() + 1;
  auto out = value.segment(range.begin, range.size);
  out.noalias() = V_.block(range.begin, 0, range.size, size) * coordinates.head(size);
  out.array() *= norm * scales_.segment(range.begin, range.size).array();
}

void KrylovTrajectory::integrate(double x, const Vector* z, const Eigen::MatrixXd& B, std::span<const Output> outputs,
                                 Potential::Support range) {
  const double size = std::sqrt(space_.sum(B.squaredNorm()));
  const double unit = size > 0 ? std::exp2(std::ceil(std::log2(size))) : size;  // NaN stays and is found in w
  const Equation equation{x, B, unit};
  if (z != nullptr)
    w_.head(unknowns()) = z->cwiseQuotient(scales_);
  else
    w_.head(unknowns()).setZero();
  double sigma = 0;
  while (!outputs.empty()) {
    const double norm = begin(equation, sigma);
    const Walk walked = norm > 0 && std::isfinite(norm) ? substep(equation, sigma, outputs) : Walk{};
    if (walked.length == 0) {  // w stays 0, or is not finite
      for (const Output& output : outputs)
        output.value->segment(range.begin, range.size)
            .setConstant(norm == 0 ? 0.0 : std::numeric_limits<double>::quiet_NaN());
      return;
    }
    for (std::size_t i = 0; i < walked.outputs; ++i) write(passed_[i], norm, range, *outputs[i].value);
    outputs = outputs.subspan(walked.outputs);
    if (outputs.empty()) return;
    sigma += walked.length;
    w_.head(rows_).noalias() = norm * (V_.topLeftCorner(rows_, flow_.columns() + 1) * end_.head(flow_.columns() + 1));
  }
}

}  // namespace seiche
