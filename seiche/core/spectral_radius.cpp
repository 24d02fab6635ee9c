#include <seiche/core/generic_state.hpp>
#include <seiche/core/spectral_radius.hpp>

#include <cmath>

namespace seiche {
double spectral_radius(const Space& space, FunctionRef<void(Vector& z)> apply) {
  constexpr int iterations = 20;
  std::mt19937_64 random(1);
  Vector z = random_state(space, random);
  double growth = 0;
  for (int k = 0; k < iterations; ++k) {
    const double before = space.norm(z);
    if (!(before > 0)) return 0;
    z /= before;
    apply(z);
    apply(z);
    growth = std::sqrt(space.norm(z));
  }
  return growth;
}

double rate_of_linear_flow(const System& system) {
  Vector Mz(system.space->size()), Dz(system.space->size());
  return spectral_radius(*system.space, [&](Vector& z) {
    system.damping->apply_D0(z, Dz);
    system.linear->apply_M(z, Mz);
    system.linear->apply_S(Mz, z);
    z -= Dz;
  });
}

}  // namespace seiche
