// The part of a structure matrix that changes with the state, in whichever coordinates a FieldTransform gives each
// field.
#pragma once

#include <seiche/backend/fft/transform.hpp>
#include <seiche/backend/grid/grid_space.hpp>
#include <seiche/backend/linear_map.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/core/structure.hpp>

#include <memory>

namespace seiche {

class GridStructure final : public Structure {
 public:
  // `derivative`: of the coordinates of one field; null where problem.derivative is zero.
  GridStructure(const Problem& problem, std::shared_ptr<const FieldTransform> transform,
                std::unique_ptr<LinearMap> derivative);
  void apply(const Vector& z, const Vector& w, Vector& out) const override;
  bool without_means(const Vector& z, Vector& d) const override;

 private:
  void differentiate(std::span<const double> u, std::span<double> out) const;

  StructurePointer structure_;
  std::shared_ptr<const FieldTransform> transform_;
  GridSpace space_;
  std::unique_ptr<LinearMap> derivative_;
  mutable Vector z_, w_, out_;               // at the points, all fields
  mutable Vector slots_, derivative_slots_;  // of one field
};

}  // namespace seiche
