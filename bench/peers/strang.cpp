// Strang splitting, e^{hA/2} Φ_N(h) e^{hA/2}, with the exact flow of the damped linear part; neighbouring halves are
// merged between outputs, which leaves two transforms per step. Φ_N is a kick for second-order equations, and one
// classical Runge–Kutta step for gkdv, where u' = ∂(−σu²) has no exact flow.
#include <bench/peers/energy_line.hpp>
#include <bench/peers/hand_written.hpp>
#include <bench/peers/modal_run.hpp>
#include <bench/peers/right_hand_side.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace seiche::bench {
namespace {

class WaveStrang : public ModalRun {
 public:
  WaveStrang(const Equation& equation, double h)
      : ModalRun(equation, h),
        half_(wave_blocks(equation, symbols_), h / 2),
        whole_(wave_blocks(equation, symbols_), h),
        kick_(u_.size()) {}

 private:
  void steps(std::int64_t count) override {
    half_.apply(u_.data(), v_.data());
    for (; count > 0; --count) {
      nonlinear(u_.data(), kick_.data());
      for (std::size_t k = 0; k < v_.size(); ++k) v_[k] += h_ * kick_[k];
      (count > 1 ? whole_ : half_).apply(u_.data(), v_.data());
    }
  }

  WaveFlow half_, whole_;
  std::vector<double> kick_;
};

// Kick, flow, kick, and then to the point on the ray through the result whose H is what the flow has left of it.
class ProjectedStrang : public ModalRun {
 public:
  ProjectedStrang(const Equation& equation, double h)
      : ModalRun(equation, h),
        flow_(wave_blocks(equation, symbols_), h),
        kick_(u_.size()),
        weight_of_u_(u_.size()),
        weight_of_v_(u_.size()) {
    std::vector<double> one(u_.size());
    for (std::size_t k = 0; k < one.size(); ++k) {  // the squares of the points of each mode
      one[k] = 1;
      transform_.to_points(one.data(), points_.data());
      weight_of_v_[k] = std::transform_reduce(points_.begin(), points_.end(), points_.begin(), 0.0);
      weight_of_u_[k] = weight_of_v_[k] * (equation.mass_squared + equation.stiffness * symbols_.lambda[k]);
      std::fill(one.begin(), one.end(), 0.0);
    }
  }

 private:
  void steps(std::int64_t count) override {
    double V = kick_and_potential();
    double energy = quadratic_energy() + V;
    for (; count > 0; --count) {
      kick();
      energy -= quadratic_energy();
      flow_.apply(u_.data(), v_.data());
      energy += quadratic_energy();
      V = kick_and_potential();
      kick();
      const double factor = towards(energy, quadratic_energy(), V);
      const double of_kick = equation_.kind == Equation::Kind::alpha_fpu ? factor * factor : factor * factor * factor;
      for (std::size_t k = 0; k < u_.size(); ++k) {
        u_[k] *= factor;
        v_[k] *= factor;
        kick_[k] *= of_kick;
      }
    }
  }

  void kick() {
    for (std::size_t k = 0; k < v_.size(); ++k) v_[k] += h_ / 2 * kick_[k];
  }

  double quadratic_energy() const {
    return (std::transform_reduce(u_.begin(), u_.end(), weight_of_u_.begin(), 0.0, std::plus(), of_square) +
            std::transform_reduce(v_.begin(), v_.end(), weight_of_v_.begin(), 0.0, std::plus(), of_square)) /
           2;
  }
  static double of_square(double x, double weight) { return weight * x * x; }

  double kick_and_potential() {
    nonlinear(u_.data(), kick_.data());
    const std::vector<double>& p = points_;
    double V = 0;
    if (equation_.kind == Equation::Kind::klein_gordon) {
      V = std::transform_reduce(p.begin(), p.end(), 0.0, std::plus(), [](double x) { return x * x * x * x; });
      return equation_.strength / 4 * V;
    }
    double left = 0;
    for (std::size_t j = 0; j <= p.size(); ++j) {
      const double here = j < p.size() ? p[j] : 0.0, d = here - left;
      V += d * d * d;
      left = here;
    }
    return equation_.strength / (6 * equation_.dx * equation_.dx * equation_.dx) * V;
  }

  //   Kx² + Vxᵈ = energy
  double towards(double energy, double K, double V) const {
    const bool cubic = equation_.kind == Equation::Kind::alpha_fpu;
    return root_near_one([&](double x) {
      const double of_K = K * x * x, of_V = V * x * x * (cubic ? x : x * x);
      return std::pair(of_K + of_V - energy, (2 * of_K + (cubic ? 3 : 4) * of_V) / x);
    });
  }

  WaveFlow flow_;
  std::vector<double> kick_, weight_of_u_, weight_of_v_;
};

class ScalarStrang : public ModalRun {
 public:
  ScalarStrang(const Equation& equation, double h)
      : ModalRun(equation, h), burgers_(equation), stage_(equation.unknowns()), k_(equation.unknowns()) {
    for (const Complex& block : scalar_blocks(equation, symbols_)) {
      append(half_, phi(Real{h / 2} * block)[0]);
      append(whole_, phi(Real{h} * block)[0]);
    }
  }

 private:
  struct Number {
    double re, im;
  };
  static void append(std::vector<Number>& flow, const Complex& x) {
    flow.push_back({static_cast<double>(x.real()), static_cast<double>(x.imag())});
  }
  static void apply(const std::vector<Number>& flow, double* u) {
    for (std::size_t k = 0; k < flow.size(); ++k) {
      const double re = u[2 * k];
      u[2 * k] = flow[k].re * re - flow[k].im * u[2 * k + 1];
      u[2 * k + 1] = flow[k].re * u[2 * k + 1] + flow[k].im * re;
    }
  }

  void runge_kutta(std::vector<double>& u) {
    const double weights[4] = {h_ / 6, h_ / 3, h_ / 3, h_ / 6};
    const double nodes[4] = {h_ / 2, h_ / 2, h_, 0};
    start_ = u;
    stage_ = u;
    for (int i = 0; i < 4; ++i) {
      ++evaluations_;
      burgers_.nonlinear(stage_.data(), k_.data());
      for (std::size_t j = 0; j < u.size(); ++j) {
        u[j] += weights[i] * k_[j];
        stage_[j] = start_[j] + nodes[i] * k_[j];
      }
    }
  }

  void steps(std::int64_t count) override {
    apply(half_, u_.data());
    for (; count > 0; --count) {
      transform_.to_points(u_.data(), points_.data());
      runge_kutta(points_);
      transform_.to_modes(points_.data(), u_.data());
      for (double& u : u_) u *= transform_.scale();
      apply(count > 1 ? whole_ : half_, u_.data());
    }
  }

  RightHandSide burgers_;
  std::vector<Number> half_, whole_;
  std::vector<double> start_, stage_, k_;
};

}  // namespace

std::unique_ptr<Run> make_projected_strang(const Equation& equation, double h) {
  return std::make_unique<ProjectedStrang>(equation, h);
}

std::unique_ptr<Run> make_strang(const Equation& equation, double h) {
  if (equation.is_second_order()) return std::make_unique<WaveStrang>(equation, h);
  return std::make_unique<ScalarStrang>(equation, h);
}

}  // namespace seiche::bench
