#include <seiche/core/simd/long_sum.hpp>
#include <seiche/core/space.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace seiche {

Vector Space::physical(const Vector& z) const {
  Vector values(physical_size());
  to_physical(z, values);
  return values;
}

ValueAndMagnitude Space::dot_and_magnitude(const Vector& a, const Vector& b) const {
  const Field field = slots();
  std::array<double, 2> totals{};
  add(
      field.units,
      [&](Index unit, std::span<double> sums) {
        ValueAndMagnitude sum;
        field.for_parts(a.size(), unit, [&](Index begin, Index size) {
          sum += seiche::dot_and_magnitude(a.data() + begin, b.data() + begin, size);
        });
        sums[0] = sum.value;
        sums[1] = sum.magnitude;
      },
      totals);
  return {totals[0], totals[1]};
}

void Space::add_units(const Units&, std::span<const double> sums, std::span<double> totals) const {
  if (sums.size() == totals.size()) {  // of one unit
    if (sums.data() != totals.data()) std::copy(sums.begin(), sums.end(), totals.begin());
    return;
  }
  for (std::size_t i = 0; i < totals.size(); ++i) {
    LongSum total;
    for (std::size_t at = i; at < sums.size(); at += totals.size()) total.add(sums[at]);
    totals[i] = total.total();
  }
}

void Space::add(const Units& units, FunctionRef<void(Index unit, std::span<double> sums)> of_unit,
                std::span<double> totals) const {
  const std::size_t k = totals.size();
  if (units.count() == 1) {
    of_unit(0, totals);
    return add_units(units, totals, totals);
  }
  thread_local std::vector<double> sums;  // no step allocates
  sums.resize(static_cast<std::size_t>(units.count()) * k);
  for (Index unit = 0; unit < units.count(); ++unit)
    of_unit(unit, std::span(sums).subspan(static_cast<std::size_t>(unit) * k, k));
  add_units(units, sums, totals);
}

}  // namespace seiche
