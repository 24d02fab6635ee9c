#include <seiche/core/numerics/spectral_radius.hpp>

#include <cmath>
#include <random>

namespace seiche {
namespace {

Vector random_state(const Space& space) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Vector values(space.physical_size());
  for (double& x : values) x = normal(random);
  Vector z(space.size());
  space.from_physical(values, z);
  return z;
}

}  // namespace

double spectral_radius(const Space& space, FunctionRef<void(Vector& z)> apply) {
  constexpr int iterations = 20;
  Vector z = random_state(space);
  double growth = 0;
  for (int k = 0; k < iterations; ++k) {
    const double before = z.norm();
    if (!(before > 0)) return 0;
    z /= before;
    apply(z);
    apply(z);
    growth = std::sqrt(z.norm());
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
