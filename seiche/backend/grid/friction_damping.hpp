// Linear damping together with friction beyond linear, in whichever coordinates a FieldTransform gives each field.
#pragma once

#include <seiche/backend/fft/transform.hpp>
#include <seiche/core/damping.hpp>
#include <seiche/core/momenta.hpp>

#include <memory>

namespace seiche {

// The flow of R stands between two halves of that of D: symmetric, of order two, and each factor keeps the law.
class FrictionDamping final : public Damping {
 public:
  // `problem` has friction. Throws Error where it has no momenta for it.
  FrictionDamping(const Problem& problem, std::shared_ptr<const FieldTransform> transform,
                  std::unique_ptr<Damping> linear);

  bool is_zero() const override { return false; }
  bool is_linear() const override { return false; }
  bool touches_potential() const override { return touches_potential_; }
  void flow(double t, double h, Vector& z) const override;
  void apply(double t, const Vector& z, Vector& out) const override;
  bool is_constant() const override { return false; }
  void add_quadrature_error(double t, double h, std::span<const double> c, std::span<const double> w, const Vector& z,
                            Vector& out) const override {
    linear_->add_quadrature_error(t, h, c, w, z, out);
  }
  void apply_rest(double t, const Vector& z, Vector& out) const override;
  void apply_D0(const Vector& z, Vector& out) const override { linear_->apply_D0(z, out); }
  std::int64_t corrections() const override { return friction_->corrections(); }

 private:
  void read_points(const Vector& z) const;                          // q_ and v_
  void add_friction(double t, const Vector& z, Vector& out) const;  // out += R(t, z)

  FrictionPointer friction_;
  Momenta momenta_;
  std::shared_ptr<const FieldTransform> transform_;
  std::unique_ptr<Damping> linear_;
  bool touches_potential_;
  mutable Vector q_, v_, r_;  // at the points
  mutable Vector slots_;      // of one field
};

}  // namespace seiche
