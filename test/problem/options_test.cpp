// Options given in C++ are refused where those of a case file are, with one sentence.
#include <test/support/error_of.hpp>

#include <seiche/backend/backends.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/network.hpp>
#include <seiche/problem/sine_gordon.hpp>
#include <seiche/problem/sparse.hpp>
#include <seiche/problem/variable_wave.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace seiche::test {
namespace TEST_FILE {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Options, ALengthIsAPositiveNumber) {
  for (const double length : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THAT(error_of([&] {
                  klein_gordon({.grid = {.points = {8, 8}, .length = {1.0, length}}});
                }),
                AllOf(HasSubstr("length = "), HasSubstr("axis 2"), HasSubstr("> 0")))
        << length;
}

TEST(Options, ABreatherHasAFrequencyBetweenZeroAndOne) {
  for (const double frequency : {0.0, 1.0, 1.5, -0.5, std::nan("")})
    EXPECT_THAT(error_of([&] { sine_gordon({.breather_frequency = frequency}); }),
                AllOf(HasSubstr("breather_frequency = "), HasSubstr("between 0 and 1")))
        << frequency;
}

TEST(Options, WavesInLayersTakeDifferencesOfOrderTwoAndNoDealiasing) {
  GridOptions grid{.points = {16}, .length = {2.0}};
  for (const Discretisation discretisation : {Discretisation::fd4, Discretisation::spectral}) {
    grid.discretisation = discretisation;
    EXPECT_THAT(error_of([&] { variable_wave({.grid = grid}); }), HasSubstr("fd2"));
  }
  grid.discretisation = Discretisation::fd2;
  grid.two_thirds = true;
  EXPECT_THAT(error_of([&] { variable_wave({.grid = grid}); }), HasSubstr("two_thirds"));
  for (const Parameter& parameter : variable_wave_entry().parameters) EXPECT_NE(parameter.name, "dealias");
}

TEST(Options, TheModalBackendTakesOneThreadOrMore) {
  for (const int threads : {0, -2})
    EXPECT_THAT(error_of([&] { find_backend("modal").system(klein_gordon(), {.threads = threads}); }),
                AllOf(HasSubstr("threads = "), HasSubstr("≥ 1")));
}

TEST(Options, ASystemOfMatricesHasOneFieldOrTwo) {
  SparseMatrix M(6, 6);
  M.setIdentity();
  const SparseMatrix S(6, 6);
  for (const Index fields : {-1, 0, 3})
    EXPECT_THAT(error_of([&] { sparse_problem({.fields = fields, .matrices = {.S = S, .M = M}}); }),
                AllOf(HasSubstr("fields = "), HasSubstr("1 or 2")));
  EXPECT_THAT(error_of([&] { sparse_problem({.fields = 1, .matrices = {.S = S, .M = SparseMatrix(0, 0)}}); }),
              HasSubstr("0 × 0"));
}

TEST(Options, ANetworkHasANode) {
  EXPECT_THAT(error_of([] { network({.adjacency = SparseMatrix(0, 0)}); }), HasSubstr("at least one node"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
