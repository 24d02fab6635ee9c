#include <seiche/figure/plot/axis.hpp>
#include <seiche/figure/plot/linear_ticks.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

std::string signed_text(bool is_negative, const std::string& size) { return is_negative ? "−" + size : size; }

int decade_of(double value) { return static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9)); }

// Numbers from 0.001 to 10000 are as short as their powers of ten.
bool is_ordinary(int decade) { return decade >= -3 && decade <= 3; }

std::string number(double value) {
  const int decade = value == 0 ? 0 : decade_of(value);
  if (is_ordinary(decade) || std::abs(value) < 1e7) return fmt::format("{:.10g}", value);
  const std::string factor = fmt::format("{:.10g}", value / std::pow(10.0, decade));
  return factor == "1" ? power_text(10, decade) : factor + "·" + power_text(10, decade);
}

// The one of fewest digits in between.
double shortest_between(double low, double high) {
  const double middle = 0.5 * (low + high);
  for (int decade = decade_of(middle);; --decade) {
    const double unit = std::pow(10.0, decade);
    const double rounded = std::round(middle / unit) * unit;
    if (rounded >= low && rounded <= high) return rounded;
  }
}

std::string fixed(double value, int digits) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), digits);
  if (digits > 0) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return signed_text(value < 0 && text != "0", text);
}

}  // namespace

std::string power_text(int base, int n) {
  return fmt::format("{}^{{{}}}", base, signed_text(n < 0, std::to_string(std::abs(n))));
}

LinearTicks linear_ticks(double low, double high, int count) {
  LinearTicks result;
  const double span = high - low;
  const double largest = std::max(std::abs(low), std::abs(high));
  if (!(span > 1e-14 * largest) || !std::isfinite(span)) return result;
  constexpr double alike = 1e4;  // then the first four digits of all numbers are the same
  const double offset = largest > alike * span ? shortest_between(low, high) : 0.0;
  const int decade = decade_of(std::max(std::abs(low - offset), std::abs(high - offset)));
  const bool is_short = is_ordinary(decade) && (offset == 0 || decade >= 0);
  const double unit = is_short ? 1.0 : std::pow(10.0, decade);
  if (offset == 0 && unit == 1) return result;

  const double step = tick_step(span, count);
  const int digits = std::max(0, -decade_of(step / unit));
  result.ticks.clear();
  for (double k = std::ceil((low - offset) / step - 1e-6); k * step <= (high - offset) + 1e-6 * step; ++k)
    result.ticks += fmt::format("{}'{}' {:.17g}", result.ticks.empty() ? "" : ", ", fixed(k * step / unit, digits),
                                offset + k * step);
  result.ticks = "(" + result.ticks + ")";
  if (offset != 0) result.offset = fmt::format(" {} {}", offset < 0 ? "+" : "−", number(std::abs(offset)));
  if (unit != 1) result.power = " / " + power_text(10, decade);
  return result;
}

std::string with_unit(const std::string& label, const LinearTicks& ticks) {
  if (ticks.offset.empty() && ticks.power.empty()) return label;
  const bool both = !ticks.offset.empty() && !ticks.power.empty();
  return fmt::format("('{}' . {} . '{}{}{}')", both ? "(" : "", label, ticks.offset, both ? ")" : "", ticks.power);
}

}  // namespace seiche
