// A grid that several processes hold computes what one does, to the bit.
#include <test/support/cases.hpp>
#include <test/support/thread_ranks.hpp>

#include <seiche/backend/fft/transform.hpp>
#include <seiche/backend/modal/modal.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/grid/modes.hpp>
#include <seiche/core/truncated_potential.hpp>
#include <seiche/damping/frictions.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

Problem plane(Index points = 16) {
  return klein_gordon(
      {.grid = {.points = {points, points}, .length = {4.0, 4.0}}, .alpha = 1.0, .gamma = constant_rate(0.2)});
}

// The same equation on a grid of three times as many intervals and one.
NamedProblem larger(const NamedProblem& c) {
  NamedProblem larger = c;
  larger.name += "_larger";
  Problem& p = larger.problem;
  for (GridAxis& axis : p.grid.axes) axis.intervals = 3 * axis.intervals + 1;
  p.initial.resize(p.size());
  for (Index j = 0; j < p.size(); ++j) p.initial[j] = std::sin(1.3 * static_cast<double>(j + 1));
  return larger;
}

// S'(z)w of a plane, by a formula at every point, and by a derivative beside it.
class Turning final : public PointwiseStructure {
 public:
  void apply(std::span<const double> z, std::span<const double> w, Derivative derivative,
             std::span<double> out) const override {
    const std::size_t n = z.size() / 2;
    std::vector<double> product(n), of_product(n), of_w(n);
    for (std::size_t j = 0; j < n; ++j) product[j] = z[j] * w[j];
    derivative(product, 0, of_product);
    derivative(w.first(n), 0, of_w);
    for (std::size_t j = 0; j < n; ++j) {
      out[j] = 0.1 * (z[j] * of_w[j] + of_product[j]) + 0.3 * z[j] * w[n + j];
      out[n + j] = -0.3 * z[j] * w[j];
    }
  }
  bool keeps_means() const override { return false; }
  std::string text() const override { return "S'(z)"; }
};

// A plane with friction, one with an external force, and one with S(z).
std::vector<NamedProblem> driven_cases() {
  Problem dragged = plane(), pushed = plane(), turned = plane();
  dragged.friction = quadratic_friction(0.1, 0.5);
  pushed.forces.resize(2);
  pushed.forces[1] =
      formula_space_rate(compile_formula("0.3*cos(2*t)*sin(x)*y", {"t", "x", "y"}), 2, false)->on(pushed.grid);
  turned.structure = std::make_shared<Turning>();
  turned.derivatives = {Stencil::derivative(turned.grid, 0, Discretisation::fd2)};
  return {{"KG_2d_dragged", dragged}, {"KG_2d_pushed", pushed}, {"KG_2d_turned", turned}};
}

// Grids of two and three axes, with all ends, whose planes are cut evenly and not; more processes than units, too.
std::vector<NamedProblem> divisible_cases(std::string_view method) {
  std::vector<NamedProblem> cases;
  for (const NamedProblem& c : grid_cases()) {
    if (c.problem.grid.dimension() == 1 || !applies(method, c.problem)) continue;
    cases.push_back(c);
    const bool is_made_for_its_grid = dynamic_cast<const TruncatedPotential*>(c.problem.potential.get()) != nullptr;
    if (!is_made_for_its_grid) cases.push_back(larger(c));
  }
  for (const std::vector<NamedProblem>& more : {field_rate_cases(), driven_cases()})
    for (const NamedProblem& c : more)
      if (c.problem.grid.dimension() > 1 && applies(method, c.problem)) cases.push_back(c);
  return cases;
}

// Physical values of all parts where they belong.
void put(const Problem& part, const Vector& values, Vector& whole) {
  const Index mine = part.grid.unknowns(), all = part.grid.whole().unknowns(), first = part.grid.first_unknown();
  for (Index f = 0; f < part.field_count(); ++f) whole.segment(f * all + first, mine) = values.segment(f * mine, mine);
}

// What a run leaves: the last state, and H and the modified energy of every step.
struct Outcome {
  Vector values;
  std::vector<double> numbers;
  bool operator==(const Outcome&) const = default;
};

using Course = std::function<std::vector<double>(Simulation&)>;

Outcome on_processes(int count, const Problem& problem, const SimulationOptions& options, const Course& run) {
  Outcome outcome{.values = Vector::Zero(problem.size()), .numbers = {}};
  std::mutex mutex;
  on_ranks(count, [&](const Ranks& ranks) {
    SimulationOptions mine = options;
    mine.backend_options.ranks = &ranks;
    const Problem part = part_of(problem, ranks.here());
    Simulation simulation(part, mine);
    const std::vector<double> numbers = run(simulation);
    const Vector values = simulation.physical();
    const std::scoped_lock lock(mutex);
    put(part, values, outcome.values);
    if (ranks.here().index == 0) outcome.numbers = numbers;
  });
  return outcome;
}

std::vector<double> three_steps(Simulation& simulation) {
  std::vector<double> numbers;
  const auto read = [&] {
    const EnergyReading energy = simulation.energy();
    numbers.insert(numbers.end(), {energy.H, energy.modified, energy.round_off});
  };
  read();
  for (int n = 0; n < 3; ++n) {
    numbers.push_back(simulation.step(0.05).solved() ? 1.0 : 0.0);
    read();
  }
  return numbers;
}

class OnRanks : public testing::TestWithParam<std::string> {};

TEST_P(OnRanks, StatesAndEnergiesHaveTheBitsOfOneProcess) {
  for (const NamedProblem& c : divisible_cases(GetParam())) {
    const SimulationOptions options{.method = GetParam(), .backend = "modal"};
    Simulation alone(c.problem, options);
    const std::vector<double> numbers = three_steps(alone);
    const Outcome expected{.values = alone.physical(), .numbers = numbers};
    const bool is_small = c.problem.size() < 100;
    for (const int count : is_small ? std::vector{1, 2, 3, 4, 7} : std::vector{3, 7}) {
      const Outcome found = on_processes(count, c.problem, options, three_steps);
      EXPECT_EQ(found.numbers, expected.numbers) << c.name << " on " << count;
      EXPECT_EQ((found.values - expected.values).lpNorm<Eigen::Infinity>(), 0) << c.name << " on " << count;
    }
  }
}

// Processes that hold nothing know of one that holds several blocks: they would wait for another sum else.
TEST(OnRanks, OneUnitOfManyBlocksIsAddedUpTogether) {
  for (const Index points : {1024, 4096}) {
    const Problem problem = klein_gordon(
        {.grid = {.points = {points, 4}, .length = {0.1 * static_cast<double>(points), 0.4}}, .alpha = 1.0});
    for (const std::string method : {"seisav", "egc4"}) {
      const SimulationOptions options{.method = method, .backend = "modal"};
      Simulation alone(problem, options);
      const std::vector<double> numbers = three_steps(alone);
      const Outcome found = on_processes(3, problem, options, three_steps);
      EXPECT_EQ(found.numbers, numbers) << method << " " << points;
    }
  }
}

// Whatever is decided on the way, all processes decide it: else one of them would wait for others for ever.
TEST_P(OnRanks, StepsByToleranceHaveTheBitsOfOneProcess) {
  const Course run = [](Simulation& simulation) {
    const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                                {.tolerance = 1e-4, .t_end = 0.5});
    EXPECT_EQ(report.status, RunReport::Status::success) << report.message;
    return std::vector<double>{static_cast<double>(report.steps), static_cast<double>(report.rejected),
                               report.energy.final, report.energy.max_increase};
  };
  for (const NamedProblem& c : divisible_cases(GetParam())) {
    if (!c.name.starts_with("KG_2d")) continue;
    const SimulationOptions options{.method = GetParam(), .backend = "modal", .variable_steps = true};
    Simulation alone(c.problem, options);
    const std::vector<double> numbers = run(alone);
    const Outcome found = on_processes(3, c.problem, options, run);
    EXPECT_EQ(found.numbers, numbers) << c.name;
    EXPECT_EQ((found.values - alone.physical()).lpNorm<Eigen::Infinity>(), 0) << c.name;
  }
}

// Lines of a length that FFTW computes in another way where one stands alone, and one more of them than a block takes.
TEST(Ranks, TransformsHaveTheBitsOfOneProcess) {
  for (const std::vector<long>& points : {std::vector<long>{64, 32}, {48, 32}, {3, 64, 32}, {64, 5, 33}}) {
    const Problem problem = klein_gordon({.grid = {.points = points, .length = {4.0}}});
    const auto alone = modal_transform(problem.grid);
    Vector values(alone->unknowns()), slots(alone->slots());
    for (Index i = 0; i < values.size(); ++i) values[i] = std::sin(1.3 * static_cast<double>(i + 1));
    const auto span_of = [](auto& v) { return std::span(v.data(), static_cast<std::size_t>(v.size())); };
    alone->forward(span_of(values), span_of(slots));
    for (const int count : {2, 3, 5})
      on_ranks(count, [&](const Ranks& ranks) {
        const Grid grid = part_of(problem, ranks.here()).grid;
        const auto transform = modal_transform(grid, {.ranks = &ranks});
        const Modes modes(grid);
        Vector mine = values.segment(grid.first_unknown(), grid.unknowns());
        Vector found(transform->slots());
        transform->forward(span_of(mine), span_of(found));
        const Index first = modes.slab_of_rank(ranks.here().index).first * modes.plane();
        EXPECT_EQ(found, Vector(slots.segment(first, found.size()))) << points.front() << " on " << count;
      });
  }
}

// Where processes hold one unit, several, and none.
TEST(Ranks, LengthsAndProductsHaveTheBitsOfOneProcess) {
  for (const Index points : {8, 12, 16}) {
    const Problem problem = plane(points);
    const System alone = modal_system(problem);
    const Vector expected = alone.initial.array() + 0.1;
    const double of_values = alone.space->norm_of_values(alone.space->physical(expected));
    for (const int count : {2, 3, 4, 7}) {
      on_ranks(count, [&](const Ranks& ranks) {
        const System system = modal_system(part_of(problem, ranks.here()), {.ranks = &ranks});
        const Vector z = system.initial.array() + 0.1;
        const Space& space = *system.space;
        EXPECT_EQ(space.norm(z + z), alone.space->norm(expected + expected)) << points << " on " << count;
        EXPECT_EQ(space.squared_norm(z), alone.space->squared_norm(expected)) << points << " on " << count;
        EXPECT_EQ(space.dot(z, 0.7 * z), alone.space->dot(expected, 0.7 * expected)) << points << " on " << count;
        EXPECT_EQ(space.stable_norm(z), alone.space->stable_norm(expected)) << points << " on " << count;
        EXPECT_EQ(space.norm_of_values(space.physical(z)), of_values) << points << " on " << count;
      });
    }
  }
}

TEST(Ranks, PlansMayBeMeasuredWhereAProcessHoldsNothing) {
  on_ranks(7, [](const Ranks& ranks) {
    const Problem part = part_of(plane(4), ranks.here());
    const System system = modal_system(part, {.measure_plans = true, .ranks = &ranks});
    const Vector u = system.space->physical(system.initial);
    EXPECT_LE((u - part.initial).cwiseAbs().sum(), 1e-13);
  });
}

TEST(Ranks, RunOnTheModalBackendAlone) {
  on_ranks(2, [](const Ranks& ranks) {
    const Problem part = part_of(plane(4), ranks.here());
    const Simulation chosen(part, {.backend_options = {.ranks = &ranks}});
    EXPECT_EQ(chosen.backend().name, "modal") << "however few unknowns one of them holds";
    EXPECT_THROW(Simulation(part, {.backend = "dense", .backend_options = {.ranks = &ranks}}), Error);
  });
}

// Every process writes to every other one once for each transform, and no more than that: half of what it holds where
// there are two.
TEST(Ranks, ATransformIsOneExchange) {
  const Problem problem = plane();
  const std::int64_t modes = 16 * (16 / 2 + 1);
  for (const int count : {2, 3, 4}) {
    const auto transforms = [&](int how_many) {
      return traffic_on_ranks(count, [&](const Ranks& ranks) {
        const Problem part = part_of(problem, ranks.here());
        const auto transform = modal_transform(part.grid, {.ranks = &ranks});
        Vector values = part.initial.head(part.grid.unknowns()), slots(transform->slots());
        for (int i = 0; i < how_many; ++i) {
          transform->forward({values.data(), static_cast<std::size_t>(values.size())},
                             {slots.data(), static_cast<std::size_t>(slots.size())});
        }
      });
    };
    const Traffic one = transforms(1), two = transforms(2);
    EXPECT_EQ(two.messages - one.messages, count * (count - 1)) << count;
    EXPECT_EQ(two.reductions, 0);
    std::int64_t staying = 0;  // rows × modes of the process that holds both
    for (int rank = 0; rank < count; ++rank) {
      const Problem part = part_of(problem, {rank, count});
      staying += part.grid.slab().planes * Modes(part.grid).units().planes;
    }
    EXPECT_EQ(two.bytes - one.bytes, 16 * (modes - staying)) << count;
  }
}

TEST(Ranks, AStepOfSeisavTakesFewTransformsAndReductions) {
  const auto steps = [&](int how_many) {
    return traffic_on_ranks(2, [&](const Ranks& ranks) {
      Simulation simulation(part_of(plane(), ranks.here()),
                            {.method = "seisav", .backend = "modal", .backend_options = {.ranks = &ranks}});
      for (int n = 0; n < how_many; ++n) ASSERT_TRUE(simulation.step(0.01).solved());
    });
  };
  const Traffic few = steps(10), more = steps(11);
  EXPECT_EQ(more.messages - few.messages, 2 * 2) << "two transforms, as on one process";
  EXPECT_LE(more.reductions - few.reductions, 5);
}

TEST(Ranks, WhatOneProcessAloneComputesIsRefused) {
  const auto refusal = [](const Problem& problem) -> std::string {
    try {
      on_ranks(2, [&](const Ranks& ranks) { modal_system(part_of(problem, ranks.here()), {.ranks = &ranks}); });
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(plane()), "");
  EXPECT_THAT(refusal(klein_gordon_case()), testing::HasSubstr("a grid of one axis"));
  Problem bonds = plane();
  bonds.potential = chain({.points = 16}).potential;
  EXPECT_THAT(refusal(bonds), testing::HasSubstr("does not add up over points"));
}

TEST(Ranks, OneThatFailsEndsAll) {
  try {
    on_ranks(3, [](const Ranks& ranks) {
      if (ranks.here().index == 1) throw Error("no memory on rank 1");
      std::vector<double> x = {1};
      ranks.sum(x);
    });
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "no memory on rank 1");
  }
  EXPECT_THROW(on_ranks(2,
                        [](const Ranks& ranks) {
                          std::vector<double> x(static_cast<std::size_t>(1 + ranks.here().index));
                          ranks.sum(x);
                        }),
               Error)
      << "calls that do not belong together";
}

TEST(Units, AreWholeOnEveryProcess) {
  for (const Index planes : {1, 2, 3, 5, 8, 63, 64})
    for (const Index plane : {1, 2, 6, 12, 63, 64})
      for (const int count : {1, 2, 3, 7, 100}) {
        const Units whole = units_in_eights(planes, plane);
        Index next = 0, units = 0;
        for (int rank = 0; rank < count; ++rank) {
          const Slab slab = slab_of(whole, {rank, count});
          if (slab.planes == 0) continue;
          EXPECT_EQ(slab.first, next);
          EXPECT_EQ(slab.first * plane % 8, 0) << "eight numbers lie side by side as on one process";
          const Units here{slab.planes, whole.size};
          for (Index unit = 0; unit < here.count(); ++unit, ++units) {
            EXPECT_EQ(slab.first + here.begin(unit), whole.begin(units));
            EXPECT_EQ(slab.first + here.end(unit), whole.end(units));
          }
          next += slab.planes;
        }
        EXPECT_EQ(next, planes);
        EXPECT_EQ(units, whole.count());
      }
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const MethodEntry& method : methods()) names.emplace_back(method.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, OnRanks, testing::ValuesIn(method_names()),
                         [](const auto& method) { return method.param; });

}  // namespace TEST_FILE
}  // namespace seiche::test
