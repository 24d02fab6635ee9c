#include <bench/peers/modal_run.hpp>

#include <algorithm>
#include <cmath>

namespace seiche::bench {
namespace {

void scale(std::vector<double>& values, double factor) {
  for (double& value : values) value *= factor;
}

}  // namespace

ModalRun::ModalRun(const Equation& equation, double h)
    : equation_(equation),
      h_(h),
      transform_(equation),
      symbols_(symbols(equation)),
      u_(transform_.slots()),
      v_(equation.is_second_order() ? transform_.slots() : 0),
      points_(equation.unknowns()),
      slope_(equation.unknowns() + 1) {
  transform_.to_modes(equation.initial.data(), u_.data());
  scale(u_, transform_.scale());
  if (equation.is_second_order()) {
    transform_.to_modes(equation.initial.data() + equation.unknowns(), v_.data());
    scale(v_, transform_.scale());
  }
  initial_u_ = u_;
  initial_v_ = v_;
}

void ModalRun::restart() {
  u_ = initial_u_;
  v_ = initial_v_;
  steps_ = evaluations_ = 0;
}

std::string ModalRun::advance(double t) {
  const std::int64_t count = std::llround(t / h_) - steps_;
  if (count > 0) steps(count);
  steps_ += count;
  return std::isfinite(u_[0]) && std::isfinite(u_[u_.size() / 2]) ? "" : "not finite";
}

void ModalRun::values(std::span<double> z) const {
  transform_.to_points(u_.data(), z.data());
  if (equation_.is_second_order()) transform_.to_points(v_.data(), z.data() + equation_.unknowns());
}

void ModalRun::nonlinear(const double* u, double* out) {
  ++evaluations_;
  const Equation& e = equation_;
  const std::size_t n = e.unknowns();
  const double scale = transform_.scale();
  transform_.to_points(u, points_.data());
  const double* p = points_.data();
  double* s = slope_.data();
  switch (e.kind) {
    case Equation::Kind::allen_cahn:
    case Equation::Kind::cahn_hilliard:
    case Equation::Kind::klein_gordon: {
      const double c = (e.kind == Equation::Kind::klein_gordon ? -e.strength : -1) * scale;
      for (std::size_t j = 0; j < n; ++j) s[j] = c * p[j] * p[j] * p[j];
      break;
    }
    case Equation::Kind::alpha_fpu: {
      const double c = e.strength * scale / (2 * e.dx * e.dx * e.dx);
      double left = c * p[0] * p[0];
      for (std::size_t j = 0; j < n; ++j) {
        const double d = (j + 1 < n ? p[j + 1] : 0.0) - p[j];
        const double right = c * d * d;
        s[j] = right - left;
        left = right;
      }
      break;
    }
    case Equation::Kind::gkdv: {
      const double c = -e.strength * scale;
      for (std::size_t j = 0; j < n; ++j) s[j] = c * p[j] * p[j];
      break;
    }
  }
  transform_.to_modes(s, out);
  if (e.kind == Equation::Kind::cahn_hilliard)
    for (std::size_t k = 0; k < u_.size(); ++k) out[k] *= symbols_.lambda[k];
  if (e.kind != Equation::Kind::gkdv) return;
  for (std::size_t k = 0; k < u_.size(); k += 2) {
    const double re = out[k];
    out[k] = -symbols_.derivative[k] * out[k + 1];
    out[k + 1] = symbols_.derivative[k] * re;
  }
}

void ModalRun::right_hand_side(std::span<const double> z, std::span<double> dz) {
  const std::size_t n = equation_.unknowns();
  const std::size_t slots = transform_.slots();
  std::vector<double> u(slots), v(slots), out(slots);
  transform_.to_modes(z.data(), u.data());
  scale(u, transform_.scale());
  nonlinear(u.data(), out.data());
  if (!equation_.is_second_order()) {
    const std::vector<Complex> blocks = scalar_blocks(equation_, symbols_);
    for (std::size_t k = 0; k < slots; k += 2) {
      const Complex linear = blocks[k / 2] * Complex(u[k], u[k + 1]);
      out[k] += static_cast<double>(linear.real());
      out[k + 1] += static_cast<double>(linear.imag());
    }
    transform_.to_points(out.data(), dz.data());
    return;
  }
  transform_.to_modes(z.data() + n, v.data());
  scale(v, transform_.scale());
  const std::vector<Matrix2> blocks = wave_blocks(equation_, symbols_);
  for (std::size_t k = 0; k < slots; ++k) {
    out[k] += static_cast<double>(blocks[k].c * u[k] + blocks[k].d * v[k]);
    u[k] = static_cast<double>(blocks[k].a * u[k] + blocks[k].b * v[k]);
  }
  transform_.to_points(u.data(), dz.data());
  transform_.to_points(out.data(), dz.data() + n);
}

}  // namespace seiche::bench
