// External forces at the points of a grid, in whichever coordinates a FieldTransform gives each field.
#pragma once

#include <seiche/backend/fft/transform.hpp>
#include <seiche/core/external_force.hpp>
#include <seiche/core/problem.hpp>

#include <memory>
#include <vector>

namespace seiche {

class GridForce final : public ExternalForce {
 public:
  GridForce(const Problem& problem, std::shared_ptr<const FieldTransform> transform);
  void add(double t, double factor, Vector& out) const override;
  void impulse(double t, double h, Vector& z) const override;
  bool touches_potential() const override { return touches_potential_; }

 private:
  void add_slots(std::size_t field, double factor, Vector& out) const;  // of what stands in points_

  std::vector<FieldRatePointer> forces_;
  std::shared_ptr<const FieldTransform> transform_;
  bool touches_potential_ = false;
  mutable Vector points_, slots_;  // of one field
};

}  // namespace seiche
