#include <seiche/core/base/error.hpp>
#include <seiche/core/base/vector.hpp>
#include <seiche/damping/frictions.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

namespace seiche {
namespace {

void require_nonnegative(double value, std::string_view name) {
  if (!std::isfinite(value) || value < 0) throw Error("the friction's {} = {} must be ≥ 0", name, value);
}

// A law for each component alone: `force(v)`, and `flow(v, τ)`, the solution of v̇ = −force(v) after the time τ.
template <class Law>
class ComponentFriction final : public Friction {
 public:
  ComponentFriction(Law law, std::string text) : law_(law), text_(std::move(text)) {}

  void force(double, std::span<const double>, std::span<const double> v, std::span<double> r) const override {
    std::transform(v.begin(), v.end(), r.begin(), [this](double x) { return law_.force(x); });
  }
  void flow(double, double h, double w, std::span<const double>, std::span<double> v) const override {
    for (double& x : v) x = law_.flow(x, w * h);
  }
  bool uses_coordinates() const override { return false; }
  bool is_dissipative() const override { return true; }
  std::string feeds_at(double) const override { return ""; }
  std::string fed_at() const override { return ""; }
  Smoothness smoothness() const override { return law_.smoothness(); }
  double steepness() const override {
    if constexpr (requires { law_.steepness(); }) return law_.steepness();
    return 0;
  }
  std::string text() const override { return text_; }

 private:
  Law law_;
  std::string text_;
};

struct Quadratic {
  double a, c;
  Friction::Smoothness smoothness() const { return c > 0 ? Friction::Smoothness::kink : Friction::Smoothness::smooth; }
  double force(double v) const { return (a + c * std::abs(v)) * v; }
  double flow(double v, double tau) const {
    const double weight = a > 0 ? -std::expm1(-a * tau) / a : tau;  // ∫ e^{−as}
    return v * std::exp(-a * tau) / (1 + c * std::abs(v) * weight);
  }
};

struct Cubic {
  double c;
  Friction::Smoothness smoothness() const { return Friction::Smoothness::smooth; }
  double force(double v) const { return c * v * v * v; }
  double flow(double v, double tau) const { return v / std::sqrt(1 + 2 * c * v * v * tau); }
};

// sinh(v/ε) decays like e^{−cτ/ε}.
struct Saturating {
  double c, width;
  Friction::Smoothness smoothness() const { return Friction::Smoothness::sharp; }
  double steepness() const { return c / width; }
  double force(double v) const { return c * std::tanh(v / width); }
  double flow(double v, double tau) const {
    constexpr double large = 20;  // beyond it 2 sinh x = eˣ to the last digit
    const double x = std::abs(v) / width;
    const double shift = c * tau / width;
    if (x <= large) return std::copysign(width * std::asinh(std::sinh(x) * std::exp(-shift)), v);
    const double left = x - shift;
    return std::copysign(width * (left > large ? left : std::asinh(std::exp(left) / 2)), v);
  }
};

struct Dry {
  double c;
  Friction::Smoothness smoothness() const { return Friction::Smoothness::jump; }
  double force(double v) const { return v > 0 ? c : v < 0 ? -c : 0.0; }
  double flow(double v, double tau) const { return std::copysign(std::max(std::abs(v) - c * tau, 0.0), v); }
};

template <class Law>
FrictionPointer by_component(Law law, std::string text) {
  return std::make_shared<ComponentFriction<Law>>(law, std::move(text));
}

class IsotropicFriction final : public Friction {
 public:
  IsotropicFriction(double c, std::size_t components) : c_(c), components_(components) {}

  void force(double, std::span<const double>, std::span<const double> v, std::span<double> r) const override {
    for_points(v, [&](std::size_t i, double speed) { r[i] = c_ * speed * v[i]; });
  }
  void flow(double, double h, double w, std::span<const double>, std::span<double> v) const override {
    for_points(v, [&](std::size_t i, double speed) { v[i] /= 1 + c_ * speed * w * h; });
  }
  bool uses_coordinates() const override { return false; }
  bool is_dissipative() const override { return true; }
  std::string feeds_at(double) const override { return ""; }
  std::string fed_at() const override { return ""; }
  Smoothness smoothness() const override { return Smoothness::kink; }
  std::string text() const override { return fmt::format("{} |v|v, |v| the length of the vector", c_); }

 private:
  template <class Visit>
  void for_points(std::span<const double> v, const Visit& visit) const {
    const std::size_t points = v.size() / components_;
    for (std::size_t j = 0; j < points; ++j) {
      double squares = 0;
      for (std::size_t i = j; i < v.size(); i += points) squares += v[i] * v[i];
      const double speed = std::sqrt(squares);
      for (std::size_t i = j; i < v.size(); i += points) visit(i, speed);
    }
  }
  double c_;
  std::size_t components_;
};

class OwnFlow final : public Friction {
 public:
  explicit OwnFlow(OwnFriction own) : own_(std::move(own)) {
    if (!own_.force || !own_.flow) throw Error("a friction of one's own needs both its force and its flow");
  }

  void force(double t, std::span<const double> q, std::span<const double> v, std::span<double> r) const override {
    own_.force(t, q, v, r);
    double power = 0;
    for (std::size_t i = 0; i < v.size(); ++i) power += v[i] * r[i];
    if (power < 0) fed_.store(t, std::memory_order_relaxed);
  }
  void flow(double t, double h, double w, std::span<const double> q, std::span<double> v) const override {
    const double before = squares(v);
    own_.flow(t, h, w, q, v);
    const double after = squares(v);
    if (!(after > before * (1 + 8 * epsilon))) return;  // or NaN: the caller sees it
    fed_.store(t, std::memory_order_relaxed);
    const double scale = std::sqrt(before / after);
    for (double& x : v) x *= scale;
    corrections_.fetch_add(1, std::memory_order_relaxed);
  }
  bool uses_coordinates() const override { return own_.uses_coordinates; }
  bool is_dissipative() const override { return false; }  // not known: the run checks
  std::string feeds_at(double) const override { return ""; }
  std::string fed_at() const override {
    const double t = fed_.load(std::memory_order_relaxed);
    return std::isnan(t) ? "" : fmt::format("t = {:.6g}", t);
  }
  std::int64_t corrections() const override { return corrections_.load(std::memory_order_relaxed); }
  std::string text() const override { return own_.text; }
  FrictionPointer with_own_memory() const override { return std::make_shared<OwnFlow>(own_); }
  void forget_fed() const override { fed_.store(std::numeric_limits<double>::quiet_NaN(), std::memory_order_relaxed); }

 private:
  static double squares(std::span<const double> v) {
    double sum = 0;
    for (const double x : v) sum += x * x;
    return sum;
  }
  OwnFriction own_;
  mutable std::atomic<std::int64_t> corrections_ = 0;
  mutable std::atomic<double> fed_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace

FrictionPointer quadratic_friction(double linear, double c) {
  require_nonnegative(linear, "linear part");
  require_nonnegative(c, "coefficient");
  return by_component(Quadratic{linear, c},
                      linear > 0 ? fmt::format("({} + {} |v|)v", linear, c) : fmt::format("{} |v|v", c));
}

FrictionPointer cubic_friction(double c) {
  require_nonnegative(c, "coefficient");
  return by_component(Cubic{c}, fmt::format("{} v³", c));
}

FrictionPointer saturating_friction(double c, double width) {
  require_nonnegative(c, "coefficient");
  if (!std::isfinite(width) || width <= 0) throw Error("the friction's width = {} must be > 0", width);
  return by_component(Saturating{c, width}, fmt::format("{} tanh(v/{})", c, width));
}

FrictionPointer dry_friction(double c) {
  require_nonnegative(c, "coefficient");
  return by_component(Dry{c}, fmt::format("{} sgn(v)", c));
}

FrictionPointer isotropic_friction(double c, std::size_t components) {
  require_nonnegative(c, "coefficient");
  if (components == 0) throw Error("a velocity has at least one component");
  return std::make_shared<IsotropicFriction>(c, components);
}

FrictionPointer own_friction(OwnFriction own) { return std::make_shared<OwnFlow>(std::move(own)); }

}  // namespace seiche
