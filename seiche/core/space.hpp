// ℝⁿ with its coordinates: the only place that knows what the numbers in State::z are, and who else holds some.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <cmath>
#include <span>

namespace seiche {

// Coordinates are orthonormal: the Euclidean product of two states is that of their physical values.
class Space {
 public:
  virtual ~Space() = default;
  virtual Index size() const = 0;           // of State::z; may hold slots that are always zero
  virtual Index physical_size() const = 0;  // fields × unknowns
  virtual void to_physical(const Vector& z, Vector& values) const = 0;
  virtual void from_physical(const Vector& values, Vector& z) const = 0;

  Vector physical(const Vector& z) const;

  // A vector is the part of a state that this process holds. What all of the state decides, a length, a maximum,
  // whether it is finite, goes through these: sums and maxima over all processes of what each knows, several numbers
  // together. In one process there is nothing to do.
  virtual void sum(std::span<double> /*local*/) const {}
  virtual void max(std::span<double> /*local*/) const {}

  double sum(double local) const {
    sum({&local, 1});
    return local;
  }
  double max(double local) const {
    max({&local, 1});
    return local;
  }
  bool any(bool local) const { return max(local ? 1.0 : 0.0) != 0; }
  bool all(bool local) const { return max(local ? 0.0 : 1.0) == 0; }

  // Of vectors, parts of them and expressions, in the coordinates of z or in physical values.
  template <class A, class B>
  double dot(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) const {
    return sum(a.dot(b));
  }
  template <class A, class B>
  double absolute_dot(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) const {
    return sum((a.array() * b.array()).abs().sum());
  }
  template <class A>
  double squared_norm(const Eigen::MatrixBase<A>& a) const {
    return sum(a.squaredNorm());
  }
  template <class A>
  double norm(const Eigen::MatrixBase<A>& a) const {
    return std::sqrt(squared_norm(a));
  }
  // Without squares that under- or overflow.
  template <class A>
  double stable_norm(const Eigen::MatrixBase<A>& a) const {
    const double local = a.stableNorm(), largest = max(local);
    return largest > 0 && std::isfinite(largest) ? largest * std::sqrt(sum(square(local / largest))) : largest;
  }
  template <class A>
  double max_norm(const Eigen::MatrixBase<A>& a) const {
    return max(a.template lpNorm<Eigen::Infinity>());
  }
  template <class A>
  bool is_finite(const Eigen::MatrixBase<A>& a) const {
    return all(a.allFinite());
  }
};

}  // namespace seiche
