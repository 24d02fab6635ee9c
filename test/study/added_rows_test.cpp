// One row is all it takes: a method, a problem and a backend of this test's own are found wherever those of the lists
// are.
#include <test/support/cases.hpp>
#include <test/support/convergence.hpp>
#include <test/support/error_of.hpp>

#include <seiche/backend/dense/dense.hpp>
#include <seiche/config/case/case_file.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/common/second_order.hpp>
#include <seiche/problem/common/wave.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/study/lists.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace seiche::test {
namespace {

MethodEntry own_method() {
  MethodEntry row = find_method("seavf");
  row.name = "own_method";
  return row;
}

Vector state_after(const Problem& problem, const SimulationOptions& options, double h, int steps) {
  Simulation simulation(problem, options);
  for (int n = 0; n < steps; ++n) EXPECT_TRUE(simulation.step(h).solved());
  return simulation.physical();
}

TEST(AddedRows, AMethodHasItsOrderItsLawAndItsAgreement) {
  const AddedMethod added(own_method());
  const Problem problem = klein_gordon_case();
  const Vector exact = state_after(problem, {.method = "egc8"}, 1.0 / 64, 64);
  std::vector<double> sizes, errors;
  for (const int n : {16, 32, 64}) {
    sizes.push_back(1.0 / n);
    errors.push_back((state_after(problem, {.method = "own_method"}, 1.0 / n, n) - exact).norm());
  }
  EXPECT_NEAR(fitted_order(sizes, errors), 2.0, 0.1);

  Simulation simulation(problem, {.method = "own_method"});
  double H = simulation.energy().H;
  for (int n = 0; n < 100; ++n) {
    ASSERT_TRUE(simulation.step(0.5).solved());
    EXPECT_LE(simulation.energy().H, H + simulation.energy().round_off);
    H = simulation.energy().H;
  }
  const Vector expected = state_after(problem, {.method = "own_method", .backend = "reference"}, 1.0 / 64, 64);
  for (const BackendEntry& backend : backends_for(problem)) {
    const SimulationOptions options{.method = "own_method", .backend = std::string(backend.name)};
    EXPECT_LE((state_after(problem, options, 1.0 / 64, 64) - expected).norm(), 1e-12) << backend.name;
  }
}

TEST(AddedRows, AMethodIsListedTakenByCasesAndSuggested) {
  const std::size_t before = methods().size();
  {
    const AddedMethod added(own_method());
    EXPECT_NE(methods_json().find("own_method"), std::string::npos);
    const char* text = "[problem]\nname = \"oscillator\"\n[method]\nname = \"own_method\"\n[time]\nend = 1.0\n";
    EXPECT_EQ(parse_case(text, "a.toml").method, "own_method");
    EXPECT_NE(error_of([] { find_method("own_methd"); }).find("own_method"), std::string::npos);
    EXPECT_NE(error_of([] { const AddedMethod again(own_method()); }).find("in the list already"), std::string::npos);
  }
  EXPECT_EQ(methods().size(), before);
  EXPECT_NE(error_of([] { find_method("own_method"); }), "");
}

struct Pendulums {
  Index points = 3;
  double weight = 2.0;
  DampingRate gamma = nullptr;
};

Problem pendulums(const Pendulums& options) {
  Problem p = wave_problem("pendulums", points_without_place(options.points), Stencil::identity(0.0), options.gamma);
  p.potential = nodal_polynomial({0, 0, options.weight / 2, 0, -options.weight / 24});
  p.initial.setConstant(0.5);
  return p;
}

TEST(AddedRows, AProblemIsReadFromCasesWithEachParameterNamedOnce) {
  using P = Pendulums;
  const AddedProblem added(ProblemRows<P>({.name = "pendulums",
                                           .equation = "q̈ + γq̇ + w(q − q³/6) = 0",
                                           .reference = "this test",
                                           .fields = {"u", "v"},
                                           .default_h = "1/64",
                                           .default_end = 2.0},
                                          pendulums)
                               .row(&P::points, {.name = "points", .meaning = "how many", .minimum = 1, .maximum = 9})
                               .row(&P::weight, {.name = "weight", .meaning = "w", .minimum = 0})
                               .row(&P::gamma, {.name = "gamma", .default_value = "0.1", .meaning = "γ"})
                               .preset("lifted"));
  EXPECT_NE(example_case("pendulums").find("weight = 2.0"), std::string::npos);
  const auto read = [](const std::string& more) {
    return make_problem(parse_case("[problem]\nname = \"pendulums\"\n" + more, "a.toml"));
  };
  EXPECT_EQ(read("").size(), 6);
  EXPECT_EQ(read("points = 5\n").size(), 10);
  EXPECT_NE(error_of([&] { read("wieght = 1.0\n"); }).find("weight"), std::string::npos);
  EXPECT_NE(error_of([&] { read("weight = -1.0\n"); }).find("-1"), std::string::npos);
  for (const char* method : {"seisav", "egc4", "crkn4"}) {
    Simulation simulation(read(""), {.method = method});
    const double H = simulation.energy().H;
    for (int n = 0; n < 64; ++n) ASSERT_TRUE(simulation.step(1.0 / 16).solved());
    EXPECT_LT(simulation.energy().H, H) << method;
  }
}

TEST(AddedRows, ABackendRunsEveryMethodAndIsListed) {
  const AddedBackend added({.name = "own_backend", .summary = "dense by another name", .system = dense_system});
  EXPECT_NE(backends_json().find("own_backend"), std::string::npos);
  const Problem problem = duffing_case();
  for (const MethodEntry& method : methods()) {
    const SimulationOptions own{.method = std::string(method.name), .backend = "own_backend"};
    const SimulationOptions dense{.method = std::string(method.name), .backend = "dense"};
    EXPECT_EQ((state_after(problem, own, 1.0 / 16, 16) - state_after(problem, dense, 1.0 / 16, 16)).norm(), 0)
        << method.name;
  }
}

}  // namespace
}  // namespace seiche::test
