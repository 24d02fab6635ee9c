// What the library says about a problem: its right-hand side and its energy, of physical values. Peers are held against
// it.
#pragma once

#include <bench/peers/peer.hpp>
#include <bench/work_precision/test_problems.hpp>
#include <seiche/core/run_report.hpp>
#include <seiche/core/system.hpp>

#include <span>
#include <string>

namespace seiche::bench {

class Judge {
 public:
  explicit Judge(const TestProblem& test);

  double energy(std::span<const double> z) const;
  double energy_round_off(std::span<const double> z) const;
  const LawPromise& law() const { return law_; }  // of the exact solution's H

  // Why the run integrates another equation, or "": its right-hand side at z₀ and at a rough state nearby.
  std::string refuses(Run& run) const;

 private:
  const Vector& coordinates(std::span<const double> z) const;
  double disagreement(Run& run, const Vector& z) const;

  System system_;
  LawPromise law_;
  Vector initial_;
  mutable Vector coordinates_;
};

}  // namespace seiche::bench
