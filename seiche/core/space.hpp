// ℝⁿ with its coordinates: the only place that knows what the numbers in State::z are, and who else holds some.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/base/vector.hpp>
#include <seiche/core/grid/units.hpp>
#include <seiche/core/simd/products.hpp>

#include <cmath>
#include <span>
#include <type_traits>

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

  using Field = FieldPart;
  virtual Field slots() const { return {size()}; }
  virtual Field values() const { return {physical_size()}; }
  // Totals over all processes of sums over the units that this one holds, `totals.size()` side by side for each: added
  // in the order of units, they do not depend on how many processes there are. Of one unit that is what `sum` does, and
  // both may be one array.
  virtual void add_units(const Units& units, std::span<const double> sums, std::span<double> totals) const;
  // The numbers of a vector in all processes, in the order that they have in one, piece by piece: on the first process.
  // What `take` throws is thrown there when all pieces have passed, since the other processes do not know of it.
  virtual void join(const Field& /*field*/, std::span<const double> mine,
                    FunctionRef<void(std::span<const double> piece)> take) const {
    take(mine);
  }

  double sum(double local) const {
    sum({&local, 1});
    return local;
  }
  double max(double local) const {
    max({&local, 1});
    return local;
  }
  Index size_of_all() const { return static_cast<Index>(sum(static_cast<double>(size()))); }  // the numbers of z
  bool any(bool local) const { return max(local ? 1.0 : 0.0) != 0; }
  bool all(bool local) const { return max(local ? 0.0 : 1.0) == 0; }

  // Of what `of_unit` says of each unit, in as many numbers as there are totals; it adds up nothing itself.
  void add(const Units& units, FunctionRef<void(Index unit, std::span<double> sums)> of_unit,
           std::span<double> totals) const;
  template <class OfUnit>
  double total(const Units& units, const OfUnit& of_unit) const {
    if (units.whole().count() == 1) return sum(units.count() == 1 ? of_unit(Index{0}) : 0.0);
    double total = 0;
    add(units, [&](Index unit, std::span<double> sum) { sum[0] = of_unit(unit); }, {&total, 1});
    return total;
  }

  // Of vectors, parts of them that are whole fields, and expressions, in the coordinates of z.
  template <class A, class B>
  double dot(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) const {
    return over(slots(), a.size(), [&](Index begin, Index size) {
      if constexpr (std::is_same_v<A, Vector> && std::is_same_v<B, Vector>)
        return seiche::dot(a.derived().data() + begin, b.derived().data() + begin, size);
      else
        return a.segment(begin, size).dot(b.segment(begin, size));
    });
  }
  ValueAndMagnitude dot_and_magnitude(const Vector& a, const Vector& b) const;
  template <class A, class B>
  double absolute_dot(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) const {
    return over(slots(), a.size(), [&](Index begin, Index size) {
      return (a.segment(begin, size).array() * b.segment(begin, size).array()).abs().sum();
    });
  }
  template <class A>
  double squared_norm(const Eigen::MatrixBase<A>& a) const {
    return squared_norm(slots(), a);
  }
  template <class A>
  double norm(const Eigen::MatrixBase<A>& a) const {
    return std::sqrt(squared_norm(a));
  }
  // Without squares that under- or overflow.
  template <class A>
  double stable_norm(const Eigen::MatrixBase<A>& a) const {
    const double largest = max_norm(a);
    if (!(largest > 0 && std::isfinite(largest))) return largest;
    return largest * std::sqrt(squared_norm(a.derived() / largest));
  }
  // Of physical values.
  template <class A>
  double norm_of_values(const Eigen::MatrixBase<A>& u) const {
    return std::sqrt(squared_norm(values(), u));
  }
  // Of either.
  template <class A>
  double max_norm(const Eigen::MatrixBase<A>& a) const {
    return max(a.template lpNorm<Eigen::Infinity>());
  }
  template <class A>
  bool is_finite(const Eigen::MatrixBase<A>& a) const {
    return all(a.allFinite());
  }

 private:
  template <class A>
  double squared_norm(const Field& field, const Eigen::MatrixBase<A>& a) const {
    return over(field, a.size(), [&](Index begin, Index size) {
      if constexpr (std::is_same_v<A, Vector>)
        return seiche::squared_norm(a.derived().data() + begin, size);
      else
        return a.segment(begin, size).squaredNorm();
    });
  }
  template <class OfPart>
  double over(const Field& field, Index size, const OfPart& of_part) const {
    return total(field.units, [&](Index unit) {
      double sum = 0;
      field.for_parts(size, unit, [&](Index begin, Index length) { sum += of_part(begin, length); });
      return sum;
    });
  }
};

}  // namespace seiche
