// Formulas as straight-line code: the same values, and no more work than they ask for.
#include <seiche/formula/expression_code.hpp>
#include <seiche/formula/formula_compiler.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using Do = ExpressionCode::Operation::Kind;
constexpr std::size_t block = ExpressionCode::block;

const std::vector<std::string>& names() {
  static const std::vector<std::string> list = {"u", "v"};
  return list;
}

// The formulas, and the code of all of them.
struct Written {
  explicit Written(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) formulas.push_back(compile_formula(text, names()));
  }
  ExpressionGraph graph() const {
    std::vector<std::span<const Instruction>> programs;
    for (const FormulaPointer& formula : formulas) programs.push_back(formula->program());
    return {2, programs};
  }
  ExpressionCode code() const {
    const ExpressionGraph of = graph();
    std::vector<std::size_t> outputs;
    for (std::size_t f = 0; f < formulas.size(); ++f) outputs.push_back(of.output(f));
    return {of, outputs};
  }
  std::vector<FormulaPointer> formulas;
};

long operations(const ExpressionCode& code, Do kind) {
  const auto all = code.operations();
  return std::count_if(all.begin(), all.end(), [&](const auto& o) { return o.kind == kind; });
}

double value_at(const ExpressionCode& code, std::size_t i, const std::vector<double>& table, std::size_t j) {
  const auto& [factor, row] = code.value(i);
  return row < 0 ? factor : factor * table[static_cast<std::size_t>(row) * block + j];
}

TEST(ExpressionCode, ItsValuesAreThoseOfTheFormulasInBlocksOfAnyLength) {
  const Written written(
      {"u", "3", "-u", "u*v - v/(1 + u^2) + 3", "(u^2 + v^2)^2/4 - 0.3*u^4", "u^7 - 3*v^-3*u^2 + (u + v + 2)^4",
       "(u + 2)^-70", "sin(u)*cos(u) + sin(2*u) - cos(u/2)*sin(u/2)", "1 - cos(u) + exp(-v^2)*log(2 + v^2)",
       "(2 + u^2)^1.5 + (1.5 + v^2)^(u/3)", "min(u, v) + max(v, -1) + step(u) + abs(v)", "2/u + u/2 + 1/3 + (0*u)*v",
       "-(u + v)*(-u + v) - (v - u)", "tanh(u)/cosh(v) + sqrt(1 + u^2) - 1"});
  const ExpressionCode code = written.code();
  std::mt19937_64 bits(5);
  std::uniform_real_distribution<double> some(0.2, 1.4);
  for (const std::size_t points : {std::size_t{1}, std::size_t{8}, std::size_t{37}, block}) {
    std::vector<double> table(code.table_size());
    for (std::size_t v = 0; v < 2; ++v)
      for (std::size_t j = 0; j < points; ++j) table[v * block + j] = some(bits) * (v == 0 ? 1 : -1);
    code.run(table.data(), points);
    for (std::size_t f = 0; f < written.formulas.size(); ++f)
      for (std::size_t j = 0; j < points; ++j) {
        const double expected = (*written.formulas[f])(std::vector{table[j], table[block + j]});
        EXPECT_NEAR(value_at(code, f, table, j), expected, 1e-14 * (1 + std::abs(expected)))
            << written.formulas[f]->text() << ", point " << j << " of " << points;
      }
  }
}

TEST(ExpressionCode, PowersShareTheirFactors) {
  const ExpressionCode code = Written({"u^4", "u^3", "u^2", "7*u^8", "-u^4*v"}).code();
  EXPECT_EQ(code.operations().size(), 5U);  // u², u³, u⁴, u⁸ and u⁴v
  EXPECT_EQ(operations(code, Do::product), 5);
}

// V = −(p² + q²)²/4 and its slopes: two squares, their sum, its square, and r p and r q with r = p² + q².
TEST(ExpressionCode, NumbersAndSignsCostNothingWhereOnlyFactorsChange) {
  const ExpressionCode code = Written({"-(u^2 + v^2)^2/4", "-(u^2 + v^2)*u", "-(u^2 + v^2)*v"}).code();
  EXPECT_EQ(code.operations().size(), 5U);
  EXPECT_EQ(operations(code, Do::product_linear), 1);  // u² + v² with one of the squares in it
  EXPECT_EQ(code.value(0).factor, -0.25);
}

TEST(ExpressionCode, SinesAndCosinesOfOneAngleAndOfItsHalfComeFromOneCall) {
  const ExpressionCode code = Written({"2*sin(u/2)^2", "sin(u)", "cos(u/2)"}).code();
  EXPECT_EQ(operations(code, Do::sine_and_cosine), 1);
  EXPECT_EQ(operations(code, Do::call), 0);
}

TEST(ExpressionCode, RowsTakeTurns) {
  std::string text = "u";
  for (int k = 1; k < 40; ++k) text = fmt::format("({}*v + {})", text, k);
  const ExpressionCode code = Written({text}).code();
  EXPECT_GE(code.operations().size(), 39U);
  EXPECT_LE(code.table_size(), 4 * block);
}

// A factor that is put off must not make an overflow of what has none.
TEST(ExpressionCode, FactorsOfAnySizeStayWhereTheyAreWritten) {
  const ExpressionCode code = Written({"(1e-200*u)*(1e-200*v)", "(1e-200*u)^2", "(1e200*u)/(1e-200*v)"}).code();
  std::vector<double> table(code.table_size());
  table[0] = 1e200, table[block] = 2e200;
  code.run(table.data(), 1);
  EXPECT_NEAR(value_at(code, 0, table, 0), 2, 1e-15);
  EXPECT_NEAR(value_at(code, 1, table, 0), 1, 1e-15);
  table[0] = 1e-200;
  code.run(table.data(), 1);
  EXPECT_NEAR(value_at(code, 2, table, 0), 0.5, 1e-15);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
