#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/axis_names.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/damping/adaptive_integral.hpp>
#include <seiche/damping/rates.hpp>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

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

// γ(x_j) and nothing else to compute.
class SteadyFieldRate final : public FieldRate {
 public:
  SteadyFieldRate(std::vector<double> gamma, std::string text) : gamma_(std::move(gamma)), text_(std::move(text)) {}

  void values(double, std::span<double> gamma) const override {
    std::copy(gamma_.begin(), gamma_.end(), gamma.begin());
  }
  void integrals(double, double h, std::span<double> out) const override {
    std::transform(gamma_.begin(), gamma_.end(), out.begin(), [h](double gamma) { return h * gamma; });
  }
  bool is_constant() const override { return true; }
  double first_negative_time(double) const override { return negative_seen(); }
  double negative_seen() const override {
    return std::any_of(gamma_.begin(), gamma_.end(), [](double gamma) { return gamma < 0; }) ? 0.0 : never;
  }
  std::string text() const override { return text_; }

 private:
  std::vector<double> gamma_;
  std::string text_;
};

// γ(t), the same at every point.
class UniformFieldRate final : public FieldRate {
 public:
  explicit UniformFieldRate(RatePointer rate) : rate_(std::move(rate)) {}

  void values(double t, std::span<double> gamma) const override {
    std::fill(gamma.begin(), gamma.end(), rate_->value(t));
  }
  void integrals(double t, double h, std::span<double> out) const override {
    std::fill(out.begin(), out.end(), rate_->integral(t, h));
  }
  bool is_constant() const override { return rate_->is_constant(); }
  double first_negative_time(double t_end) const override { return rate_->first_negative_time(t_end); }
  double negative_seen() const override { return rate_->negative_seen(); }
  std::string text() const override { return rate_->text(); }

 private:
  RatePointer rate_;
};

class FormulaFieldRate final : public FieldRate {
 public:
  FormulaFieldRate(FormulaPointer formula, const Grid& grid) : formula_(std::move(formula)) {
    for (Index j = 0; j < grid.unknowns(); ++j) places_.push_back(grid.place(j));
  }

  void values(double t, std::span<double> gamma) const override {
    for (std::size_t j = 0; j < places_.size(); ++j) gamma[j] = value(t, places_[j]);
  }

  // On s ∈ [0, 1] with t + sh, since (t + h) − t loses the digits of h once t ≫ h.
  void integrals(double t, double h, std::span<double> out) const override {
    for (std::size_t j = 0; j < places_.size(); ++j) {
      const auto gamma = [&](double s) { return value(std::fma(s, h, t), places_[j]); };
      const bool finite = std::isfinite(gamma(0.0)) && std::isfinite(gamma(1.0));
      out[j] = finite ? h * adaptive_integral(gamma) : std::numeric_limits<double>::quiet_NaN();
    }
  }

  bool is_constant() const override { return false; }

  double first_negative_time(double t_end) const override {
    const std::size_t samples =
        std::clamp<std::size_t>((1U << 20U) / std::max<std::size_t>(places_.size(), 1), 64, 4096);
    for (std::size_t i = 0; i <= samples; ++i) {
      const double t = t_end * static_cast<double>(i) / static_cast<double>(samples);
      if (std::any_of(places_.begin(), places_.end(), [&](const Place& place) { return value(t, place) < 0; }))
        return t;
    }
    return never;
  }

  double negative_seen() const override { return negative_seen_.load(std::memory_order_relaxed); }
  std::string text() const override { return formula_->text(); }

 private:
  double value(double t, const Place& place) const {
    const std::array<double, 4> arguments = {t, place[0], place[1], place[2]};
    const double gamma = (*formula_)(arguments);
    if (gamma < 0) negative_seen_.store(t, std::memory_order_relaxed);
    return gamma;
  }

  FormulaPointer formula_;
  std::vector<Place> places_;
  mutable std::atomic<double> negative_seen_ = never;
};

class UniformSpaceRate final : public SpaceRate {
 public:
  explicit UniformSpaceRate(RatePointer rate) : rate_(std::move(rate)) {}
  FieldRatePointer on(const Grid&) const override { return std::make_shared<UniformFieldRate>(rate_); }
  std::string text() const override { return rate_->text(); }

 private:
  RatePointer rate_;
};

class FormulaSpaceRate final : public SpaceRate {
 public:
  FormulaSpaceRate(FormulaPointer formula, Index axes, bool constant_in_time)
      : formula_(std::move(formula)), axes_(axes), constant_in_time_(constant_in_time) {}

  FieldRatePointer on(const Grid& grid) const override {
    if (grid.dimension() < axes_)
      throw Error("the rate {} names {}, but the grid has {}", shortened(text()), axes_ == 2 ? "y" : "z",
                  counted_axes(grid.dimension()));
    auto rate = std::make_shared<FormulaFieldRate>(formula_, grid);
    if (!constant_in_time_) return rate;
    std::vector<double> gamma(static_cast<std::size_t>(grid.unknowns()));
    rate->values(0, gamma);
    return std::make_shared<SteadyFieldRate>(std::move(gamma), text());
  }

  std::string text() const override { return formula_->text(); }

 private:
  FormulaPointer formula_;
  Index axes_;
  bool constant_in_time_;
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

SpaceRatePointer formula_space_rate(FormulaPointer formula, Index axes, bool constant_in_time) {
  return std::make_shared<FormulaSpaceRate>(std::move(formula), axes, constant_in_time);
}

SpaceRatePointer uniform_space_rate(RatePointer rate) { return std::make_shared<UniformSpaceRate>(std::move(rate)); }

}  // namespace seiche
