#include <bench/peers/groups.hpp>
#include <bench/peers/hand_written.hpp>
#include <bench/work_precision/reference.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/output/csv_row.hpp>
#include <seiche/output/file/atomic_file.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>

namespace seiche::bench {
namespace {

namespace fs = std::filesystem;

std::vector<double> solution(Run& run, const Equation& equation, const std::string& name) {
  run.restart();
  const std::string failure = run.advance(equation.t_end);
  if (!failure.empty()) throw Error("the reference by {} failed: {}", name, failure);
  std::vector<double> z(equation.size());
  run.values(z);
  return z;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = std::abs(a[i] - b[i]);
    if (!(d <= largest)) largest = d;  // NaN stays
  }
  return largest;
}

std::vector<double> by_fehlberg(const Equation& equation, double tolerance) {
  const PeerGroup group = odeint_peers();
  const auto found = std::find_if(group.peers.begin(), group.peers.end(),
                                  [](const Peer& peer) { return peer.name == "odeint Fehlberg78"; });
  if (found == group.peers.end()) throw Error("the peer odeint Fehlberg78 is not in its list");
  return solution(*found->make(equation, tolerance), equation, found->name);
}

std::vector<double> by_etdrk4(const Equation& equation, double h) {
  return solution(*make_etdrk4(equation, h), equation, "ETDRK4");
}

// ETDRK4, extrapolated from h and h/2, until it no longer comes nearer to `other`.
double nearest_etdrk4(const TestProblem& test, const std::vector<double>& other) {
  constexpr double good = 2e-12;
  constexpr double most_values = 3e8;  // steps × unknowns: some seconds
  const Equation& equation = test.equation;
  double h = std::ldexp(1.0, -(test.coarsest + 3));
  std::vector<double> coarse = by_etdrk4(equation, h);
  double best = INFINITY;
  for (;;) {
    h /= 2;
    const std::vector<double> fine = by_etdrk4(equation, h);
    std::vector<double> extrapolated = fine;
    for (std::size_t i = 0; i < fine.size(); ++i) extrapolated[i] += (fine[i] - coarse[i]) / 15;
    const double d = std::min(distance(extrapolated, other), distance(fine, other));
    const bool stalls = d > best / 2 && best < 1e-8;
    best = std::fmin(best, d);
    const double next_cost = 2 * equation.t_end / h * static_cast<double>(equation.size());
    if (best < good || stalls || next_cost > most_values) return best;
    coarse = fine;
  }
}

Reference compute(const TestProblem& test) {
  const double tolerance = test.reference_tolerance;
  constexpr double disagreement = 1e-8;
  Reference reference;
  reference.z = by_fehlberg(test.equation, tolerance);
  reference.difference = nearest_etdrk4(test, reference.z);
  reference.origin =
      fmt::format("odeint Fehlberg78 with tolerance {:.0e}, and ETDRK4 within {:.2g}", tolerance, reference.difference);
  if (!(reference.difference < disagreement))
    throw Error("{}: the two references differ by {:.3g}, and {:.0e} is allowed", test.key, reference.difference,
                disagreement);
  return reference;
}

// FNV-1a over all that decides the solution.
std::uint64_t fingerprint(const TestProblem& test) {
  std::uint64_t hash = 14695981039346656037U;
  const auto mix = [&](const void* data, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      hash ^= static_cast<const unsigned char*>(data)[i];
      hash *= 1099511628211U;
    }
  };
  mix(test.parameters.data(), test.parameters.size());
  mix(test.equation.initial.data(), test.equation.initial.size() * sizeof(double));
  return hash;
}

bool read(const fs::path& path, std::size_t size, Reference& reference) {
  std::ifstream file(path);
  if (!std::getline(file, reference.origin) || !(file >> reference.difference)) return false;
  reference.z.resize(size);
  for (double& value : reference.z) {
    if (!(file >> value)) return false;
  }
  return true;
}

void keep(const fs::path& path, const Reference& reference) {
  AtomicFile file(path);
  file.write(reference.origin + "\n");
  CsvRow row;
  row.add(reference.difference);
  file.write(row.line());
  for (const double value : reference.z) {
    row.clear();
    row.add(value);
    file.write(row.line());
  }
  file.commit();
}

}  // namespace

Reference find_reference(const TestProblem& test, const Judge& judge, const fs::path& directory) {
  const fs::path path = directory / fmt::format("{}-{:016x}.txt", test.key, fingerprint(test));
  Reference reference;
  if (!read(path, test.equation.size(), reference)) {
    reference = compute(test);
    make_directory(directory);
    keep(path, reference);
  }
  reference.energy = judge.energy(reference.z);
  return reference;
}

}  // namespace seiche::bench
