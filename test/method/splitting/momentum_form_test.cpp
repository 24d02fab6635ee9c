// Kicks of momenta.
#include <test/support/cases.hpp>

#include <gtest/gtest.h>
#include <seiche/backend/backends.hpp>
#include <seiche/core/generic_state.hpp>
#include <seiche/method/splitting/momentum_form.hpp>

#include <cmath>

namespace seiche::test {
namespace TEST_FILE {

TEST(MomentumKick, TellsByHowMuchItRaisesTheQuadraticEnergy) {
  int canonical = 0, others = 0;
  for (const auto& [name, problem] : all_cases())
    for (const BackendEntry& backend : backends_for(problem)) {
      const System system = backend.system(problem, {});
      const MomentumForm form = momentum_form(system);
      if (!form.kicks || system.potential->support().size == 0) continue;
      ++(form.canonical ? canonical : others);
      MomentumKick kick(system, form);
      Vector z = generic_state(*system.space), g = Vector::Zero(z.size());
      system.potential->gradient(z, g);
      const double before = system.linear->quadratic_energy(z);
      Vector kicked(z.size());
      kick.apply(0.3, g, z, kicked);
      const double lift = kick.lift(0.3, g, z);
      EXPECT_EQ((z - kicked).lpNorm<Eigen::Infinity>(), 0) << name << " " << backend.name;
      const double after = system.linear->quadratic_energy(z);
      EXPECT_NEAR(lift, after - before, 1e-13 * (std::abs(after) + std::abs(before))) << name << " " << backend.name;
    }
  EXPECT_GE(canonical, 10);
  EXPECT_GE(others, 1);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
