#include <seiche/core/error.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/damping/adaptive_integral.hpp>
#include <seiche/damping/rates.hpp>

#include <boost/math/quadrature/gauss.hpp>

#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

namespace seiche {
namespace {

using boost::math::quadrature::gauss;

constexpr double never = -1.0;

class ConstantRate final : public Rate {
 public:
  explicit ConstantRate(double gamma) : gamma_(gamma) {}
  double value(double) const override { return gamma_; }
  double integral(double, double h) const override { return gamma_ * h; }
  bool is_constant() const override { return true; }
  double first_negative_time(double) const override { return gamma_ < 0 ? 0.0 : never; }
  double negative_seen() const override { return gamma_ < 0 ? 0.0 : never; }
  std::string text() const override { return fmt::format("{}", gamma_); }

 private:
  double gamma_;
};

class FormulaRate final : public Rate {
 public:
  explicit FormulaRate(FormulaPointer formula) : formula_(std::move(formula)) {
    if (formula_->polynomial()) degree_ = static_cast<int>(formula_->polynomial()->size()) - 1;
  }

  double value(double t) const override {
    const double gamma = (*formula_)(t);
    if (gamma < 0) negative_seen_.store(t, std::memory_order_relaxed);
    return gamma;
  }

  // Every rule has positive weights, so that γ ≥ 0 gives ∫γ ≥ 0 to the last bit; the antiderivative of a polynomial
  // would not. On s ∈ [0, 1] with t + sh, since (t + h) − t loses the digits of h once t ≫ h.
  double integral(double t, double h) const override {
    const auto gamma = [&](double s) { return value(std::fma(s, h, t)); };
    if (!std::isfinite(value(t)) || !std::isfinite(value(t + h))) return std::numeric_limits<double>::quiet_NaN();
    if (degree_ > 0 && degree_ <= 13) return h * gauss<double, 7>::integrate(gamma, 0.0, 1.0);   // exact to 2n − 1
    if (degree_ > 0 && degree_ <= 59) return h * gauss<double, 30>::integrate(gamma, 0.0, 1.0);  // likewise
    return h * adaptive_integral(gamma);
  }

  bool is_constant() const override { return false; }

  double first_negative_time(double t_end) const override {
    constexpr int samples = 4096;
    for (int i = 0; i <= samples; ++i) {
      const double t = t_end * i / samples;
      if (value(t) < 0) return t;
    }
    return never;
  }

  double negative_seen() const override { return negative_seen_.load(std::memory_order_relaxed); }
  std::string text() const override { return formula_->text(); }

 private:
  FormulaPointer formula_;
  mutable std::atomic<double> negative_seen_ = never;
  int degree_ = -1;  // −1: not a polynomial
};

}  // namespace

RatePointer constant_rate(double gamma) {
  if (!std::isfinite(gamma)) throw Error("a damping rate must be a finite number, not {}", number_text(gamma));
  return std::make_shared<ConstantRate>(gamma);
}

RatePointer formula_rate(FormulaPointer formula) {
  const auto& polynomial = formula->polynomial();
  if (polynomial && polynomial->size() == 1) return constant_rate(polynomial->front());
  return std::make_shared<FormulaRate>(std::move(formula));
}

}  // namespace seiche
