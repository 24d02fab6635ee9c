#include <seiche/damping/adaptive_integral.hpp>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <limits>

namespace seiche {
namespace {

using boost::math::quadrature::gauss_kronrod;

// Kronrod's 15 points on halved intervals. Not Boost's own halving, which asks each half for twice the relative
// accuracy and so descends to its last level everywhere once a formula has a kink.
class AdaptiveIntegral {
 public:
  AdaptiveIntegral(double (*f)(const void*, double), const void* data) : f_(f), data_(data) {}

  double operator()() {
    const Estimate whole = estimate(0.0, 1.0);
    allowed_error_ = tolerance * whole.magnitude;
    return refined(whole, 0.0, 1.0, 40);
  }

 private:
  static constexpr double tolerance = 1e-14;
  static constexpr double loose = 1e-8;
  struct Estimate {
    double value, error, magnitude;  // magnitude: ∫|f|, so that a change of sign is no reason to refine
  };

  Estimate estimate(double a, double b) {
    const double half = (b - a) / 2;
    const auto f = [&](double x) { return f_(data_, a + half * (1 + x)); };
    Estimate e{};
    e.value = half * gauss_kronrod<double, 15>::integrate(f, -1.0, 1.0, 0, 0.0, &e.error, &e.magnitude);
    e.error *= half;
    e.magnitude *= half;
    return e;
  }

  double refined(const Estimate& e, double a, double b, int depth) {
    const bool good = !(e.error > tolerance * e.magnitude && e.error > allowed_error_);  // also for NaN
    if (good) return e.value;
    if (depth == 0 || --halvings_left_ < 0) {
      // Round-off above the tolerance may end here, a pole does: then there is no integral.
      return e.error <= loose * std::max(e.magnitude, allowed_error_ / tolerance)
                 ? e.value
                 : std::numeric_limits<double>::quiet_NaN();
    }
    const double middle = (a + b) / 2;
    const double left = refined(estimate(a, middle), a, middle, depth - 1);
    return left + refined(estimate(middle, b), middle, b, depth - 1);
  }

  double (*f_)(const void*, double);
  const void* data_;
  double allowed_error_ = 0.0;
  int halvings_left_ =
      20000;  // a kink costs about 20; the bound is for formulas whose round-off is above the tolerance
};

}  // namespace

double adaptive_integral(double (*f)(const void* data, double s), const void* data) {
  return AdaptiveIntegral(f, data)();
}

}  // namespace seiche
