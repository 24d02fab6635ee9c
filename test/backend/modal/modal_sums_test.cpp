// Whatever a method learns of a state on a grid, it learns of all of it, also where this process holds a part alone.
#include <test/support/cases.hpp>

#include <seiche/backend/grid/grid_potential.hpp>
#include <seiche/backend/modal/modal.hpp>
#include <seiche/backend/modal/modal_linear.hpp>
#include <seiche/backend/modal/modal_phi.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace seiche::test {
namespace TEST_FILE {

// Another process holds the same numbers once more.
class HeldTwice final : public Space {
 public:
  explicit HeldTwice(const Space& here) : here_(here) {}
  Index size() const override { return here_.size(); }
  Index physical_size() const override { return here_.physical_size(); }
  void to_physical(const Vector& z, Vector& values) const override { here_.to_physical(z, values); }
  void from_physical(const Vector& values, Vector& z) const override { here_.from_physical(values, z); }
  using Space::sum;
  void sum(std::span<double> local) const override {
    for (double& x : local) x *= 2;
  }
  Field slots() const override { return here_.slots(); }
  Field values() const override { return here_.values(); }
  void add_units(const Units& units, std::span<const double> sums, std::span<double> totals) const override {
    Space::add_units(units, sums, totals);
    sum(totals);
  }

 private:
  const Space& here_;
};

// Of the magnitude of V: FFTW may plan another order of additions for a second transform of the same grid.
constexpr double rounding = 1e-13;

std::vector<Problem> problems() {
  std::vector<Problem> all = {klein_gordon_case(), gkdv_case()};
  for (NamedProblem& grid : grid_cases()) all.push_back(std::move(grid.problem));
  return all;
}

// Every field gets a part of the next one, so that no energy of a string at rest or without speed is zero.
Vector mixed(const Problem& problem, const Vector& z) {
  const Index field = problem.grid.unknowns();
  Vector shifted(z.size());
  std::rotate_copy(z.begin(), z.begin() + field % z.size(), z.end(), shifted.begin());
  return z + 0.5 * shifted;
}

TEST(ModalSums, EnergiesAndPowersAreThoseOfAllParts) {
  for (const Problem& problem : problems()) {
    const System system = modal_system(problem, {});
    const HeldTwice twice(*system.space);
    const std::unique_ptr<LinearPart> linear = modal_linear_part(problem, twice, 1);
    const Vector z = mixed(problem, system.initial);
    EXPECT_NE(system.linear->quadratic_energy(z), 0) << problem.name;
    EXPECT_EQ(linear->quadratic_energy(z), 2 * system.linear->quadratic_energy(z)) << problem.name;
    EXPECT_EQ(linear->quadratic_magnitude(z), 2 * system.linear->quadratic_magnitude(z)) << problem.name;
    EXPECT_EQ(linear->quadratic(z).value, 2 * system.linear->quadratic(z).value) << problem.name;

    Vector gradient = Vector::Zero(z.size());
    system.potential->gradient(z, gradient);
    const std::unique_ptr<Propagator> all = linear->propagator(PropagatorKind::exponential, 0.1);
    const std::unique_ptr<Propagator> part = system.linear->propagator(PropagatorKind::exponential, 0.1);
    const Propagator::Powers expected = part->powers(z, gradient), found = all->powers(z, gradient);
    EXPECT_NE(expected.of_force, 0) << problem.name;
    EXPECT_EQ(found.of_increment, 2 * expected.of_increment) << problem.name;
    EXPECT_EQ(found.of_force, 2 * expected.of_force) << problem.name;
    EXPECT_EQ(found.quadratic_energy, 2 * expected.quadratic_energy) << problem.name;

    Vector z_mid = z;
    const Vector other = 0.5 * gradient, zero = Vector::Zero(z.size());
    const Propagator::Gradients gradients{.g0 = gradient, .g1 = other, .g2 = zero, .weight = 0.5, .ratio = 1};
    Propagator::Recalled one, both;
    if (!part->recall(z, gradients, z_mid, {}, one)) continue;
    ASSERT_TRUE(all->recall(z, gradients, z_mid, {}, both));
    EXPECT_EQ(both.missed, 2 * one.missed) << problem.name;
    EXPECT_EQ(both.moved, 2 * one.moved) << problem.name;
  }
}

TEST(ModalSums, ValuesOfThePotentialAreThoseOfAllParts) {
  for (const Problem& problem : problems()) {
    const System system = modal_system(problem, {});
    const HeldTwice twice(*system.space);
    const GridPotential all(problem.potential, problem.potential_field, modal_transform(problem.grid, {}), twice);
    const Potential& part = *system.potential;
    const Vector z = mixed(problem, system.initial);
    Vector gradient = Vector::Zero(z.size()), same = gradient;
    EXPECT_NE(part.value(z), 0) << problem.name;
    const auto expect_twice = [&](double both, double one) {
      EXPECT_NEAR(both, 2 * one, rounding * part.magnitude(z)) << problem.name;
    };
    expect_twice(all.value(z), part.value(z));
    expect_twice(all.magnitude(z), part.magnitude(z));
    expect_twice(all.value_and_magnitude(z).value, part.value_and_magnitude(z).value);
    expect_twice(all.value_and_gradient(z, same), part.value_and_gradient(z, gradient));
    EXPECT_LE((same - gradient).norm(), 1e-14 * gradient.norm())
        << problem.name << ": a gradient is of this part alone";
    const auto count = static_cast<std::size_t>(part.degree()) + 1;
    std::vector<double> along(count), along_all(count), ray(count), ray_all(count);
    part.along(z, 0.5 * z, along);
    all.along(z, 0.5 * z, along_all);
    part.along_ray(z, ray);
    all.along_ray(z, ray_all);
    for (std::size_t i = 0; i < count; ++i) {
      expect_twice(along_all[i], along[i]);
      expect_twice(ray_all[i], ray[i]);
    }
  }
}

TEST(ModalSums, WhatDampingTakesIsThatOfAllParts) {
  const Problem problem = klein_gordon_case();
  const System system = modal_system(problem, {});
  const HeldTwice twice(*system.space);
  const ModalOperators operators{
      .grid = problem.grid, .S = problem.S, .M = problem.M, .D0 = constant_damping(problem), .first = 0, .count = 1};
  const PhiEvaluator::Form form{.rows = {.rows = {{.theta = 0.5}, {.theta = 1.0}}}, .coefficients = {0.3, 0.7}};
  double part = 0, all = 0;
  modal_phi(operators, *system.space)->forms({&form, 1}, 0.1)->apply(system.initial, {}, {&part, 1});
  modal_phi(operators, twice)->forms({&form, 1}, 0.1)->apply(system.initial, {}, {&all, 1});
  EXPECT_NE(part, 0);
  EXPECT_EQ(all, 2 * part);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
