// Explicit Runge–Kutta methods by relaxation: steps that lower H by what their own quadrature says of its dissipation
// (D. I. Ketcheson, SIAM J. Numer. Anal. 57, 2019; H. Ranocha and others, SIAM J. Sci. Comput. 42, 2020).
#include <bench/peers/energy_line.hpp>
#include <bench/peers/hand_written.hpp>
#include <bench/peers/right_hand_side.hpp>

#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace seiche::bench {
namespace {

struct Tableau {
  int error_order;                     // of what the solution is compared with
  std::vector<std::vector<double>> a;  // a[i]: of stage i + 1
  std::vector<double> b, error;        // of the solution, and what that has beyond the other solution
};

Tableau dormand_prince() {
  return {.error_order = 4,
          .a = {{1.0 / 5},
                {3.0 / 40, 9.0 / 40},
                {44.0 / 45, -56.0 / 15, 32.0 / 9},
                {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}},
          .b = {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84, 0},
          .error = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40}};
}

// No weight of it is negative: where no stage feeds H, their sum does not.
Tableau fehlberg() {
  namespace odeint = boost::numeric::odeint;
  Tableau tableau{.error_order = 7, .a = {}, .b = {}, .error = {}};
  const auto set = [&](const auto&... rows) { tableau.a = {std::vector<double>(rows.begin(), rows.end())...}; };
  set(odeint::rk78_coefficients_a1<>(), odeint::rk78_coefficients_a2<>(), odeint::rk78_coefficients_a3<>(),
      odeint::rk78_coefficients_a4<>(), odeint::rk78_coefficients_a5<>(), odeint::rk78_coefficients_a6<>(),
      odeint::rk78_coefficients_a7<>(), odeint::rk78_coefficients_a8<>(), odeint::rk78_coefficients_a9<>(),
      odeint::rk78_coefficients_a10<>(), odeint::rk78_coefficients_a11<>(), odeint::rk78_coefficients_a12<>());
  const odeint::rk78_coefficients_b<> b;
  const odeint::rk78_coefficients_db<> error;
  tableau.b.assign(b.begin(), b.end());
  tableau.error.assign(error.begin(), error.end());
  return tableau;
}

class RelaxationRun : public Run {
 public:
  RelaxationRun(const Equation& equation, Tableau tableau, double tolerance)
      : equation_(equation), tableau_(std::move(tableau)), tolerance_(tolerance), rhs_(equation), line_(equation) {
    slopes_.assign(tableau_.b.size(), std::vector<double>(equation.size()));
    step_ = stage_ = slopes_[0];
    restart();
  }

  void restart() override {
    z_ = equation_.initial;
    t_ = 0;
    h_ = 1e-5 * equation_.t_end;
    steps_ = rhs_.evaluations = 0;
  }

  std::string advance(double t) override {
    constexpr double smallest = 1e-12;
    rhs_.begin_advance();
    while (t - t_ > smallest) {
      if (rhs_.is_exhausted()) return RightHandSide::exhausted;
      const bool is_last = t_ + h_ >= t;
      const double h = is_last ? t - t_ : h_;
      if (h < smallest * equation_.t_end) return "the step size fell to zero or the state is not finite";
      const double error = compute(h);
      const double factor = 0.9 * std::pow(std::max(error, 1e-10), -1.0 / (tableau_.error_order + 1));
      if (!(error <= 1)) {
        h_ = h * (std::isfinite(factor) ? std::max(factor, 0.2) : 0.2);
        continue;
      }
      const double share = relaxed_share(h);
      if (!(std::abs(share - 1) < 0.1)) {  // too long a step to be corrected
        h_ = h / 2;
        continue;
      }
      move(share, h);
      const double next = h * std::clamp(factor, 0.2, 5.0);
      h_ = is_last ? std::max(next, h_) : next;
      // The step ended share·h later: so little is left that no law shows it.
      if (is_last && std::abs(t - t_) > smallest) {
        compute(t - t_);
        move(1, t - t_);
      }
    }
    return "";
  }

  void values(std::span<double> z) const override { std::copy(z_.begin(), z_.end(), z.begin()); }
  Work work() const override { return {steps_, rhs_.evaluations}; }
  void right_hand_side(std::span<const double> z, std::span<double> dz) override { rhs_.full(z.data(), dz.data()); }

 private:
  // step_ ← hΣb_i k_i, rate_ ← Σb_i dH/dt at the stages; returns the error over what is allowed.
  double compute(double h) {
    rate_ = 0;
    for (std::size_t i = 0; i < slopes_.size(); ++i) {
      stage_ = z_;
      if (i > 0) add(h, tableau_.a[i - 1], stage_);
      rhs_.full(stage_.data(), slopes_[i].data());
      if (tableau_.b[i] != 0) rate_ += tableau_.b[i] * line_.rate(stage_.data());
    }
    std::fill(step_.begin(), step_.end(), 0.0);
    add(h, tableau_.b, step_);
    std::fill(stage_.begin(), stage_.end(), 0.0);
    add(h, tableau_.error, stage_);
    double error = 0;
    for (std::size_t j = 0; j < z_.size(); ++j) {
      const double relative = std::abs(stage_[j]) / (tolerance_ * (1 + std::abs(z_[j])));
      error = relative <= error ? error : relative;  // NaN counts as the largest
    }
    return error;
  }

  void add(double h, const std::vector<double>& weights, std::vector<double>& out) const {
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double factor = h * weights[i];
      if (factor == 0) continue;
      const double* k = slopes_[i].data();
      for (std::size_t j = 0; j < out.size(); ++j) out[j] += factor * k[j];
    }
  }

  // The root near 1 of H(z + γd) = H(z) + γ h Σb_i dH/dt, divided by γ.
  double relaxed_share(double h) {
    const EnergyLine::Coefficients c = line_.along(z_.data(), step_.data());
    const double first = c[0] - h * rate_;
    return root_near_one([&](double share) {
      return std::pair(first + share * (c[1] + share * (c[2] + share * c[3])),
                       c[1] + share * (2 * c[2] + share * 3 * c[3]));
    });
  }

  void move(double share, double h) {
    for (std::size_t j = 0; j < z_.size(); ++j) z_[j] += share * step_[j];
    t_ += share * h;
    ++steps_;
  }

  const Equation equation_;
  Tableau tableau_;
  double tolerance_;
  RightHandSide rhs_;
  EnergyLine line_;
  std::vector<std::vector<double>> slopes_;  // k_i
  std::vector<double> z_, step_, stage_;
  double t_ = 0, h_ = 0, rate_ = 0;
  std::int64_t steps_ = 0;
};

Peer peer(const std::string& name, Tableau (*tableau)()) {
  return {.name = name,
          .library = "hand-written",
          .origin = Origin::hand_written,
          .applies = no_gradient_flow,
          .make = [tableau](const Equation& equation, double tolerance) -> std::unique_ptr<Run> {
            return std::make_unique<RelaxationRun>(equation, tableau(), tolerance);
          }};
}

}  // namespace

std::vector<Peer> relaxation_peers() {
  return {peer("relaxation dopri5", dormand_prince), peer("relaxation Fehlberg78", fehlberg)};
}

}  // namespace seiche::bench
