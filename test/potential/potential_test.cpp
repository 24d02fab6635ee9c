// The contracts of potentials, pointwise and in the coordinates of every backend.
#include <test/support/cases.hpp>
#include <test/support/plain_space.hpp>
#include <test/support/thread_ranks.hpp>

#include <seiche/backend/backends.hpp>
#include <seiche/backend/grid/grid_potential.hpp>
#include <seiche/backend/grid/halo_potential.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/numerics/gauss_rule.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/potential/bars.hpp>
#include <seiche/potential/bond.hpp>
#include <seiche/potential/cosine.hpp>
#include <seiche/potential/formula_potential.hpp>
#include <seiche/potential/modulus.hpp>
#include <seiche/potential/nodal.hpp>
#include <seiche/potential/on_bonds.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/potential/sum.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace seiche::test {
namespace TEST_FILE {

std::span<const double> span_of(const Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }
std::span<double> span_of(Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

std::vector<NamedProblem> problems_with_every_kind_of_potential() {
  std::vector<NamedProblem> list = all_cases();
  Problem p = klein_gordon_case();
  p.potential = nodal_polynomial({0.5, -0.3, 0.2, 0.7, -0.1, 0.05, 0.02});
  list.push_back({"nodal_degree_6", p});
  p.potential = bond_polynomial({0, 0, 1.0, 0.3, 0.2}, Boundary::periodic);
  list.push_back({"bond_periodic", p});
  p.potential = sum_of({{p.potential, 0}, {nodal_polynomial({0, 0, 0, 0.1, 0.3}), 0}}, 1);
  list.push_back({"bonds_and_ground", p});
  p.potential = std::make_shared<NodalPotential<Cosine>>(Cosine{});
  list.push_back({"nodal_cosine", p});
  return list;
}

template <class Check>
void for_every_potential(const Check& check) {
  std::srand(7);
  for (const auto& [name, problem] : problems_with_every_kind_of_potential()) {
    for (const BackendEntry& backend : backends_for(problem)) {
      SCOPED_TRACE(name + " " + std::string(backend.name));
      const System system = backend.system(problem, {});
      const auto random = [&system] {
        Vector z(system.space->size());
        system.space->from_physical(0.3 * Vector::Random(system.space->physical_size()), z);
        return z;
      };
      check(*system.potential, random(), random());
    }
  }
}

// Chains with all ends, bars in one field and in two, bonds beside a ground; on more processes than points, too.
std::vector<std::shared_ptr<const PointwisePotential>> potentials_that_join_points() {
  using Bars = BarPotential<Polynomial<4>>;
  const auto bars = std::make_shared<const Bars>(
      Polynomial<4>{.c = {0, 0, 0.5, 0.3, 0.2}},
      std::vector<Bar>{{-1, 0, 1, 0}, {0, 1, 0.6, 0.8}, {1, 4, 0, 1}, {4, 2, 0.8, -0.6}, {3, 0, 1, 0}, {2, -1, 0, 1}});
  std::vector<std::shared_ptr<const PointwisePotential>> all = {bars};
  for (const Boundary boundary : {Boundary::periodic, Boundary::dirichlet, Boundary::neumann}) {
    all.push_back(bond_polynomial({0, 0, 1.0, 0.3, 0.2}, boundary));
    all.push_back(on_bonds(std::make_shared<NodalPotential<Cosine>>(Cosine{}), boundary));
    all.push_back(sum_of({{all.back(), 1}, {nodal_polynomial({0, 0, 0, 0.1, 0.3}), 0}, {bars, 0}}, 2));
  }
  return all;
}

TEST(Potential, OfSeveralProcessesIsThatOfOne) {
  constexpr Index points = 5;
  for (const auto& V : potentials_that_join_points()) {
    const Index fields = V->fields();
    const Vector u = 0.5 * Vector::Random(fields * points), w = 0.5 * Vector::Random(fields * points);
    Vector gradient(u.size()), mean(u.size());
    const double value = V->value_and_gradient(span_of(u), span_of(gradient));
    V->mean_gradient(span_of(u), span_of(w), span_of(mean));
    std::vector<double> coefficients(static_cast<std::size_t>(V->degree()) + 1);
    if (V->degree() > 0) V->along(span_of(u), span_of(w), coefficients);
    const Vector taylor = Vector::Map(coefficients.data(), std::ssize(coefficients));
    for (const int count : {1, 2, 3, 7}) {
      on_ranks(count, [&](const Ranks& ranks) {
        const Index first = points * ranks.here().index / count, end = points * (ranks.here().index + 1) / count;
        const FieldPart part{.size = end - first, .units = {}, .first = first, .of = points};
        const auto here = [&](const Vector& whole) {
          Vector mine(fields * part.size);
          for (Index f = 0; f < fields; ++f)
            mine.segment(f * part.size, part.size) = whole.segment(f * points + first, part.size);
          return mine;
        };
        const auto halo = halo_potential(*V, part, ranks);
        ASSERT_TRUE(halo);
        const Vector mine = here(u), others = here(w);
        Vector found(mine.size());
        std::vector<double> sums = {halo->value_and_gradient(span_of(mine), span_of(found)), halo->value(span_of(mine)),
                                    halo->value_and_magnitude(span_of(mine)).value,
                                    halo->magnitude(span_of(mine)) - V->magnitude(span_of(u)) / count};
        EXPECT_LE((found - here(gradient)).lpNorm<1>(), 1e-14) << count;
        halo->mean_gradient(span_of(mine), span_of(others), span_of(found));
        EXPECT_LE((found - here(mean)).lpNorm<1>(), 1e-14) << count;
        std::vector<double> along(coefficients.size());
        if (V->degree() > 0) halo->along(span_of(mine), span_of(others), along);
        sums.insert(sums.end(), along.begin(), along.end());
        ranks.sum(sums);
        for (const double found_value : {sums[0], sums[1], sums[2]}) EXPECT_NEAR(found_value, value, 1e-14) << count;
        EXPECT_NEAR(sums[3], 0, 1e-14) << count;
        EXPECT_LE((Vector::Map(sums.data() + 4, taylor.size()) - taylor).lpNorm<1>(), 1e-13) << count;
      });
    }
  }
}

TEST(Potential, GradientIsTheGradientOfTheValue) {
  for_every_potential([](const Potential& V, const Vector& z, const Vector& direction) {
    Vector g = Vector::Zero(z.size());
    EXPECT_NEAR(V.value_and_gradient(z, g), V.value(z), 1e-14 * (1 + V.magnitude(z)));
    const double s = 1e-5;
    const double slope = (V.value(z + s * direction) - V.value(z - s * direction)) / (2 * s);
    EXPECT_NEAR(g.dot(direction), slope, 1e-6 * (1 + std::abs(slope)));
  });
}

TEST(Potential, TheMagnitudeSumsTheSizesOfTheTerms) {
  const auto V = nodal_polynomial({0, 1});  // V = Σu_j
  std::vector<double> u;
  for (int j = 0; j < 19; ++j) u.push_back(j % 3 == 0 ? -1.0 : 0.5);
  const ValueAndMagnitude v = V->value_and_magnitude(u);
  EXPECT_DOUBLE_EQ(v.value, -1.0);
  EXPECT_DOUBLE_EQ(v.magnitude, 13.0);
}

// Where terms cancel, V is no measure of what round-off makes of it; nor is it where a small change of u changes V by
// much.
TEST(Potential, TheMagnitudeIsThatOfTermsThatCancelAndOfSteepPlaces) {
  const std::vector<double> one = {1, 0};
  const ModulusPotential<Polynomial<3>> modulus(Polynomial<3>{{0, 0, -1, 1}});
  EXPECT_EQ(modulus.value(one), 0);
  EXPECT_EQ(modulus.magnitude(one), 2);
  EXPECT_EQ(bond_polynomial({0, 0, 0, -1, 1}, Boundary::dirichlet)->magnitude(std::vector{1.0}), 2 + 2);
  const std::vector<double> far = {1000};
  const auto W = compile_formula("cos(u)", {"u"});
  const auto formula = formula_potential({.value = W, .gradient = {differentiate(*W, "u")}},
                                         Grid{.axes = {{1, 1.0, Boundary::periodic}}});
  EXPECT_NEAR(formula->magnitude(far), std::abs(std::cos(1000.0)) + 1000 * std::abs(std::sin(1000.0)), 1e-9);
  const double s = std::sin(500.0);
  EXPECT_NEAR(NodalPotential<Cosine>(Cosine{}).magnitude(far), 2 * s * s + 1000 * std::abs(std::sin(1000.0)), 1e-9);
}

TEST(Potential, ValueAndMagnitudeTogetherAreThoseApart) {
  for_every_potential([](const Potential& V, const Vector& z, const Vector&) {
    const ValueAndMagnitude v = V.value_and_magnitude(z);
    EXPECT_NEAR(v.value, V.value(z), 1e-14 * (1 + v.magnitude));
    EXPECT_NEAR(v.magnitude, V.magnitude(z), 1e-14 * (1 + v.magnitude));
    EXPECT_LE(std::abs(v.value), v.magnitude * (1 + 1e-14));
  });
}

class CountingTransform final : public FieldTransform {
 public:
  explicit CountingTransform(Index n) : n_(n) {}
  Index unknowns() const override { return n_; }
  Index slots() const override { return n_; }
  void to_slots(std::span<const double> values, std::span<double> slots) const override {
    std::copy(values.begin(), values.end(), slots.begin());
  }
  void to_values(std::span<double> slots, std::span<double> values) const override {
    ++count;
    std::copy(slots.begin(), slots.end(), values.begin());
  }
  std::span<const double> through_values(std::span<const double> from, std::span<double> slots,
                                         const Pointwise& f) const override {
    std::copy(from.begin(), from.end(), slots.begin());
    sum_ = f(slots);
    return {&sum_, 1};
  }

  mutable int count = 0;

 private:
  Index n_;
  mutable double sum_ = 0;
};

TEST(Potential, TheMagnitudeBesideTheValueTakesNoFurtherTransform) {
  const auto transform = std::make_shared<CountingTransform>(5);
  const PlainSpace space(transform->unknowns());
  const GridPotential V(nodal_polynomial({0, 1}), 0, transform, space);
  EXPECT_DOUBLE_EQ(V.value_and_magnitude(Vector::Constant(5, -2.0)).magnitude, 10.0);
  EXPECT_EQ(transform->count, 1);
}

TEST(Potential, MeanGradientTimesTheIncrementIsTheDifferenceOfValues) {
  for_every_potential([](const Potential& V, const Vector& a, const Vector& b) {
    Vector mean = Vector::Zero(a.size());
    V.mean_gradient(a, b, mean);
    EXPECT_NEAR(mean.dot(b - a), V.value(b) - V.value(a), 1e-13 * (1 + V.magnitude(a) + V.magnitude(b)));
  });
}

TEST(Potential, MeanGradientBetweenNeighboursLosesNoDigits) {
  for_every_potential([](const Potential& V, const Vector& a, const Vector& b) {
    const Vector near = a + 1e-9 * b;
    Vector mean = Vector::Zero(a.size());
    Vector middle = Vector::Zero(a.size());
    V.mean_gradient(a, near, mean);
    V.gradient(0.5 * (a + near), middle);
    EXPECT_LE((mean - middle).norm(), 1e-13 * (1 + middle.norm()));
  });
}

TEST(Potential, CoefficientsAlongALineGiveItsValues) {
  for_every_potential([](const Potential& V, const Vector& p, const Vector& q) {
    if (V.degree() == 0) return;
    std::vector<double> c(static_cast<std::size_t>(V.degree()) + 1);
    V.along(p, q, c);
    for (const double x : {-1.0, 0.0, 0.4, 2.0}) {
      double sum = 0;
      for (std::size_t i = c.size(); i-- > 0;) sum = sum * x + c[i];
      EXPECT_NEAR(sum, V.value(p + x * q), 1e-12 * (1 + V.magnitude(p + x * q)));
    }
  });
}

// Round-off of equal terms has one sign, and adds up in plain sums: to n/16 ε with eight sums side by side.
TEST(Potential, SumsOfEqualTermsKeepTheirDigits) {
  constexpr std::size_t n = 1 << 20;
  const auto field = [](Index m) { return Grid{.axes = {{m, 1.0, Boundary::periodic}}}; };
  const auto modulus = std::make_shared<ModulusPotential<Polynomial<2>>>(Polynomial<2>{{0, 0, 0.3}});
  const auto W = compile_formula("u^4/4 - cos(u)", {"u"});
  const auto formula = formula_potential({.value = W, .gradient = {differentiate(*W, "u")}}, field(n));
  for (const std::shared_ptr<const PointwisePotential>& V :
       {nodal_polynomial({0, 0, 0.1, 0.2, 0.3}), nodal_polynomial({0, 0, 0, 0, 0, 0, 0.7}),
        std::shared_ptr<const PointwisePotential>(std::make_shared<NodalPotential<Cosine>>(Cosine{})),
        std::shared_ptr<const PointwisePotential>(modulus), formula,
        sum_of({{bond_polynomial({0, 0, 0.5, 0, 0.2}, Boundary::periodic), 0},
                {nodal_polynomial({0, 0, 0, 0, 0.3}), 0}},
               1)}) {
    const std::vector<double> one(static_cast<std::size_t>(V->fields()), 0.7);
    const std::vector<double> all(one.size() * n, 0.7), origin(all.size(), 0.0);
    const double of_one = V->value(one);
    const auto is_sum = [&](double value, double term) {
      EXPECT_NEAR(value / (n * term), 1, 20 * epsilon) << V->fields() << " " << V->degree();
    };
    is_sum(V->value(all), of_one);
    is_sum(V->value_and_magnitude(all).value, of_one);
    is_sum(V->value_and_magnitude(all).magnitude, V->magnitude(one));
    std::vector<double> gradient(all.size());
    is_sum(V->value_and_gradient(all, gradient), of_one);
    gradient = all;
    is_sum(V->value_and_gradient_in_place(1, 1, gradient), of_one);
    if (V->degree() == 0) continue;
    std::vector<double> along(static_cast<std::size_t>(V->degree()) + 1), along_one(along.size());
    V->along(origin, all, along);
    V->along(std::vector<double>(one.size(), 0.0), one, along_one);
    is_sum(along.back(), along_one.back());
  }
}

// Phases of all sizes, more of them than a block of points has.
std::vector<double> phases() {
  std::vector<double> u;
  for (int i = 0; i < 1500; ++i) u.push_back((i % 2 == 0 ? 1 : -1) * std::pow(10.0, -12 + 15.0 * i / 1500));
  u.push_back(0);
  return u;
}

TEST(Potential, CosinesByVectorFunctionsAreThoseOfThePointFormula) {
  const Cosine w{1.3};
  const NodalPotential<Cosine> V(w);
  const std::vector<double> u = phases();
  std::vector<double> slopes(u.size());
  for (const double& x : u) EXPECT_NEAR(V.value({&x, 1}), w.value(x), 6 * epsilon * w.value(x)) << x;
  V.gradient(u, slopes);
  for (std::size_t j = 0; j < u.size(); ++j)
    EXPECT_NEAR(slopes[j], w.slope(u[j]), 4 * epsilon * std::abs(w.slope(u[j])) + epsilon * w.alpha * 1e-3) << u[j];
}

// (b − a)·mean slope is W(b) − W(a) to the last digits of the difference, however near b is to a: that of two values
// would have none of them. W(b) − W(a) = 2α sin((a + b)/2) sin((b − a)/2), here in long double.
TEST(Potential, MeanSlopesOfCosinesKeepTheirDigitsHoweverNearTheEnds) {
  const Cosine w{0.7};
  const NodalPotential<Cosine> V(w);
  const std::vector<double> a = phases();
  for (const double distance : {1e-15, 1e-9, 1e-5, 1e-4, 2e-4, 1e-2, 1.0, 7.0}) {
    std::vector<double> b(a.size()), mean(a.size());
    for (std::size_t j = 0; j < a.size(); ++j) b[j] = a[j] + distance;
    V.mean_gradient(a, b, mean);
    for (std::size_t j = 0; j < a.size(); ++j) {
      const long double d = (static_cast<long double>(b[j]) - a[j]) / 2;
      const long double middle = a[j] + d;
      const long double sinc = d == 0 ? 1 : std::sin(d) / d;
      const auto exact = static_cast<double>(w.alpha * std::sin(middle) * sinc);
      const double of_argument = 2 * epsilon * w.alpha * std::abs(static_cast<double>(middle));
      ASSERT_NEAR(mean[j], exact, 6 * epsilon * std::abs(exact) + of_argument) << a[j] << " + " << distance;
      ASSERT_NEAR(mean[j], w.mean_slope(a[j], b[j]), 4 * epsilon * std::abs(exact) + of_argument);
    }
  }
}

TEST(Potential, OnlyTheSupportOfAGradientIsWritten) {
  for_every_potential([](const Potential& V, const Vector& z, const Vector&) {
    Vector g = Vector::Constant(z.size(), 7.0);
    V.gradient(z, g);
    const Potential::Support s = V.support();
    EXPECT_TRUE((g.head(s.begin).array() == 7.0).all());
    EXPECT_TRUE((g.tail(g.size() - s.begin - s.size).array() == 7.0).all());
  });
}

TEST(Potential, AGradientInThePlaceOfItsArgumentIsTheSame) {
  for_every_potential([](const Potential& V, const Vector& z, const Vector&) {
    Vector g = Vector::Zero(z.size());
    const double v = V.value_and_gradient(z, g);
    Vector in_place = z;
    EXPECT_DOUBLE_EQ(V.value_and_gradient(in_place, in_place), v);
    const Potential::Support s = V.support();
    EXPECT_EQ(in_place.segment(s.begin, s.size), g.segment(s.begin, s.size));
  });
}

// On lines of every length beside the eight points that are taken at a time; W'(0) ≠ 0 pulls at free ends too.
TEST(Potential, OfBondsIsTheSumOverBondsOnLinesOfAnyLength) {
  const Polynomial<3> w{{0.1, 0.3, 0.5, 0.2}};
  const FormulaPointer W = compile_formula("0.1 + 0.3*d + 0.5*d^2 + 0.2*d^3", {"d"});
  for (const Boundary boundary : {Boundary::periodic, Boundary::dirichlet, Boundary::neumann}) {
    const auto V = std::make_shared<BondPotential<Polynomial<3>>>(w, boundary);
    for (std::size_t n = 1; n <= 27; ++n) {
      SCOPED_TRACE(fmt::format("{} points, boundary {}", n, static_cast<int>(boundary)));
      std::vector<double> u(n), b(n), gradient(n), mean(n), expected(n), expected_mean(n);
      for (std::size_t j = 0; j < n; ++j) u[j] = std::sin(1.7 * static_cast<double>(j + 1)), b[j] = 0.5 * u[j] + 0.1;
      double sum = 0;
      const auto bond = [&](std::size_t left, std::size_t right) {  // n: a wall
        const auto stretch = [&](const std::vector<double>& z) {
          return (right == n ? 0 : z[right]) - (left == n ? 0 : z[left]);
        };
        sum += w.value(stretch(u));
        const double pull = w.slope(stretch(u)), mean_pull = w.mean_slope(stretch(u), stretch(b));
        if (left < n) expected[left] -= pull, expected_mean[left] -= mean_pull;
        if (right < n) expected[right] += pull, expected_mean[right] += mean_pull;
      };
      for (std::size_t j = 0; j + 1 < n; ++j) bond(j, j + 1);
      if (boundary == Boundary::periodic) bond(n - 1, 0);
      if (boundary == Boundary::dirichlet) bond(n, 0), bond(n - 1, n);
      const double noise = 1e-14 * static_cast<double>(n + 1);
      const auto is_expected = [&](const std::vector<double>& given, const std::vector<double>& wanted, double factor) {
        for (std::size_t j = 0; j < n; ++j) EXPECT_NEAR(given[j], factor * wanted[j], 1e-13) << j;
      };
      const GridAxis axis{static_cast<Index>(n), 1.0, Boundary::periodic};
      const auto by_formula =
          on_bonds(formula_potential({.value = W, .gradient = {differentiate(*W, "d")}}, Grid{.axes = {axis}}),
                   boundary);
      for (const std::shared_ptr<const PointwisePotential>& each :
           {std::shared_ptr<const PointwisePotential>(V), by_formula}) {
        EXPECT_NEAR(each->value(u), sum, noise);
        EXPECT_NEAR(each->value_and_magnitude(u).value, sum, noise);
        EXPECT_NEAR(each->value_and_gradient(u, gradient), sum, noise);
        is_expected(gradient, expected, 1);
        each->mean_gradient(u, b, mean);
        is_expected(mean, expected_mean, 1);
      }
      for (std::size_t j = 0; j < n; ++j) gradient[j] = u[j] / 2;
      EXPECT_NEAR(V->value_and_gradient_in_place(2, 3, gradient), sum, noise);
      is_expected(gradient, expected, 3);
    }
  }
}

TEST(Potential, GrowsOutwardOnlyForEvenPowersWithPositiveCoefficients) {
  EXPECT_TRUE(nodal_polynomial({0, 0, 1, 0, 2})->grows_outward());
  EXPECT_FALSE(nodal_polynomial({0, 0, 1, 1e-3, 2})->grows_outward());
  EXPECT_FALSE(nodal_polynomial({0, 0, 1, 0, -2})->grows_outward());
}

// Degree 7 is computed as degree 8 with a zero, and so on.
TEST(Potential, EveryDegreeIsToldAsItIsAndComputedByItsCoefficients) {
  const std::vector<double> u = {0.3, -0.7, 1.1, 0.4, -0.2, 0.9, -1.2, 0.05, 0.6, -0.4};
  std::vector<double> way(u.size(), 0.0);
  for (std::size_t j = 0; j < u.size(); ++j) way[j] = 0.1 * static_cast<double>(j) - 0.3;
  for (int degree = 1; degree <= max_polynomial_degree; ++degree) {
    std::vector<double> c;
    for (int i = 0; i <= degree; ++i) c.push_back(0.75 - 0.1 * i);
    const auto V = nodal_polynomial(c);
    ASSERT_EQ(V->degree(), degree);
    ASSERT_EQ(modulus_polynomial(c)->degree(), 2 * degree);
    const auto value = [&](double x) {
      double sum = 0;
      for (std::size_t j = 0; j < u.size(); ++j)
        for (int i = 0; i <= degree; ++i) sum += c[static_cast<std::size_t>(i)] * std::pow(u[j] + x * way[j], i);
      return sum;
    };
    EXPECT_NEAR(V->value(u), value(0), 1e-12 * V->magnitude(u)) << degree;
    std::vector<double> there(u.size()), gradient(u.size()), mean(u.size()), in_place = u;
    for (std::size_t j = 0; j < u.size(); ++j) there[j] = u[j] + 0.5 * way[j];
    V->gradient(u, gradient);
    V->mean_gradient(u, there, mean);
    V->value_and_gradient_in_place(1, 1, in_place);
    for (std::size_t j = 0; j < u.size(); ++j) {
      double slope = 0, mean_slope = 0;  // Σ i c_i uⁱ⁻¹, and that by Gauss's rule
      for (int i = 1; i <= degree; ++i) {
        const double factor = i * c[static_cast<std::size_t>(i)];
        slope += factor * std::pow(u[j], i - 1);
        for (const GaussNode& node : gauss_rule(9))
          mean_slope += node.weight * factor * std::pow(u[j] + node.place * (there[j] - u[j]), i - 1);
      }
      EXPECT_NEAR(gradient[j], slope, 1e-11) << degree;
      EXPECT_NEAR(in_place[j], slope, 1e-11) << degree;
      EXPECT_NEAR(mean[j], mean_slope, 1e-11) << degree;
    }
    std::vector<double> taylor(static_cast<std::size_t>(degree) + 1);
    V->along(u, way, taylor);
    double along = 0;
    for (std::size_t k = taylor.size(); k-- > 0;) along = 0.5 * along + taylor[k];
    EXPECT_NEAR(along, value(0.5), 1e-12 * V->magnitude(u)) << degree;
    std::vector<double> of_modulus(2 * static_cast<std::size_t>(degree) + 1);
    const auto W = modulus_polynomial(c);
    W->along(u, way, of_modulus);
    double at_half = 0;
    for (std::size_t k = of_modulus.size(); k-- > 0;) at_half = 0.5 * at_half + of_modulus[k];
    EXPECT_NEAR(at_half, W->value(there), 1e-12 * (W->magnitude(u) + W->magnitude(there))) << degree;
  }
}

TEST(Potential, ADegreeThatIsTooHighIsRefused) {
  EXPECT_NO_THROW(nodal_polynomial(monomial(1, max_polynomial_degree)));
  EXPECT_THROW(nodal_polynomial(monomial(1, max_polynomial_degree + 1)), Error);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
