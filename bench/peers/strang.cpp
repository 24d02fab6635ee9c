// Strang splitting, e^{hA/2} Φ_N(h) e^{hA/2}, with the exact flow of the damped linear part; neighbouring halves are
// merged between outputs, which leaves two transforms per step. Φ_N is a kick for second-order equations, and one
// classical Runge–Kutta step for gkdv, where u' = ∂(−σu²) has no exact flow.
#include <bench/peers/hand_written.hpp>
#include <bench/peers/modal_run.hpp>
#include <bench/peers/right_hand_side.hpp>

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

std::unique_ptr<Run> make_strang(const Equation& equation, double h) {
  if (equation.is_second_order()) return std::make_unique<WaveStrang>(equation, h);
  return std::make_unique<ScalarStrang>(equation, h);
}

}  // namespace seiche::bench
