// The space of a system on a grid, in whichever coordinates a FieldTransform gives each field.
#pragma once

#include <seiche/backend/fft/transform.hpp>
#include <seiche/core/space.hpp>

#include <memory>

namespace seiche {

class GridSpace final : public Space {
 public:
  GridSpace(Index fields, std::shared_ptr<const FieldTransform> transform);
  Index size() const override { return fields_ * transform_->slots(); }
  Index physical_size() const override { return fields_ * transform_->unknowns(); }
  void to_physical(const Vector& z, Vector& values) const override;
  void from_physical(const Vector& values, Vector& z) const override;

 private:
  Index fields_;
  std::shared_ptr<const FieldTransform> transform_;
};

}  // namespace seiche
