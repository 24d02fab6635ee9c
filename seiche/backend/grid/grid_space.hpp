// The space of a system on a grid, in whichever coordinates a FieldTransform gives each field.
#pragma once

#include <seiche/backend/fft/transform.hpp>
#include <seiche/core/grid/ranks.hpp>
#include <seiche/core/space.hpp>

#include <memory>

namespace seiche {

class GridSpace final : public Space {
 public:
  GridSpace(Index fields, std::shared_ptr<const FieldTransform> transform, const Ranks* ranks = nullptr);
  using Space::max;
  using Space::sum;
  void sum(std::span<double> local) const override;
  void max(std::span<double> local) const override;
  void add_units(const Units& units, std::span<const double> sums, std::span<double> totals) const override;
  Index size() const override { return fields_ * transform_->slots(); }
  Index physical_size() const override { return fields_ * transform_->unknowns(); }
  void join(const Field& field, std::span<const double> mine,
            FunctionRef<void(std::span<const double> piece)> take) const override;
  Field slots() const override { return slots_; }
  Field values() const override { return values_; }
  void to_physical(const Vector& z, Vector& values) const override;
  void from_physical(const Vector& values, Vector& z) const override;

 private:
  Index fields_;
  std::shared_ptr<const FieldTransform> transform_;
  const Ranks* ranks_;  // null: this process alone
  Field slots_, values_;
};

}  // namespace seiche
