// Problems drawn at random: S, M, D, V and z₀ that meet the hypotheses of the energy law.
#pragma once

#include <seiche/core/problem.hpp>

#include <cstdint>
#include <random>
#include <string>

namespace seiche::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double least, double most) { return std::uniform_real_distribution<double>(least, most)(engine_); }
  double decades(double least, double most);  // 10^x
  double normal() { return std::normal_distribution<double>()(engine_); }
  Index whole(Index least, Index most) { return std::uniform_int_distribution<Index>(least, most)(engine_); }
  bool chance(double p) { return between(0, 1) < p; }

 private:
  std::mt19937_64 engine_;
};

struct RandomSystem {
  Problem problem;
  double h = 0;          // over six decades
  bool keeps_H = false;  // S is skew and there is no damping
  std::string text;      // what it is, with the seed that makes it again
};

// The same from the same seed, with one C++ library.
RandomSystem random_system(std::uint64_t seed);

// Matrices and z₀ moved by relative amounts of this size; what was skew, symmetric or 0 stays so. Of problems that are
// stated by stencils, z₀ alone.
Problem nearby(const Problem& problem, double size, Random& random);

}  // namespace seiche::test
