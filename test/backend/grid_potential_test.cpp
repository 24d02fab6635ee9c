// V of the values at points, shared by processes.
#include <test/support/thread_ranks.hpp>

#include <gtest/gtest.h>
#include <seiche/backend/fft/transform.hpp>
#include <seiche/backend/grid/grid_potential.hpp>
#include <seiche/backend/grid/grid_space.hpp>
#include <seiche/potential/polynomials.hpp>

#include <memory>
#include <mutex>

namespace seiche::test {
namespace TEST_FILE {

// Points so few that they are one unit are all on one process, and others hold none.
TEST(GridPotential, HasOneValueOnAllProcesses) {
  for (const Index points : {3, 8, 40}) {
    std::mutex mutex;
    const double expected = static_cast<double>(points) / 4 * 16;  // Σ u⁴/4 at u = 2
    on_ranks(2, [&](const Ranks& ranks) {
      const Units whole = units_in_eights(points, 1);
      const Slab here = slab_of(whole, ranks.here());
      const FieldPart part{here.planes, units_of(whole, ranks.here()), here.first, points};
      const std::shared_ptr<const FieldTransform> identity = identity_transform(part);
      const GridSpace space(1, identity, &ranks);
      const GridPotential potential(nodal_polynomial(monomial(0.25, 4)), 0, identity, space);
      const Vector z = Vector::Constant(here.planes, 2.0);
      Vector gradient(here.planes), in_place = z;
      const double value = potential.value(z);
      const double beside = potential.value_and_gradient(z, gradient);
      const double itself = potential.value_and_gradient(in_place, in_place);
      const std::scoped_lock lock(mutex);
      EXPECT_EQ(value, expected) << points;
      EXPECT_EQ(beside, expected) << points;
      EXPECT_EQ(itself, expected) << points;
      EXPECT_EQ(gradient, Vector::Constant(here.planes, 8.0)) << points;
      EXPECT_EQ(in_place, gradient) << points;
    });
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
