#include <bench/peers/modes.hpp>

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seiche::bench {
namespace {

struct Free {
  void operator()(void* p) const { fftw_free(p); }
};
using Buffer = std::unique_ptr<double, Free>;

struct DestroyPlan {
  void operator()(fftw_plan_s* p) const { fftw_destroy_plan(p); }
};
using Plan = std::unique_ptr<fftw_plan_s, DestroyPlan>;

}  // namespace

// Inputs of a transform are copied into `points` or `coefficients`: FFTW destroys them, and wants them aligned.
struct ModeTransform::Plans {
  Buffer points, coefficients;
  Plan forward, backward;
};

// Sines are the real transform of the odd continuation: faster than FFTW's own DST-I.
ModeTransform::ModeTransform(const Equation& e)
    : plans_(std::make_unique<Plans>()), is_periodic_(e.is_periodic()), points_(e.unknowns()) {
  const std::size_t columns = is_periodic_ ? e.columns : 2 * (e.columns + 1);
  const std::size_t half = columns / 2 + 1;
  slots_ = is_periodic_ ? 2 * e.rows * half : e.columns;
  scale_ = 1 / static_cast<double>(e.rows * columns);
  Plans& p = *plans_;
  p.points.reset(fftw_alloc_real(e.rows * columns));
  p.coefficients.reset(fftw_alloc_real(2 * e.rows * half));
  auto* modes = reinterpret_cast<fftw_complex*>(p.coefficients.get());
  const int sizes[2] = {static_cast<int>(e.rows), static_cast<int>(columns)};
  const int* last = sizes + (e.rows == 1 ? 1 : 0);
  const int rank = e.rows == 1 ? 1 : 2;
  p.forward.reset(fftw_plan_dft_r2c(rank, last, p.points.get(), modes, FFTW_MEASURE));
  p.backward.reset(fftw_plan_dft_c2r(rank, last, modes, p.points.get(), FFTW_MEASURE));
}

ModeTransform::~ModeTransform() = default;

void ModeTransform::to_modes(const double* u, double* coefficients) {
  double* points = plans_->points.get();
  const double* modes = plans_->coefficients.get();
  std::copy_n(u, points_, points + (is_periodic_ ? 0 : 1));
  if (is_periodic_) {
    fftw_execute(plans_->forward.get());
    std::copy_n(modes, slots_, coefficients);
    return;
  }
  const std::size_t ends = points_ + 1;
  points[0] = points[ends] = 0;
  for (std::size_t j = 1; j < ends; ++j) points[2 * ends - j] = -u[j - 1];
  fftw_execute(plans_->forward.get());
  for (std::size_t k = 0; k < slots_; ++k) coefficients[k] = modes[2 * k + 3];
}

void ModeTransform::to_points(const double* coefficients, double* u) {
  const double* points = plans_->points.get();
  double* modes = plans_->coefficients.get();
  if (is_periodic_) {
    std::copy_n(coefficients, slots_, modes);
    fftw_execute(plans_->backward.get());
    std::copy_n(points, points_, u);
    return;
  }
  std::fill_n(modes, 2 * (points_ + 2), 0.0);
  for (std::size_t k = 0; k < slots_; ++k) modes[2 * k + 3] = coefficients[k];
  fftw_execute(plans_->backward.get());
  std::copy_n(points + 1, points_, u);
}

Symbols symbols(const Equation& e) {
  const auto lambda = [&](std::size_t k, std::size_t period) {
    const double s = std::sin(std::numbers::pi * static_cast<double>(k) / static_cast<double>(period)) / e.dx;
    return 4 * s * s;
  };
  Symbols result;
  if (!e.is_periodic()) {
    for (std::size_t k = 1; k <= e.columns; ++k) result.lambda.push_back(lambda(k, 2 * (e.columns + 1)));
    return result;
  }
  for (std::size_t i = 0; i < e.rows; ++i) {
    for (std::size_t k = 0; k <= e.columns / 2; ++k) {
      const double along_rows = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(e.columns);
      result.lambda.insert(result.lambda.end(), 2, lambda(i, e.rows) + lambda(k, e.columns));
      result.derivative.insert(result.derivative.end(), 2, 2 * k == e.columns ? 0.0 : std::sin(along_rows) / e.dx);
    }
  }
  return result;
}

std::complex<long double> scalar_symbol(const Equation& e, const Symbols& symbols, std::size_t k) {
  const long double lambda = symbols.lambda[k];
  if (e.kind == Equation::Kind::allen_cahn) return 1 - e.stiffness * lambda;
  if (e.kind == Equation::Kind::cahn_hilliard) return lambda - e.stiffness * lambda * lambda;
  return {-e.gamma, symbols.derivative[k] * e.stiffness * lambda};
}

LinearSolve::LinearSolve(const Equation& equation)
    : equation_(equation), transform_(equation), symbols_(symbols(equation)), u_(transform_.slots()), v_(u_) {}

void LinearSolve::operator()(double c, const double* right, double* solution) {
  const Equation& e = equation_;
  const std::size_t n = e.unknowns();
  const double scale = transform_.scale();
  transform_.to_modes(right, u_.data());
  if (!e.is_second_order()) {
    for (std::size_t k = 0; k < u_.size(); k += 2) {
      const std::complex<double> linear(scalar_symbol(e, symbols_, k));
      const double a = 1 - c * linear.real();
      const double b = -c * linear.imag();
      const double inverse = scale / (a * a + b * b);
      const double re = u_[k];
      const double im = u_[k + 1];
      u_[k] = inverse * (a * re + b * im);
      u_[k + 1] = inverse * (a * im - b * re);
    }
    transform_.to_points(u_.data(), solution);
    return;
  }
  transform_.to_modes(right + n, v_.data());
  for (std::size_t k = 0; k < u_.size(); ++k) {
    const double stiffness = e.stiffness * symbols_.lambda[k] + e.mass_squared;
    const double damping = e.gamma + e.beta * symbols_.lambda[k];
    const double inverse = scale / (1 + c * damping + c * c * stiffness);
    const double u = u_[k];
    const double v = v_[k];
    u_[k] = inverse * ((1 + c * damping) * u + c * v);
    v_[k] = inverse * (v - c * stiffness * u);
  }
  transform_.to_points(u_.data(), solution);
  transform_.to_points(v_.data(), solution + n);
}

}  // namespace seiche::bench
