// A damping coefficient as a user states it: γ(t), or γ(x, t) that has yet to meet the points of a grid.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/core/rate.hpp>

#include <memory>
#include <string>

namespace seiche {

class SpaceRate {
 public:
  virtual ~SpaceRate() = default;
  virtual FieldRatePointer on(const Grid& grid) const = 0;  // throws Error where the grid has too few axes
  virtual std::string text() const = 0;
};

using SpaceRatePointer = std::shared_ptr<const SpaceRate>;

// At most one of the two; neither: no damping.
struct DampingRate {
  RatePointer uniform = nullptr;
  SpaceRatePointer varying = nullptr;

  DampingRate() = default;
  DampingRate(std::nullptr_t) {}                                      // NOLINT(google-explicit-constructor): an option
  DampingRate(RatePointer gamma) : uniform(std::move(gamma)) {}       // NOLINT(google-explicit-constructor)
  DampingRate(SpaceRatePointer gamma) : varying(std::move(gamma)) {}  // NOLINT(google-explicit-constructor)
};

}  // namespace seiche
