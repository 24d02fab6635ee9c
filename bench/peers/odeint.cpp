// Boost.odeint: explicit methods with controlled steps.
#include <bench/peers/groups.hpp>
#include <bench/peers/right_hand_side.hpp>

#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <boost/version.hpp>

#include <algorithm>
#include <cmath>

namespace seiche::bench {
namespace {

namespace odeint = boost::numeric::odeint;
using Values = std::vector<double>;

auto make_dopri5(double tolerance) {
  return odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_dopri5<Values>());
}
auto make_fehlberg78(double tolerance) {
  return odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<Values>());
}
auto make_bulirsch_stoer(double tolerance) { return odeint::bulirsch_stoer<Values>(tolerance, tolerance); }

template <auto make_stepper>
class OdeintRun : public Run {
  using Stepper = decltype(make_stepper(0.0));

 public:
  OdeintRun(const Equation& equation, double tolerance)
      : equation_(equation), tolerance_(tolerance), rhs_(equation), stepper_(make_stepper(tolerance)) {
    restart();
  }

  void restart() override {
    stepper_ = make_stepper(tolerance_);
    z_ = equation_.initial;
    t_ = 0;
    dt_ = 1e-5 * equation_.t_end;  // what a longer one computes of a stiff equation is not finite
    steps_ = rhs_.evaluations = 0;
  }

  std::string advance(double t) override {
    constexpr double smallest = 1e-12;
    const auto system = [this](const Values& z, Values& dz, double) { rhs_.full(z.data(), dz.data()); };
    rhs_.begin_advance();
    while (t - t_ > smallest) {
      if (rhs_.is_exhausted()) return RightHandSide::exhausted;
      const bool last = t_ + dt_ >= t;
      double dt = last ? t - t_ : dt_;
      const auto result = stepper_.try_step(system, z_, t_, dt);
      if (!std::isfinite(z_[0]) || !(dt > smallest || last))
        return "the step size fell to zero or the state is not finite";
      if (result == odeint::success) {
        ++steps_;
        dt_ = last ? std::max(dt, dt_) : dt;  // a step cut short by the output says little
      } else {
        dt_ = dt;
      }
    }
    return "";
  }

  void values(std::span<double> z) const override { std::copy(z_.begin(), z_.end(), z.begin()); }
  Work work() const override { return {steps_, rhs_.evaluations}; }
  void right_hand_side(std::span<const double> z, std::span<double> dz) override { rhs_.full(z.data(), dz.data()); }

 private:
  const Equation equation_;
  double tolerance_;
  RightHandSide rhs_;
  Stepper stepper_;
  Values z_;
  double t_ = 0;
  double dt_ = 0;
  std::int64_t steps_ = 0;
};

template <auto make_stepper>
Peer peer(const std::string& name) {
  return {.name = name,
          .library = "Boost.odeint",
          .applies = any_equation,
          .make = [](const Equation& equation, double tolerance) -> std::unique_ptr<Run> {
            return std::make_unique<OdeintRun<make_stepper>>(equation, tolerance);
          }};
}

}  // namespace

PeerGroup odeint_peers() {
  constexpr int hundred = 100;
  const std::string version = std::to_string(BOOST_VERSION / (hundred * 1000)) + "." +
                              std::to_string(BOOST_VERSION / hundred % 1000) + "." +
                              std::to_string(BOOST_VERSION % hundred);
  return {.library = {.name = "Boost.odeint", .version = version, .note = "headers, compiled with the bench"},
          .peers = {peer<make_dopri5>("odeint dopri5"), peer<make_fehlberg78>("odeint Fehlberg78"),
                    peer<make_bulirsch_stoer>("odeint Bulirsch–Stoer")}};
}

}  // namespace seiche::bench
