// What the hand-written methods in modes share: the state, its transforms and the nonlinear term.
#pragma once

#include <bench/peers/modes.hpp>
#include <bench/peers/peer.hpp>
#include <bench/peers/phi.hpp>

namespace seiche::bench {

// Fixed steps of h of û' = Aû + N(û), where N acts on v̂ alone for second-order equations.
class ModalRun : public Run {
 public:
  ModalRun(const Equation& equation, double h);

  void restart() override;
  std::string advance(double t) override;
  void values(std::span<double> z) const override;
  Work work() const override { return {steps_, evaluations_}; }
  void right_hand_side(std::span<const double> z, std::span<double> dz) override;

 protected:
  virtual void steps(std::int64_t count) = 0;  // of h, on u_ and v_

  // N of the field with coefficients u, with the factor that makes it a coefficient.
  void nonlinear(const double* u, double* out);

  const Equation equation_;
  const double h_;
  mutable ModeTransform transform_;
  const Symbols symbols_;
  std::vector<double> u_, v_;  // coefficients; v_ stays empty for gkdv
  std::vector<double> points_, slope_;
  std::int64_t evaluations_ = 0;  // of N

 private:
  std::vector<double> initial_u_, initial_v_;
  std::int64_t steps_ = 0;
};

}  // namespace seiche::bench
