// The laws, identities and backends on systems drawn at random.
#include <test/support/cases.hpp>
#include <test/support/random_systems.hpp>
#include <test/support/worst.hpp>

#include <seiche/core/base/error.hpp>
#include <seiche/law/law.hpp>
#include <seiche/simulation/simulation.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

namespace seiche::test {
namespace TEST_FILE {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr int steps = 6;
// In units of the round-off of an energy, 50 ε times its terms. Implicit equations are solved to a few ε of what stands
// in them, which in gross steps is more than what is left of it.
constexpr double most_rise = 30, most_open = 1;
constexpr double blow_up = 1e4;            // times the terms of the energy at the start: V may have no lower bound
constexpr double longest_for_krylov = 30;  // h‖L‖, beyond which the sparse backend takes its time

// `make soak` asks for more of them, and for others.
std::uint64_t number_from(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

struct Counts {
  std::int64_t systems = 0, runs = 0, steps = 0, failed_steps = 0, refused = 0, comparisons = 0, wrong = 0;
  double worst_rise = 0, worst_ledger = 0, worst_drift = 0;  // in units of round-off
  std::int64_t followed = 0, chosen_otherwise = 0;
  double worst_difference = 0, worst_direction = 0;  // in units of what is allowed
};

class Systems {
 public:
  explicit Systems(Counts& counts) : counts_(counts) {}

  void examine(const RandomSystem& system) {
    ++counts_.systems;
    const Problem& p = system.problem;
    const LawPromise promise = promise_energy_law(p, steps * system.h);
    expect(promise.promised, system.text, [&] { return "no law is promised: " + promise.reason; });
    const std::vector<BackendEntry> all = backends_for(p);
    const double rate = linear_rate(p) * system.h;
    Random random(counts_.systems);
    for (const MethodEntry& method : methods()) {
      if (!applies(method.name, p)) continue;
      const BackendEntry& backend = all[static_cast<std::size_t>(random.whole(0, std::ssize(all) - 1))];
      if (backend.exponentials_by_krylov && rate > longest_for_krylov) continue;
      run(system, method, backend);
      follow(system, method, backend, random);
    }
    const auto names = methods();
    for (int i = 0; i < 2; ++i) {
      const MethodEntry& method = names[static_cast<std::size_t>(random.whole(0, std::ssize(names) - 1))];
      if (applies(method.name, p)) compare(system, method, all, rate, random);
    }
  }

 private:
  template <class Text>
  void expect(bool is_right, const std::string& what, const Text& text) {
    if (is_right) return;
    constexpr int shown = 12;
    if (++counts_.wrong <= shown) ADD_FAILURE() << what << ": " << text();
  }

  // ‖SM − D₀‖
  static double linear_rate(const Problem& p) {
    if (p.matrices) return (Eigen::MatrixXd(p.matrices->S * p.matrices->M) - constant_damping_matrix(p)).norm();
    return (p.S.matrix(p.grid) * p.M.matrix(p.grid) - constant_damping(p).matrix(p.grid)).norm();
  }

  // What stands for a step that has no solution, or that found none at first, keeps the law and may give energy away.
  static bool is_by_formula(const StepReport& r) {
    return r.solved() && r.fallbacks == 0 && r.halved == 0 && r.widened == 0 && r.replaced.count == 0;
  }

  // What the method promises, in every step that it says it has solved.
  void run(const RandomSystem& system, const MethodEntry& method, const BackendEntry& backend) try {
    const std::string what = fmt::format("{}, {} {}", system.text, method.name, backend.name);
    Simulation simulation(system.problem, {.method = std::string(method.name), .backend = std::string(backend.name)});
    simulation.stepper().keep_ledger();
    ++counts_.runs;
    const EnergyReading start = simulation.energy();
    EnergyReading before = start;
    double allowed_drift = 0;
    for (int n = 0; n < steps; ++n) {
      const StepReport report = simulation.step(system.h);
      if (!report.solved()) {
        ++counts_.failed_steps;
        return;
      }
      ++counts_.steps;
      const EnergyReading after = simulation.energy();
      const double largest = simulation.state().z.lpNorm<Eigen::Infinity>();
      const bool overflows = largest > 1e50;  // energies may not be finite then
      expect(std::isfinite(largest) && (overflows || (std::isfinite(after.H) && std::isfinite(after.modified))), what,
             [&] { return fmt::format("a step that is called solved leaves |z| = {} and H = {}", largest, after.H); });
      if (!(std::max(after.round_off, after.modified_round_off) <= blow_up * start.modified_round_off)) return;
      const double modified_round_off = std::max(before.modified_round_off, after.modified_round_off);
      const double rise = (after.modified - before.modified) / modified_round_off;
      counts_.worst_rise = worse(counts_.worst_rise, rise);
      expect(rise <= most_rise, what, [&] { return fmt::format("the energy rises by {:.3g} of its round-off", rise); });
      if (!is_by_formula(report)) return;
      double parts = 0;
      for (const LedgerPart& part : ledger_parts()) parts += std::abs(report.ledger.*part.value);
      const double round_off = std::max({before.round_off, after.round_off, modified_round_off, 50 * epsilon * parts});
      const double open = std::abs(report.ledger.sum() - (after.H - before.H)) / round_off;
      counts_.worst_ledger = worse(counts_.worst_ledger, open);
      expect(open <= most_open, what,
             [&] { return fmt::format("the ledger does not close by {:.3g} of round-off", open); });
      allowed_drift += modified_round_off;
      if (system.keeps_H) {
        const double drift = std::abs(after.modified - start.modified) / allowed_drift;
        counts_.worst_drift = worse(counts_.worst_drift, drift);
        expect(drift <= most_rise, what,
               [&] { return fmt::format("the energy drifts by {:.3g} of round-off", drift); });
      }
      before = after;
    }
  } catch (const Error&) {
    ++counts_.refused;
  }

  // A step that is short beside all that happens leads along ż in its middle, but for its third power. The law and
  // the agreement of backends would not see a method that damps twice.
  void follow(const RandomSystem& system, const MethodEntry& method, const BackendEntry& backend, Random& random) try {
    constexpr double share = 1e-4,
                     allowed = 1e-8;  // of the time in which something happens; of what it changes in that
    Simulation simulation(system.problem, {.method = std::string(method.name), .backend = std::string(backend.name)});
    const Vector z = simulation.state().z;
    Vector f(z.size()), moved(z.size()), direction(z.size());
    for (double& x : direction) x = random.normal();
    direction *= 1e-6 * largest(z) / largest(direction);
    simulation.system().right_hand_side(0, z, f);
    simulation.system().right_hand_side(0, z + direction, moved);
    constexpr double of_rates = 10;  // γ(t) changes so fast at most
    const double rate =
        of_rates + linear_rate(system.problem) + 10 * (moved - f).norm() / direction.norm() + f.norm() / z.norm();
    const double h = share / rate;
    if (!is_by_formula(simulation.step(h))) return;
    ++counts_.followed;
    simulation.system().right_hand_side(h / 2, (z + simulation.state().z) / 2, f);
    const double error = (simulation.state().z - z - h * f).norm() / (allowed * h * rate * z.norm());
    counts_.worst_direction = worse(counts_.worst_direction, error);
    expect(error <= 1, fmt::format("{}, {} {}", system.text, method.name, backend.name),
           [&] { return fmt::format("a step of {:.3g} is wrong by {:.3g} of what is allowed", h, error); });
  } catch (const Error&) {
    ++counts_.refused;
  }

  // The state at the end, and nothing where a step was not what the formula of the method says.
  static std::optional<Vector> end(const Problem& problem, const MethodEntry& method, std::string_view backend,
                                   double h) try {
    Simulation simulation(problem, {.method = std::string(method.name), .backend = std::string(backend)});
    for (int n = 0; n < steps; ++n) {
      if (!is_by_formula(simulation.step(h))) return std::nullopt;
    }
    return simulation.physical();
  } catch (const Error&) {
    return std::nullopt;
  }

  // Backends may differ by what a change of the system, of z₀, of h and of each entry of hL by some hundred ε does.
  void compare(const RandomSystem& system, const MethodEntry& method, const std::vector<BackendEntry>& all, double rate,
               Random& random) {
    constexpr double change = 1e-9, units = 1e4 * epsilon, by_krylov = 20, choice = 1e-4;
    const Problem& p = system.problem;
    const auto expected = end(p, method, "reference", system.h);
    if (!expected) return;
    double moved = 0;
    for (int i = 0; i < 3; ++i) {
      const auto other = end(nearby(p, change, random), method, "reference", system.h * (1 + change * random.normal()));
      if (!other) return;
      moved = worse(moved, largest(*other - *expected));
    }
    const double size = std::max(largest(*expected), largest(p.initial));
    if (!(moved < 1e-2 * size)) return;  // too sensitive to be computed
    const double allowed = units * (moved / change + (1 + rate) * size);
    for (const BackendEntry& backend : all) {
      if (backend.name == "reference" || (backend.exponentials_by_krylov && rate > longest_for_krylov)) continue;
      // Where exponentials come from tables, it makes no more sweeps than its own error asks for.
      if (backend.exponentials_by_krylov && method.kind.composition == "collocation" && method.order > 4) continue;
      const auto found = end(p, method, backend.name, system.h);
      if (!found) continue;
      ++counts_.comparisons;
      const double difference =
          largest(*found - *expected) / (allowed * (backend.exponentials_by_krylov ? by_krylov : 1));
      // Projections choose: between two quadratures, or how many sweeps are enough. What round-off decides there is a
      // small part of the error of the step.
      if (difference > 1 && method.projects() && largest(*found - *expected) < choice * size) {
        ++counts_.chosen_otherwise;
        continue;
      }
      counts_.worst_difference = worse(counts_.worst_difference, difference);
      expect(difference <= 1, fmt::format("{}, {} {}", system.text, method.name, backend.name),
             [&] { return fmt::format("differs from the reference by {:.3g} of what is allowed", difference); });
    }
  }

  Counts& counts_;
};

Counts examine_systems(std::uint64_t first, std::uint64_t count) {
  const auto begin = std::chrono::steady_clock::now();
  Counts counts;
  Systems systems(counts);
  for (std::uint64_t seed = first; seed < first + count; ++seed) systems.examine(random_system(seed));
  const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  fmt::print(
      "random systems: {} systems, {} runs with {} steps ({} not solved, {} refused), {} short steps beside ż, {} comparisons of backends, "
      "{} wrong\nrandom systems: the kept energy rises by {:.2g} and drifts by {:.2g} of its round-off at most, the ledger is open by {:.2g}; "
      "of what is allowed, backends differ by {:.2g} and short steps are wrong by {:.2g}; {:.0f} s\n",
      counts.systems, counts.runs, counts.steps, counts.failed_steps, counts.refused, counts.followed,
      counts.comparisons, counts.wrong, counts.worst_rise, counts.worst_drift, counts.worst_ledger,
      counts.worst_difference, counts.worst_direction, took);
  return counts;
}

// So few of them that sanitizers see every path.
TEST(RandomSystems, KeepTheLawsOfTheirMethodsOnEveryBackend) { EXPECT_EQ(examine_systems(1, 30).wrong, 0); }

// Steps that end at infinity and were called solved, auxiliary variables below 0 whose round-off was, too, and memories
// of midpoints that one backend trusted and another did not.
TEST(RandomSystems, ThatWereWrongOnceAreNotAnyMore) {
  for (const std::uint64_t seed : {1001, 1285, 1481, 2653, 3753, 7353, 51503, 53721})
    EXPECT_EQ(examine_systems(seed, 1).wrong, 0);
}

// M all but singular: ‖hSM‖ = 200 beside hρ < 16, and A far from normal.
TEST(RandomSystems, WhoseFlowIsFarFromNormalKeepTheirEnergyOnEveryBackend) {
  const RandomSystem system = random_system(61488);
  for (const BackendEntry& backend : backends_for(system.problem)) {
    Simulation simulation(system.problem, {.method = "seisav", .backend = std::string(backend.name)});
    const EnergyReading start = simulation.energy();
    for (int n = 1; n <= steps; ++n) {
      ASSERT_TRUE(simulation.step(system.h).solved()) << backend.name;
      const EnergyReading now = simulation.energy();
      EXPECT_LE(std::abs(now.modified - start.modified), 4 * n * now.modified_round_off)
          << backend.name << " step " << n;
    }
  }
}

TEST(RandomSystemsSlow, KeepTheLawsOfTheirMethodsOnEveryBackend) {
  const Counts counts = examine_systems(number_from("SEICHE_FIRST_SYSTEM", 1000), number_from("SEICHE_SYSTEMS", 400));
  EXPECT_EQ(counts.wrong, 0);
  EXPECT_GE(counts.runs, 10 * counts.systems);
  EXPECT_GE(counts.comparisons, counts.systems / 2);
  EXPECT_LE(counts.chosen_otherwise, 1 + counts.comparisons / 1000);
  EXPECT_LE(counts.failed_steps + counts.refused, counts.runs / 10);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
