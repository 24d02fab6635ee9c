// Anderson's acceleration against linear algebra.
#include <seiche/method/collocation/anderson_acceleration.hpp>

#include <test/support/plain_space.hpp>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <cmath>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using Matrix = Eigen::MatrixXd;

constexpr Index size = 6;
constexpr Potential::Support part{1, 4};

// Two states of which the components 1 … 4 are unknowns: x → Ax + b of the eight unknowns together.
struct Iteration {
  Matrix A;
  Vector b;

  std::vector<Vector> start() const { return {Vector::Constant(size, 7.0), Vector::Constant(size, 7.0)}; }
  static Vector unknowns(const std::vector<Vector>& x) {
    Vector all(2 * part.size);
    all << x[0].segment(part.begin, part.size), x[1].segment(part.begin, part.size);
    return all;
  }
  void apply(std::vector<Vector>& x) const {
    const Vector next = A * unknowns(x) + b;
    x[0].segment(part.begin, part.size) = next.head(part.size);
    x[1].segment(part.begin, part.size) = next.tail(part.size);
  }
  void advance(AndersonAcceleration& acceleration, std::vector<Vector>& x) const {
    apply(x);
    acceleration.advance(x);
  }
  Vector fixed_point() const { return (Matrix::Identity(8, 8) - A).partialPivLu().solve(b); }
};

// Eigenvalues of −0.1 … −30 in a basis that is not orthogonal: iteration by itself diverges.
Iteration steep() {
  Matrix basis = Matrix::Identity(8, 8);
  for (Index i = 0; i < 8; ++i)
    for (Index j = 0; j < 8; ++j) basis(i, j) += 0.3 * std::sin(1.0 + 3.0 * static_cast<double>(i + 5 * j));
  Vector eigenvalues(8);
  eigenvalues << -0.1, -0.5, -1, -2, -5, -10, -20, -30;
  return {basis * eigenvalues.asDiagonal() * basis.inverse(), Vector::LinSpaced(8, -1.0, 2.0)};
}

TEST(AndersonAcceleration, SolvesALinearEquationInAsManyStepsAsThereAreUnknowns) {
  const PlainSpace space(size);
  const Iteration iteration = steep();
  AndersonAcceleration acceleration(space, 2, part, 8);
  for (int run = 0; run < 2; ++run) {
    std::vector<Vector> x = iteration.start();
    acceleration.restart();
    acceleration.advance(x);
    EXPECT_TRUE(std::isinf(acceleration.residual()));
    for (int i = 0; i < 10; ++i) iteration.advance(acceleration, x);
    EXPECT_LE((Iteration::unknowns(x) - iteration.fixed_point()).norm(), 1e-10);
    EXPECT_EQ(x[1][0], 7.0) << "what is no unknown stays";
    EXPECT_EQ(x[0][5], 7.0);
  }
}

TEST(AndersonAcceleration, TellsTheResidualAndTheLeastThatIsExpected) {
  const PlainSpace space(size);
  const Iteration iteration = steep();
  AndersonAcceleration acceleration(space, 2, part, 8);
  std::vector<Vector> x = iteration.start();
  acceleration.advance(x);
  Vector at = Iteration::unknowns(x), least(size);
  for (int i = 0; i < 6; ++i) {
    iteration.apply(x);
    const Vector residual = Iteration::unknowns(x) - at;
    acceleration.advance(x);
    EXPECT_NEAR(acceleration.residual(), residual.norm(), 1e-12 * residual.norm());
    EXPECT_LE(acceleration.least_residual(), acceleration.residual());
    if (i == 0) {  // nothing to combine yet
      EXPECT_EQ(acceleration.least_residual(), acceleration.residual());
    } else {
      EXPECT_LT(acceleration.least_residual(), 0.9 * acceleration.residual());
    }
    least.setConstant(3.0);
    acceleration.least_residual(least);
    EXPECT_LE(least.segment(part.begin, part.size).norm(), acceleration.least_residual());
    EXPECT_EQ(least[0], 3.0);
    at = Iteration::unknowns(x);
  }
}

// With a short memory it still converges, where the oldest pair makes room.
TEST(AndersonAcceleration, ForgetsTheOldestIterates) {
  const PlainSpace space(size);
  Iteration iteration = steep();
  iteration.A *= 0.1;  // −3 … −0.01
  AndersonAcceleration acceleration(space, 2, part, 3);
  std::vector<Vector> x = iteration.start();
  acceleration.advance(x);
  for (int i = 0; i < 40; ++i) iteration.advance(acceleration, x);
  EXPECT_LE((Iteration::unknowns(x) - iteration.fixed_point()).norm(), 1e-8);
}

// A step that changes nothing has no direction.
TEST(AndersonAcceleration, StaysAtAFixedPoint) {
  const PlainSpace space(size);
  const Iteration iteration{Matrix::Zero(8, 8), Vector::Ones(8)};
  AndersonAcceleration acceleration(space, 2, part, 4);
  std::vector<Vector> x = iteration.start();
  acceleration.advance(x);
  for (int i = 0; i < 6; ++i) {
    iteration.advance(acceleration, x);
    EXPECT_EQ(Iteration::unknowns(x), Vector::Ones(8)) << i;
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
