// Reductions over a state of which other processes hold parts.
#include <seiche/core/space.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace TEST_FILE {

// Another process holds the same numbers once more, or the maximum given.
class HeldTwice final : public Space {
 public:
  explicit HeldTwice(double elsewhere) : elsewhere_(elsewhere) {}
  Index size() const override { return 3; }
  Index physical_size() const override { return 3; }
  void to_physical(const Vector& z, Vector& values) const override { values = z; }
  void from_physical(const Vector& values, Vector& z) const override { z = values; }
  using Space::max;
  using Space::sum;
  void sum(std::span<double> local) const override {
    for (double& x : local) x *= 2;
  }
  void add_units(const Units& units, std::span<const double> sums, std::span<double> totals) const override {
    Space::add_units(units, sums, totals);
    sum(totals);
  }
  void max(std::span<double> local) const override {
    for (double& x : local) x = std::max(x, elsewhere_);
  }

 private:
  double elsewhere_;
};

TEST(Space, LengthsAreThoseOfAllParts) {
  const HeldTwice space(0);
  const Vector a{{3, 0, -4}}, b{{1, 2, 0.5}};
  EXPECT_EQ(space.dot(a, b), 2.0);
  EXPECT_EQ(space.absolute_dot(a, b), 10.0);
  EXPECT_EQ(space.dot_and_magnitude(a, b).value, 2.0);
  EXPECT_EQ(space.dot_and_magnitude(a, b).magnitude, 10.0);
  EXPECT_EQ(space.squared_norm(a.head(1)), 18.0);
  EXPECT_DOUBLE_EQ(space.norm(a), std::sqrt(50.0));
  EXPECT_DOUBLE_EQ(space.stable_norm(1e-200 * a), 1e-200 * std::sqrt(50.0));
  EXPECT_EQ(space.stable_norm(0 * a), 0.0);
}

// Two fields of five planes, in two units.
class InPlanes final : public Space {
 public:
  explicit InPlanes(Index plane) : plane_(plane) {}
  Index size() const override { return 2 * 5 * plane_; }
  Index physical_size() const override { return size(); }
  void to_physical(const Vector& z, Vector& values) const override { values = z; }
  void from_physical(const Vector& values, Vector& z) const override { z = values; }
  Field slots() const override { return {.size = 5 * plane_, .units = {.planes = 5}}; }

 private:
  Index plane_;
};

TEST(Space, SumsAreTakenUnitByUnitOfAllFields) {
  const InPlanes space(3);
  const Vector a = Vector::LinSpaced(30, -1, 2), b = a.array().sin();
  const auto of_units = [&](const auto& part) {  // planes 0 and 1, and 2 to 4
    return (part(a, b, 0, 6) + part(a, b, 15, 6)) + (part(a, b, 6, 9) + part(a, b, 21, 9));
  };
  EXPECT_EQ(space.dot(a, b), of_units([](const Vector& x, const Vector& y, Index at, Index n) {
              return dot(x.data() + at, y.data() + at, n);
            }));
  EXPECT_EQ(space.squared_norm(a + b), of_units([](const Vector& x, const Vector& y, Index at, Index n) {
              return (x + y).segment(at, n).squaredNorm();
            }));
  EXPECT_NEAR(space.squared_norm(a), a.squaredNorm(), 1e-14 * a.squaredNorm());
  EXPECT_NEAR(space.dot(a.tail(15), b.tail(15)), a.tail(15).dot(b.tail(15)), 1e-14) << "one field";
  EXPECT_NEAR(space.stable_norm(1e-200 * a), 1e-200 * a.norm(), 1e-214);
}

TEST(Space, MaximaAndDecisionsAreThoseOfAllParts) {
  const Vector a{{3, 0, -4}}, broken{{1, std::nan(""), 2}};
  EXPECT_EQ(HeldTwice(1).max_norm(a), 4.0);
  EXPECT_EQ(HeldTwice(9).max_norm(a), 9.0);
  EXPECT_TRUE(HeldTwice(0).is_finite(a));
  EXPECT_FALSE(HeldTwice(0).is_finite(broken));
  EXPECT_FALSE(HeldTwice(1).is_finite(a)) << "another part is not finite";
}

}  // namespace TEST_FILE
}  // namespace seiche
