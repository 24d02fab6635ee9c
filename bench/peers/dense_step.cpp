#include "dense_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace seiche::bench {
namespace {

using Lanes = double __attribute__((vector_size(64)));  // NOLINT(modernize-use-using)
constexpr int width = 8;

constexpr int lanes_of(int numbers) { return (numbers + width - 1) / width; }

// Numbers, filled up with zeros to whole lanes.
template <int n>
struct Numbers {
  std::array<Lanes, lanes_of(n)> lanes{};
  double* data() { return reinterpret_cast<double*>(lanes.data()); }
  const double* data() const { return reinterpret_cast<const double*>(lanes.data()); }
  double& operator[](int i) { return data()[i]; }
  double operator[](int i) const { return data()[i]; }
};

template <int n>
double product(const Numbers<n>& x, const Numbers<n>& y) {
  Lanes sum{};
  for (int i = 0; i < lanes_of(n); ++i) sum += x.lanes[i] * y.lanes[i];
  double total = 0;
  for (int i = 0; i < width; ++i) total += sum[i];
  return total;
}

// Column after column.
template <int rows, int columns>
struct Matrix {
  std::vector<Numbers<rows>> column = std::vector<Numbers<rows>>(columns);
  double& operator()(int i, int j) { return column[static_cast<std::size_t>(j)][i]; }

  // sum += A x. Four sums of their own where there are few rows, so that additions do not wait for one another.
  template <class X>
  void add_product(const X& x, Numbers<rows>& sum) const {
    constexpr int parts = lanes_of(rows) <= 3 ? 4 : 1;
    std::array<Numbers<rows>, parts> y{};
    y[0] = sum;
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < lanes_of(rows); ++i)
        y[static_cast<std::size_t>(j % parts)].lanes[i] += x[j] * column[static_cast<std::size_t>(j)].lanes[i];
    sum = y[0];
    for (int part = 1; part < parts; ++part)
      for (int i = 0; i < lanes_of(rows); ++i) sum.lanes[i] += y[static_cast<std::size_t>(part)].lanes[i];
  }
};

// With ω² = −κR + m² > 0 the Hamiltonian substep is u'' = −ω²u − V'(u), and every map of it a function of ω².
template <int n>
class KleinGordonStep final : public DenseStep {
 public:
  KleinGordonStep(const Equation& equation, double h) : equation_(equation), decay_(std::exp(-equation.gamma * h / 2)) {
    fill(h, [&](int i, int j, double cosine, double sine, double versine, double omega_squared) {
      step_(i, j) += cosine;
      step_(n + i, n + j) += cosine;
      step_(i, n + j) += sine;
      step_(n + i, j) -= omega_squared * sine;
      force_(i, j) -= versine;
      force_(n + i, j) -= sine;
    });
    for (int i = 0; i < 2 * n; ++i) step_(i, i) -= 1;
    fill(h / 2, [&](int i, int j, double cosine, double sine, double versine, double) {
      middle_u_(i, j) += cosine;
      middle_v_(i, j) += sine;
      middle_g_(i, j) -= versine;
    });
    restart();
  }

  void restart() override {
    double quadratic = 0;
    for (int i = 0; i < 2 * n; ++i) z_[i] = equation_.initial[static_cast<std::size_t>(i)];
    for (int i = 0; i < n; ++i) {
      const double right = z_[(i + 1) % n] - z_[i];
      quadratic += z_[n + i] * z_[n + i] + equation_.stiffness / (equation_.dx * equation_.dx) * right * right +
                   equation_.mass_squared * z_[i] * z_[i];
    }
    for (int i = 0; i < n; ++i) u_[i] = z_[i];
    const double v = take_gradient();
    shift_ = 2 * (quadratic / 2 + v);
    r_squared_ = v + shift_;
    known_ = 0;
  }

  std::vector<double> state() const override { return {z_.data(), z_.data() + 2 * n}; }

  void step() override {
    for (int i = n; i < 2 * n; ++i) z_[i] *= decay_;
    for (int i = 0; i < n; ++i) {
      u_[i] = z_[i];
      v_[i] = z_[n + i];
    }
    if (known_ < 3)
      take_gradient();
    else
      for (int i = 0; i < lanes_of(n); ++i) g_.lanes[i] = last_.lanes[i] + 0.75 * (last_.lanes[i] - before_.lanes[i]);
    Numbers<n> middle{};
    middle_u_.add_product(u_, middle);
    middle_v_.add_product(v_, middle);
    middle_g_.add_product(g_, middle);
    u_ = middle;
    const double v_mid = take_gradient();
    Numbers<2 * n> moves{}, pushed{};
    step_.add_product(z_, moves);
    force_.add_product(g_, pushed);
    Numbers<n> of_increment{}, of_force{};
    for (int i = 0; i < n; ++i) {
      of_increment[i] = moves[i];
      of_force[i] = pushed[i];
    }
    const double to_g = 1 / std::sqrt(v_mid + shift_), r = std::sqrt(r_squared_);
    const double r_mid = (r + to_g * product(g_, of_increment) / 4) / (1 - to_g * to_g * product(g_, of_force) / 4);
    r_squared_ = (2 * r_mid - r) * (2 * r_mid - r);
    for (int i = 0; i < lanes_of(2 * n); ++i) z_.lanes[i] += moves.lanes[i] + r_mid * to_g * pushed.lanes[i];
    for (int i = n; i < 2 * n; ++i) z_[i] *= decay_;
    before_ = last_;
    last_ = g_;
    known_ = std::min(known_ + 1, 3);
  }

 private:
  // visit(i, j, …) with the share that each frequency has in cos hω, sin hω/ω, (1 − cos hω)/ω² and ω², as matrices.
  template <class Visit>
  void fill(double h, const Visit& visit) const {
    for (int k = 0; k < n; ++k) {
      const double angle = std::numbers::pi * k / n;
      const double omega_squared =
          equation_.mass_squared + equation_.stiffness * std::pow(2 * std::sin(angle) / equation_.dx, 2);
      const double omega = std::sqrt(omega_squared);
      const double half = std::sin(h * omega / 2) / omega;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const double share = std::cos(2 * angle * (i - j)) / n;
          visit(i, j, share * std::cos(h * omega), share * std::sin(h * omega) / omega, share * 2 * half * half,
                omega_squared);
        }
    }
  }

  // g_ = ∇V(u_); V(u_).
  double take_gradient() {
    Lanes sum{};
    for (int i = 0; i < lanes_of(n); ++i) {
      const Lanes u = u_.lanes[i];
      g_.lanes[i] = equation_.strength * (u * u * u);
      sum += g_.lanes[i] * u;
    }
    double total = 0;
    for (int i = 0; i < width; ++i) total += sum[i];
    return total / 4;
  }

  Equation equation_;
  double decay_;
  Matrix<2 * n, 2 * n> step_;
  Matrix<2 * n, n> force_;
  Matrix<n, n> middle_u_, middle_v_, middle_g_;
  Numbers<2 * n> z_{};
  Numbers<n> u_{}, v_{}, g_{}, last_{}, before_{};
  double r_squared_ = 0, shift_ = 0;
  int known_ = 0;
};

}  // namespace

std::unique_ptr<DenseStep> dense_step(const Equation& equation, double h) {
  if (equation.kind != Equation::Kind::klein_gordon || equation.rows != 1) return nullptr;
  switch (equation.columns) {
    case 4: return std::make_unique<KleinGordonStep<4>>(equation, h);
    case 8: return std::make_unique<KleinGordonStep<8>>(equation, h);
    case 20: return std::make_unique<KleinGordonStep<20>>(equation, h);
    case 64: return std::make_unique<KleinGordonStep<64>>(equation, h);
    default: return nullptr;
  }
}

}  // namespace seiche::bench
