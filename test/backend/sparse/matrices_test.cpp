// Sparse matrices by themselves: whether they are definite, what shows it, and the files that they come from.
#include <test/support/error_of.hpp>
#include <test/support/matrices.hpp>
#include <test/support/paths.hpp>
#include <test/support/temporary_directory.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/config/data/matrix_file.hpp>
#include <seiche/config/data/matrix_market.hpp>
#include <seiche/core/numerics/definiteness.hpp>
#include <seiche/problem/network.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

TEST(Sparse, DefinitenessAgreesWithEigenvalues) {
  std::srand(7);
  int indefinite = 0;
  for (int k = 0; k < 60; ++k) {
    const Matrix B = Matrix::Random(8, k % 2 == 0 ? 8 : 5);
    const Matrix A = B * B.transpose() - (k % 3 == 0 ? 0.0 : 0.1 * (k % 7)) * Matrix::Identity(8, 8);
    const double smallest = Eigen::SelfAdjointEigenSolver<Matrix>(A).eigenvalues().minCoeff();
    const auto direction = negative_direction(A.sparseView());
    EXPECT_EQ(direction.has_value(), smallest < -1e-12) << smallest;
    indefinite += direction ? 1 : 0;
    if (direction) {
      EXPECT_GE(direction->value, smallest - 1e-12);
    }
  }
  EXPECT_GT(indefinite, 10);
  EXPECT_LT(indefinite, 50);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {  // sparse: the order of elimination is not that of the unknowns
    SparseMatrix A = small_world(30, 1, 12, seed);
    for (Index i = 0; i < A.rows(); ++i) A.coeffRef(i, i) = 1.5 + 0.1 * static_cast<double>(seed);
    const double smallest = Eigen::SelfAdjointEigenSolver<Matrix>(Matrix(A)).eigenvalues().minCoeff();
    const auto direction = negative_direction(A);
    EXPECT_EQ(direction.has_value(), smallest < 0) << smallest;
    if (direction) {
      EXPECT_GE(direction->value, smallest);
    }
  }
}

// Whose pivots are all round-off, or whose elimination leaves a direction that hardly falls.
TEST(Sparse, TheWitnessOfAnIndefiniteMatrixIsNoRoundOff) {
  SparseMatrix swap(2, 2);
  swap.insert(0, 1) = swap.insert(1, 0) = 1;
  const auto direction = negative_direction(swap);
  ASSERT_TRUE(direction);
  EXPECT_NEAR(direction->value, -1, 1e-6);
  SparseMatrix four(4, 4);
  four.insert(0, 0) = four.insert(1, 1) = 1;
  four.insert(2, 3) = four.insert(3, 2) = 0.5;
  const auto other = negative_direction(four);
  ASSERT_TRUE(other);
  EXPECT_NEAR(other->value, -0.5, 1e-6);
  EXPECT_GE(other->largest, 2);
}

TEST(Sparse, StencilsWithMoreEntriesThanAMatrixCanCountAreRefused) {
  const Grid grid{
      .axes = {{600, 1.0, Boundary::periodic}, {600, 1.0, Boundary::periodic}, {600, 1.0, Boundary::periodic}}};
  const Stencil laplacian = Stencil::laplacian(grid, Discretisation::fd4);
  const std::string message = error_of([&] { laplacian.sparse_matrix(grid); });
  EXPECT_NE(message.find("fewer points"), std::string::npos) << message;
}

// As PETSc writes a matrix: numbers with their highest byte first.
class PetscBinary : public InTemporaryDirectory {
 protected:
  std::string integers(const std::vector<std::int64_t>& numbers) const {
    std::string text;
    for (const std::int64_t number : numbers) text += bytes(static_cast<std::uint64_t>(number), wide ? 8 : 4);
    return text;
  }
  static std::string reals(const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers) text += bytes(std::bit_cast<std::uint64_t>(number), 8);
    return text;
  }
  std::filesystem::path write(const std::string& text) const {
    std::filesystem::path file = directory / "a.bin";
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  std::string mark(std::int64_t number = 1211216) const {
    return (wide ? std::string(4, '\0') : "") + bytes(static_cast<std::uint64_t>(number), 4);
  }
  std::string refusal(const std::string& text) const {
    return error_of([&] { read_matrix(write(text)); });
  }
  bool wide = false;

 private:
  static std::string bytes(std::uint64_t number, int count) {
    std::string text;
    for (int k = count; k-- > 0;) text += static_cast<char>(number >> (8 * k) & 0xff);
    return text;
  }
};

TEST_F(PetscBinary, SparseAndDenseMatricesAreReadWithIndicesOfBothWidths) {
  Matrix expected(2, 3);
  expected << 1, 0, -2.5, 0, 3, 0;
  for (const bool of_64_bits : {false, true}) {
    wide = of_64_bits;
    EXPECT_EQ(Matrix(read_matrix(write(mark() + integers({2, 3, 3, 2, 1, 0, 2, 1}) + reals({1, -2.5, 3})))), expected);
    EXPECT_EQ(Matrix(read_matrix(write(mark() + integers({2, 3, -1}) + reals({1, 0, -2.5, 0, 3, 0})))), expected);
    const MatrixSizes sizes = matrix_sizes(directory / "a.bin");
    EXPECT_EQ(std::tuple(sizes.rows, sizes.columns, sizes.entries), std::tuple(2, 3, 6));
  }
  bool repeats = false;
  EXPECT_EQ(read_matrix(write(mark() + integers({1, 1, 2, 2, 0, 0}) + reals({1, 2})), &repeats).coeff(0, 0), 3);
  EXPECT_TRUE(repeats);
}

TEST_F(PetscBinary, WhatIsWrongWithAFileIsSaid) {
  const auto says = [](const std::string& message, const std::string& what) {
    EXPECT_NE(message.find(what), std::string::npos) << message;
  };
  for (const bool of_64_bits : {false, true}) {
    wide = of_64_bits;
    says(refusal(mark(1211214) + integers({1}) + reals({1})), "a.bin is a vector of PETSc");
    says(refusal(mark() + integers({1, 1, 1, 1, 0}) + reals({1, 0})), "one matrix is expected, of real numbers");
    says(refusal(mark() + integers({1, 1, 1, 1, 0})), "one matrix is expected");
    says(refusal(mark() + integers({1, 1, 1, 1, 1}) + reals({1})), "no column 2 in a matrix of 1 × 1");
    says(refusal(mark() + integers({1, 1, 1, 2, 0}) + reals({1})), "a row of 2 entries is not possible");
    says(refusal(mark() + integers({2, 1, 1, 0, 0, 0}) + reals({1})), "0 entries together, and 1 are there");
    says(refusal(mark() + integers({1, 1, 1, 1, 0}) + reals({std::nan("")})), "the entry (1, 1) is not finite");
    says(refusal(mark() + integers({0, 1, 0})), "a matrix of 0 × 1 is not possible");
    says(refusal(mark() + integers({2000000000, 1, 0})), "needs at least");
    says(refusal(mark() + integers({1, 1, -2})), "-2 entries are not possible");
    says(refusal(mark() + integers({1})), "a.bin ends too early");
  }
}

class MatrixMarket : public InTemporaryDirectory {
 protected:
  std::filesystem::path write(const std::string& text) const {
    std::filesystem::path file = directory / "a.mtx";
    std::ofstream(file) << text;
    return file;
  }
  std::string refusal(const std::string& text) const {
    return error_of([&] { read_matrix_market(write(text)); });
  }
};

TEST_F(MatrixMarket, EveryKindIsRead) {
  Matrix expected(2, 2);
  expected << 1, -2.5, 0, 3;
  EXPECT_EQ(Matrix(read_matrix_market(write(
                "%%MatrixMarket matrix coordinate real general\n% by hand\n\n2 2 3\n1 1 1\n1 2 -2.5\n2 2 +3e0\n"))),
            expected);
  EXPECT_EQ(Matrix(read_matrix_market(write("%%MatrixMarket matrix array real general\n2 2\n1\n0\n-2.5\n3\n"))),
            expected);
  expected << 0, -4, 4, 0;
  EXPECT_EQ(Matrix(
                read_matrix_market(write("%%MatrixMarket matrix coordinate integer skew-symmetric\n2 2 1\n2 1 4\n"))),
            expected);
  expected << 1, 1, 1, 0;
  EXPECT_EQ(Matrix(read_matrix_market(write("%%MatrixMarket matrix coordinate pattern symmetric\n2 2 2\n1 1\n2 1\n"))),
            expected);
  expected << 1, 2, 2, 3;
  EXPECT_EQ(Matrix(read_matrix_market(write("%%MatrixMarket MATRIX array Real Symmetric\n2 2\n1\n2\n3\n"))), expected);
}

TEST_F(MatrixMarket, AMistakeIsNamedWithItsLine) {
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n";
  EXPECT_NE(refusal("1 2 3\n").find(":1: a Matrix Market file begins"), std::string::npos);
  EXPECT_NE(
      refusal("%%MatrixMarket matrix coordinate complex general\n").find("'complex' must be one of real, integer"),
      std::string::npos);
  EXPECT_NE(refusal(head + "2 2 1\n1 2 1\n").find(":3: of a symmetric matrix the file holds the lower triangle"),
            std::string::npos);
  EXPECT_NE(refusal(head + "2 2 1\n3 1 1\n").find("no entry (3, 1)"), std::string::npos);
  EXPECT_NE(refusal(head + "2 2 1\n2 1 x\n").find("'x' is not a number"), std::string::npos);
  EXPECT_NE(refusal(head + "2 2 1\n2 1 nan\n").find("not finite"), std::string::npos);
  EXPECT_NE(refusal(head + "2 2 2\n2 1 1\n").find("ends after 1 of 2"), std::string::npos);
  EXPECT_NE(refusal(head + "2 2 1\n2 1 1\n1 1 1\n").find(":4: more entries"), std::string::npos);
  EXPECT_NE(refusal(head + "2 3 1\n2 1 1\n").find("square"), std::string::npos);
  EXPECT_NE(refusal(head + "2 2 1000000000\n2 1 1\n").find("do not fit"), std::string::npos);
  const std::string huge = refusal("%%MatrixMarket matrix coordinate real general\n2000000000 2000000000 1\n1 1 1\n");
  EXPECT_NE(huge.find("a.mtx:2: a matrix of 2000000000 × 2000000000 needs at least"), std::string::npos) << huge;
  EXPECT_NE(error_of([] { read_matrix_market("no_such.mtx"); }).find("no_such.mtx"), std::string::npos);
}

TEST(Sparse, CaseFilesNameMatricesBesideThemselves) {
  const std::filesystem::path cases = std::filesystem::path(test::source_directory()) / "cases";
  for (const std::string name : {"wave", "truss", "network", "sparse"}) {
    const RunSpec spec = read_case(cases / (name + ".toml"));
    Simulation simulation(make_problem(spec), simulation_options(spec));
    const double start = simulation.energy().modified;
    for (int n = 0; n < 5; ++n) ASSERT_TRUE(simulation.step(spec.h).solved()) << name;
    EXPECT_LT(simulation.energy().modified, start) << name;
    const RunSpec again = parse_case(write_case(spec), "again.toml");  // file names are absolute there
    EXPECT_EQ(write_case(again), write_case(spec)) << name;
  }
  EXPECT_NE(error_of([] {
              parse_case("[problem]\nname = \"network\"\ngraph = \"absent.mtx\"\n", "c.toml");
            }).find("problem.graph file absent.mtx does not exist"),
            std::string::npos);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
