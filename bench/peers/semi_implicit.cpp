// Gradient flows as most programs for them step: backward differences of order two, the gradient energy implicit, the
// rest explicit by extrapolation, and a stabilisation s(u⁺ − 2u + u⁻) that keeps the explicit part from growing (Shen,
// Yang, Discrete Contin. Dyn. Syst. 28, 2010). With f = u³ − u and σ = 1 of allen_cahn, λ of cahn_hilliard:
//   (3u⁺ − 4u + u⁻)/2h = −σ[κλu⁺ + s(u⁺ − 2u + u⁻) + f(2u − u⁻)];  the first step by its sibling of order one.
#include <bench/peers/hand_written.hpp>
#include <bench/peers/modal_run.hpp>

namespace seiche::bench {
namespace {

class SemiImplicit : public ModalRun {
 public:
  SemiImplicit(const Equation& equation, double h) : ModalRun(equation, h) {
    for (std::vector<double>* v : {&before_, &ahead_, &force_}) v->resize(u_.size());
  }
  void restart() override {
    ModalRun::restart();
    is_first_ = true;
  }

 private:
  static constexpr double s = 2;  // ½ max |f′| where |u| ≤ 1 and a little beyond

  double sigma(std::size_t k) const {
    return equation_.kind == Equation::Kind::cahn_hilliard ? symbols_.lambda[k] : 1.0;
  }

  void steps(std::int64_t count) override {
    for (; count > 0; --count) {
      const bool first = is_first_;
      is_first_ = false;
      for (std::size_t k = 0; k < u_.size(); ++k) ahead_[k] = first ? u_[k] : 2 * u_[k] - before_[k];
      nonlinear(ahead_.data(), force_.data());  // −σû³
      for (std::size_t k = 0; k < u_.size(); ++k) {
        const double g = h_ * sigma(k), kappa_lambda = equation_.stiffness * symbols_.lambda[k];
        const double known = first ? u_[k] : 2 * u_[k] - before_[k] / 2;
        const double next =
            (known + g * (s + 1) * ahead_[k] + h_ * force_[k]) / ((first ? 1.0 : 1.5) + g * (kappa_lambda + s));
        before_[k] = u_[k];
        u_[k] = next;
      }
    }
  }

  bool is_first_ = true;
  std::vector<double> before_, ahead_, force_;
};

}  // namespace

std::unique_ptr<Run> make_semi_implicit(const Equation& equation, double h) {
  return std::make_unique<SemiImplicit>(equation, h);
}

}  // namespace seiche::bench
