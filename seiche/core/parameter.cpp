#include <seiche/core/base/error.hpp>
#include <seiche/core/parameter.hpp>
#include <seiche/core/text/number_text.hpp>

#include <cmath>

namespace seiche {

void ParameterValues::set(const std::string& name, ParameterValue value) { values_[name] = std::move(value); }

const ParameterValue& ParameterValues::at(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) throw Error("parameter '{}' was not declared by the problem", name);
  return found->second;
}

const RatePointer& ParameterValues::rate(const std::string& name) const {
  if (const auto* varying = std::get_if<SpaceRatePointer>(&at(name)))
    throw Error("{} = \"{}\" changes from point to point, and this problem takes a number or a formula in t", name,
                (*varying)->text());
  return get<RatePointer>(name);
}

DampingRate ParameterValues::damping_rate(const std::string& name) const {
  if (const auto* varying = std::get_if<SpaceRatePointer>(&at(name))) return *varying;
  return get<RatePointer>(name);
}

StateFunctionPointer ParameterValues::function(const std::string& name) const {
  const auto* given = std::get_if<StateFunctionPointer>(&at(name));
  return given != nullptr ? *given : nullptr;
}

std::vector<double> ParameterValues::numbers(const Parameter& p) const {
  if (p.kind == ParameterKind::real) return p.per_axis ? reals(p.name) : std::vector{real(p.name)};
  if (!p.per_axis) return {static_cast<double>(integer(p.name))};
  return {integers(p.name).begin(), integers(p.name).end()};
}

std::string out_of_bounds(const Parameter& p, double value) {
  if (!std::isfinite(value)) return fmt::format("{} = {} must be a finite number", p.name, number_text(value));
  const bool low = p.minimum_excluded ? value <= p.minimum : value < p.minimum;
  if (low) return fmt::format("{} = {} must be {} {}", p.name, value, p.minimum_excluded ? ">" : "≥", p.minimum);
  if (value > p.maximum) return fmt::format("{} = {} must be ≤ {}", p.name, value, p.maximum);
  return "";
}

}  // namespace seiche
