#include <seiche/core/base/vector.hpp>
#include <seiche/core/simd/multiversion.hpp>
#include <seiche/formula/formula_function.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace seiche {
namespace {

double sech(double x) { return 1.0 / std::cosh(x); }
double step(double x) { return x == 0 ? 0.5 : std::isnan(x) ? x : x > 0 ? 1.0 : 0.0; }
double sign(double x) { return x == 0 || std::isnan(x) ? x : std::copysign(1.0, x); }
// Unlike std::fmin, NaN stays NaN: a wrong value must not vanish in a minimum.
double smaller(double a, double b) { return std::isnan(a) || a < b ? a : b; }
double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

// sin(x)/x and sinh(x)/x
double sinc(double x) { return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x; }
double sinhc(double x) { return std::abs(x) < 1e-4 ? 1 + x * x / 6 : std::sinh(x) / x; }

// Where no addition theorem helps: the difference where b − a is no small part of the distance to the next singularity,
// and else Gauss' rule with four nodes for the mean of the derivative, whose error is that of the eighth power of this
// part.
template <class Value, class Derivative>
double mean_slope(double a, double b, double distance, const Value& value, const Derivative& derivative) {
  constexpr std::array nodes = {0.33998104358485626480, 0.86113631159405257522};
  constexpr std::array weights = {0.32607257743127307131, 0.17392742256872692869};
  const double d = b - a;
  if (std::abs(d) > 0.05 * distance) return (value(b) - value(a)) / d;
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const double node : {-nodes[i], nodes[i]}) sum += weights[i] * derivative((a + b) / 2 + node * d / 2);
  return sum;
}

double slope_of_sin(double a, double b) { return std::cos((a + b) / 2) * sinc((b - a) / 2); }
double slope_of_cos(double a, double b) { return -std::sin((a + b) / 2) * sinc((b - a) / 2); }
double slope_of_tan(double a, double b) { return sinc(b - a) / (std::cos(a) * std::cos(b)); }
double slope_of_sinh(double a, double b) { return std::cosh((a + b) / 2) * sinhc((b - a) / 2); }
double slope_of_cosh(double a, double b) { return std::sinh((a + b) / 2) * sinhc((b - a) / 2); }
double slope_of_exp(double a, double b) {
  if (std::abs(b - a) > 1) return (std::exp(b) - std::exp(a)) / (b - a);  // neither factor below may overflow alone
  return std::exp((a + b) / 2) * sinhc((b - a) / 2);
}
double slope_of_sqrt(double a, double b) { return 1 / (std::sqrt(a) + std::sqrt(b)); }
// At a = b = 0 the mean of both sides: |x| has no slope there.
double slope_of_abs(double a, double b) { return a == 0 && b == 0 ? 0.0 : (a + b) / (std::abs(a) + std::abs(b)); }
double slope_of_sign(double a, double b) { return a == b ? 0.0 : (sign(b) - sign(a)) / (b - a); }
double slope_of_step(double a, double b) { return slope_of_sign(a, b) / 2; }
double slope_of_sech(double a, double b) {
  if (std::abs(b - a) > 1) return (sech(b) - sech(a)) / (b - a);
  return -slope_of_cosh(a, b) * sech(a) * sech(b);
}

// tanh b − tanh a = sinh(b − a)/(cosh a cosh b), in exponentials that do not overflow
double slope_of_tanh(double a, double b) {
  const double d = std::abs(b - a);
  const double cosines = (1 + std::exp(-2 * std::abs(a))) * (1 + std::exp(-2 * std::abs(b)));
  const double share = d == 0 ? 2 : -std::expm1(-2 * d) / d;
  return 2 * share * std::exp(d - std::abs(a) - std::abs(b)) / cosines;
}

double slope_of_log(double a, double b) {
  if (!(a > 0 && b > 0)) return std::nan("");
  const double least = std::min(a, b), d = std::abs(b - a);
  return d == 0 ? 1 / a : std::log1p(d / least) / d;
}

// b·ca − a·cb, where (b·ca)² − (a·cb)² = b² − a²
double sine_of_difference(double a, double ca, double b, double cb) {
  return a * b > 0 ? (b - a) * (b + a) / (b * ca + a * cb) : b * ca - a * cb;
}

// tan(atan b − atan a) = (b − a)/(1 + ab)
double slope_of_atan(double a, double b) {
  const double d = b - a;
  if (d == 0) return 1 / (1 + a * a);
  return (a * b > 0 ? std::atan(d / (1 + a * b)) : std::atan(b) - std::atan(a)) / d;
}
// sinh(asinh b − asinh a) = b√(1 + a²) − a√(1 + b²)
double slope_of_asinh(double a, double b) {
  const double ca = std::hypot(1, a), cb = std::hypot(1, b);
  return a == b ? 1 / ca : std::asinh(sine_of_difference(a, ca, b, cb)) / (b - a);
}
// sin(asin b − asin a) = b√(1 − a²) − a√(1 − b²), and the cosine by the same theorem
double slope_of_asin(double a, double b) {
  const double ca = std::sqrt((1 - a) * (1 + a)), cb = std::sqrt((1 - b) * (1 + b));
  return a == b ? 1 / ca : std::atan2(sine_of_difference(a, ca, b, cb), a * b + ca * cb) / (b - a);
}
double slope_of_acos(double a, double b) { return -slope_of_asin(a, b); }
// sinh(acosh b − acosh a) = a√(b² − 1) − b√(a² − 1)
double slope_of_acosh(double a, double b) {
  const double sa = std::sqrt((a - 1) * (a + 1)), sb = std::sqrt((b - 1) * (b + 1));
  return a == b ? 1 / sa : std::asinh((b - a) * (b + a) / (a * sb + b * sa)) / (b - a);
}
// tanh(atanh b − atanh a) = (b − a)/(1 − ab), with 1 − ab = (1 − a) + a(1 − b)
double slope_of_atanh(double a, double b) {
  if (a == b) return 1 / ((1 - a) * (1 + a));
  if (a * b <= 0) return (std::atanh(b) - std::atanh(a)) / (b - a);
  return std::atanh((b - a) / ((1 - a) + a * (1 - b))) / (b - a);
}

// f'((a + b)/2) · s(d)/d with d = (b − a)/2, where s is sin or sinh, and s(d)/d = 1 + sign·d²/6 near 0.
template <VectorFunctions::One VectorFunctions::*derivative, VectorFunctions::One VectorFunctions::*s, int sign>
SEICHE_MULTIVERSION void slopes_by_addition(const double* a, const double* b, double* slopes, std::size_t n) {
  constexpr std::size_t block = 64;
  std::array<double, block> d{}, of_d{};
  for (std::size_t begin = 0; begin < n; begin += block) {
    const std::size_t count = std::min(block, n - begin);
    double* const out = slopes + begin;
    for (std::size_t j = 0; j < count; ++j) {
      d[j] = (b[begin + j] - a[begin + j]) / 2;
      out[j] = (a[begin + j] + b[begin + j]) / 2;
    }
    (vector_functions().*s)(d.data(), of_d.data(), count);
    (vector_functions().*derivative)(out, out, count);
    for (std::size_t j = 0; j < count; ++j) {
      const double ratio = of_d[j] / d[j];  // not a number at 0, where it is not taken
      out[j] *= std::abs(d[j]) < 1e-4 ? 1 + sign * d[j] * d[j] / 6 : ratio;
    }
  }
}
constexpr auto slopes_of_sin = slopes_by_addition<&VectorFunctions::cos, &VectorFunctions::sin, -1>;
void slopes_of_cos(const double* a, const double* b, double* slopes, std::size_t n) {
  slopes_by_addition<&VectorFunctions::sin, &VectorFunctions::sin, -1>(a, b, slopes, n);
  for (std::size_t j = 0; j < n; ++j) slopes[j] = -slopes[j];
}
void slopes_of_exp(const double* a, const double* b, double* slopes, std::size_t n) {
  slopes_by_addition<&VectorFunctions::exp, &VectorFunctions::sinh, 1>(a, b, slopes, n);
  for (std::size_t j = 0; j < n; ++j)
    if (!(std::abs(b[j] - a[j]) <= 1)) slopes[j] = slope_of_exp(a[j], b[j]);
}

double slope_of_log1p(double a, double b) {
  if (!(a > -1 && b > -1)) return std::nan("");
  const double least = std::min(a, b), d = std::abs(b - a);
  return d == 0 ? 1 / (1 + a) : std::log1p(d / (1 + least)) / d;
}

double as_far(double, double, double off) { return off; }
double carried_by_root(double, double y, double off) {  // √(x + off) − √x is no more than √off, at 0 too
  const double most = std::sqrt(off / epsilon);
  return off >= 2 * y * most ? most : off / (2 * y);
}
double carried_by_sine(double, double y, double off) { return std::sqrt(std::max(0.0, (1 - y) * (1 + y))) * off; }
// Of a function whose slope is 1/√c, and infinite at the end of its domain, c = 0.
double carried_to_an_end(double c, double off) {
  const double most = std::sqrt(2 * off / epsilon);
  return c > 0 ? std::min(off / std::sqrt(c), most) : most;
}
double carried_by_arc(double x, double, double off) { return carried_to_an_end((1 - x) * (1 + x), off); }

constexpr std::array<FormulaFunction, 23> function_table = {{
    {"sin", 1, [](double x) { return std::sin(x); }, nullptr, slope_of_sin, carried_by_sine, true,
     &VectorFunctions::sin, slopes_of_sin},
    {"cos", 1, [](double x) { return std::cos(x); }, nullptr, slope_of_cos, carried_by_sine, true,
     &VectorFunctions::cos, slopes_of_cos},
    {"tan", 1, [](double x) { return std::tan(x); }, nullptr, slope_of_tan,
     [](double, double y, double off) { return (1 + y * y) * off; }, true, &VectorFunctions::tan},
    {"asin", 1, [](double x) { return std::asin(x); }, nullptr, slope_of_asin, carried_by_arc, true,
     &VectorFunctions::asin},
    {"acos", 1, [](double x) { return std::acos(x); }, nullptr, slope_of_acos, carried_by_arc, true,
     &VectorFunctions::acos},
    {"atan", 1, [](double x) { return std::atan(x); }, nullptr, slope_of_atan,
     [](double x, double, double off) { return off / (1 + x * x); }, true, &VectorFunctions::atan},
    {"sinh", 1, [](double x) { return std::sinh(x); }, nullptr, slope_of_sinh,
     [](double, double y, double off) { return std::hypot(1, y) * off; }, true, &VectorFunctions::sinh},
    {"cosh", 1, [](double x) { return std::cosh(x); }, nullptr, slope_of_cosh,
     [](double, double y, double off) { return std::sqrt(std::max(0.0, (y - 1) * (y + 1))) * off; }, true,
     &VectorFunctions::cosh},
    {"tanh", 1, [](double x) { return std::tanh(x); }, nullptr, slope_of_tanh,
     [](double, double y, double off) { return (1 - y) * (1 + y) * off; }, true, &VectorFunctions::tanh},
    {"asinh", 1, [](double x) { return std::asinh(x); }, nullptr, slope_of_asinh,
     [](double x, double, double off) { return off / std::hypot(1, x); }, true, &VectorFunctions::asinh},
    {"acosh", 1, [](double x) { return std::acosh(x); }, nullptr, slope_of_acosh,
     [](double x, double, double off) { return carried_to_an_end((x - 1) * (x + 1), off); }, true,
     &VectorFunctions::acosh},
    {"atanh", 1, [](double x) { return std::atanh(x); }, nullptr, slope_of_atanh,
     [](double x, double, double off) { return off / ((1 - x) * (1 + x)); }, true, &VectorFunctions::atanh},
    {"exp", 1, [](double x) { return std::exp(x); }, nullptr, slope_of_exp,
     [](double, double y, double off) { return y * off; }, true, &VectorFunctions::exp, slopes_of_exp},
    {"log", 1, [](double x) { return std::log(x); }, nullptr, slope_of_log,
     [](double x, double, double off) { return off / x; }, true, &VectorFunctions::log},
    {"log1p", 1, [](double x) { return std::log1p(x); }, nullptr, slope_of_log1p,
     [](double x, double, double off) { return off / (1 + x); }, true, &VectorFunctions::log1p},
    {"expm1", 1, [](double x) { return std::expm1(x); }, nullptr, slope_of_exp,
     [](double, double y, double off) { return (1 + y) * off; }, true, &VectorFunctions::expm1, slopes_of_exp},
    {"sqrt", 1, [](double x) { return std::sqrt(x); }, nullptr, slope_of_sqrt, carried_by_root, true,
     &VectorFunctions::sqrt},
    {"abs", 1, [](double x) { return std::fabs(x); }, nullptr, slope_of_abs, as_far},
    {"sign", 1, sign, nullptr, slope_of_sign, [](double, double, double) { return 0.0; }, false},
    {"step", 1, step, nullptr, slope_of_step, [](double, double, double) { return 0.0; }, false},
    {"sech", 1, sech, nullptr, slope_of_sech, [](double, double y, double off) { return y * off; }},
    {"min", 2, nullptr, smaller, nullptr, nullptr, false},
    {"max", 2, nullptr, larger, nullptr, nullptr, false},
}};

}  // namespace

std::span<const FormulaFunction> formula_functions() { return function_table; }

const FormulaFunction* find_formula_function(std::string_view name) {
  const auto* found =
      std::find_if(function_table.begin(), function_table.end(), [&](const auto& entry) { return entry.name == name; });
  return found == function_table.end() ? nullptr : found;
}

// Σ aⁱ bⁿ⁻¹⁻ⁱ; and for 1/xᵐ, −(that for m)/(aᵐ bᵐ).
double mean_slope_of_whole_power(double a, double b, int n) {
  const int m = std::abs(n);
  double sum = 0;
  double power = 1;  // of b
  for (int i = 0; i < m; ++i) {
    sum = sum * a + power;
    power *= b;
  }
  return n >= 0 ? sum : -sum / (std::pow(a, m) * power);
}

double mean_slope_of_power(double a, double b, double c) {
  return mean_slope(
      a, b, std::min(a, b), [c](double x) { return std::pow(x, c); }, [c](double x) { return c * std::pow(x, c - 1); });
}

}  // namespace seiche
