#include <seiche/figure/curves.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace seiche {

Curve thinned(const Curve& curve, std::size_t points) {
  const std::size_t n = std::min(curve.t.size(), curve.value.size());
  const std::size_t stretch = std::max<std::size_t>(1, 2 * n / std::max<std::size_t>(points, 2));
  Curve result{curve.name, {}, {}};
  const auto take = [&](std::size_t i) {
    result.t.push_back(curve.t[i]);
    result.value.push_back(curve.value[i]);
  };
  if (stretch <= 2) {
    for (std::size_t i = 0; i < n; ++i) take(i);
    return result;
  }
  for (std::size_t begin = 0; begin < n; begin += stretch) {
    const std::size_t end = std::min(begin + stretch, n);
    std::size_t low = end;
    std::size_t high = end;
    for (std::size_t i = begin; i < end; ++i) {
      if (!std::isfinite(curve.value[i])) continue;
      if (low == end || curve.value[i] < curve.value[low]) low = i;
      if (high == end || curve.value[i] > curve.value[high]) high = i;
    }
    if (low == end) continue;
    take(std::min(low, high));
    if (low != high) take(std::max(low, high));
  }
  // The ends of a curve are where the eye compares.
  if (n > 0 && !result.t.empty() && result.t.back() != curve.t[n - 1] && std::isfinite(curve.value[n - 1])) take(n - 1);
  return result;
}

std::vector<std::size_t> staggered(const std::vector<double>& t, int index, int count) {
  std::vector<std::size_t> marked;
  if (t.empty() || count <= 0) return marked;
  constexpr int per_curve = 6;
  for (int k = 0; k < per_curve; ++k) {
    const double at = (k + (index + 0.5) / count) / per_curve;
    const double wanted = t.front() + at * (t.back() - t.front());
    const auto place = std::lower_bound(t.begin(), t.end(), wanted);
    const auto i = static_cast<std::size_t>(std::min(place, t.end() - 1) - t.begin());
    if (marked.empty() || marked.back() != i) marked.push_back(i);
  }
  return marked;
}

bool falls_by_decades(const std::vector<Curve>& energies) {
  if (energies.empty()) return false;
  const auto found =
      std::find_if(energies.begin(), energies.end(), [](const Curve& c) { return c.name == "reference"; });
  const Curve& curve = found == energies.end() ? energies.back() : *found;
  double low = std::numeric_limits<double>::infinity();
  double high = 0;
  for (const double value : curve.value) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return low > 0 && std::isfinite(low) && high >= 100 * low;
}

Curve upper_envelope(const Curve& curve) {
  const std::size_t n = std::min(curve.t.size(), curve.value.size());
  Curve result{curve.name, {}, {}};
  for (std::size_t k = 0; k < envelope_stretches; ++k) {
    const std::size_t end = (k + 1) * n / envelope_stretches;
    std::size_t largest = end;
    for (std::size_t i = k * n / envelope_stretches; i < end; ++i) {
      if (!std::isfinite(curve.value[i])) continue;
      if (largest == end || curve.value[i] > curve.value[largest]) largest = i;
    }
    if (largest == end) continue;
    result.t.push_back(curve.t[largest]);
    result.value.push_back(curve.value[largest]);
  }
  return result;
}

std::string step_text(double h) {
  const auto power = [](int base, int exponent) {
    constexpr std::string_view digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = fmt::format("{}{}", base, exponent < 0 ? "⁻" : "");
    for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
    return text;
  };
  int exponent = 0;
  if (h > 0 && std::frexp(h, &exponent) == 0.5) return power(2, exponent - 1);
  const std::string text = fmt::format("{:g}", h);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  const std::string power_of_ten = power(10, std::stoi(text.substr(e + 1)));
  return text.starts_with("1e") ? power_of_ten : text.substr(0, e) + "·" + power_of_ten;
}

}  // namespace seiche
