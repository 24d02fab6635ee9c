// The certificate: each hypothesis graded rightly, with a witness that can be checked.
#include <test/support/cases.hpp>
#include <test/support/error_of.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/law/law.hpp>
#include <seiche/problem/nls.hpp>
#include <seiche/problem/truss.hpp>
#include <seiche/simulation/certificate.hpp>
#include <seiche/study/reference.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

namespace seiche::test {
namespace TEST_FILE {

using testing::HasSubstr;

Hypothesis find(const Certificate& certificate, const std::string& name) {
  for (const Hypothesis& hypothesis : certificate.hypotheses)
    if (hypothesis.name == name) return hypothesis;
  ADD_FAILURE() << "no finding about " << name;
  return {};
}

TEST(Certificate, SaysThatTheLawHoldsWhateverWasPredictedOrComputedOnTheWay) {
  const Problem problem = klein_gordon_case();
  for (const MethodEntry& method : methods()) {
    if (!applies(method.name, problem)) continue;
    const Certificate c = certify(problem, {.method = std::string(method.name), .t_end = 1, .sample_solution = false});
    EXPECT_EQ(c.theorem.find("whatever ẑ the step has computed") != std::string::npos, method.projects())
        << method.name << ": " << c.theorem;
    EXPECT_EQ(c.theorem.find("whatever midpoint ẑ was predicted") != std::string::npos, method.kind.takes_predictor)
        << method.name << ": " << c.theorem;
    EXPECT_THAT(certificate_json(c), HasSubstr("\"theorem\": \"" + c.theorem + '"'));
  }
}

TEST(Certificate, OfTheKleinGordonEquationPromisesTheLaw) {
  const Certificate c = certify(klein_gordon_case(), {.t_end = 50});
  EXPECT_EQ(find(c, "sym(S) ⪯ 0").grade, Grade::by_structure);
  const Hypothesis M = find(c, "M ⪰ 0");
  EXPECT_EQ(M.grade, Grade::verified);
  EXPECT_NEAR(*M.margin, 0.2, 1e-15);  // ω², of the mean
  EXPECT_EQ(find(c, "γ ≥ 0").grade, Grade::by_structure);
  EXPECT_EQ(find(c, "V is untouched by the damping").grade, Grade::by_structure);
  EXPECT_EQ(find(c, "sym(P_H D) ⪰ 0").grade, Grade::verified);
  EXPECT_GT(*find(c, "V + C > 0").margin, 0);
  EXPECT_TRUE(c.law.promised);
  EXPECT_THAT(c.theorem, HasSubstr("modified energy"));
}

TEST(Certificate, NamesTheModeThatMakesMIndefinite) {
  Problem p = klein_gordon_case();
  p.M(0, 0) += Stencil::identity(-0.5);  // ω² = −0.3: the mean, and no oscillating mode
  const Certificate c = certify(p, {.t_end = 50});
  const Hypothesis M = find(c, "M ⪰ 0");
  EXPECT_EQ(M.grade, Grade::violated);
  EXPECT_NEAR(*M.margin, -0.3, 1e-15);
  EXPECT_THAT(M.witness, HasSubstr("mode k = (0), z = (u: 1, v: 0)"));
  EXPECT_FALSE(c.law.promised);
  EXPECT_EQ(c.theorem, "");
}

TEST(Certificate, NamesTheTimeAtWhichARateIsNegative) {
  Problem p = klein_gordon_case();
  p.damping.rate = formula_rate(compile_formula("0.5 - 0.1*t", {"t"}));
  const Hypothesis rate = find(certify(p, {.t_end = 50}), "γ ≥ 0");
  EXPECT_EQ(rate.grade, Grade::violated);
  const double t = std::stod(rate.witness.substr(4));
  EXPECT_LT(p.damping.rate->value(t), 0);
  EXPECT_EQ(find(certify(p, {.t_end = 4}), "γ ≥ 0").grade, Grade::sampled);
}

// σ = 1 and a large amplitude: the exact energy rises at the start, and falls where it is small.
TEST(Certificate, FollowsASolutionWhereStructureDecidesNothing) {
  const std::string condition = "sym(P_H D) ⪰ 0";
  const Certificate large = certify(gkdv_case(0.5, 1.0, 3.0), {.t_end = 5});
  EXPECT_EQ(find(large, condition).grade, Grade::violated);
  const double t = std::stod(find(large, condition).witness.substr(4));
  const Reference reference = make_reference(gkdv_case(0.5, 1.0, 3.0), {0, t, t + 1e-3});
  EXPECT_GT(reference.energy(2), reference.energy(1)) << "the exact energy rises at the witness";
  EXPECT_FALSE(large.law.promised);
  EXPECT_EQ(find(large, "V is untouched by the damping").witness, "field u");
  const Certificate small = certify(gkdv_case(0.5, 0.001), {.t_end = 5});
  EXPECT_EQ(find(small, condition).grade, Grade::sampled);
  EXPECT_GT(*find(small, condition).margin, 0);
  EXPECT_EQ(find(certify(gkdv_case(0.5, -1.0), {.t_end = 5}), condition).grade, Grade::by_structure);
}

TEST(Certificate, DoesNotClaimWhatARateThatVariesInSpaceLeavesOpen) {
  const Problem p =
      nls({.kappa = -1.0, .gamma = formula_space_rate(compile_formula("1 + sin(x)", {"t", "x"}), 1, false)});
  const Hypothesis MD = find(certify(p, {.t_end = 1, .sample_solution = false}), "sym(MD) ⪰ 0");
  EXPECT_EQ(MD.grade, Grade::sampled);
  EXPECT_THAT(MD.statement, HasSubstr("not decided"));
}

TEST(Certificate, PromisesTheLawExactlyWhereTheRunDoes) {
  for (const auto& [name, problem] : all_cases()) {
    const Certificate c =
        certify(problem, {.method = problem.structure ? "egc4" : "seavf", .t_end = 1, .sample_solution = false});
    EXPECT_EQ(c.law.promised, promise_energy_law(problem, 1).promised) << name;
    EXPECT_EQ(c.theorem.empty(), !c.law.promised) << name;
    const bool violated = std::any_of(c.hypotheses.begin(), c.hypotheses.end(), [](const Hypothesis& f) {
      return f.grade == Grade::violated && f.name != "V is untouched by the damping" && f.name != "D(t)D(s) = D(s)D(t)";
    });
    EXPECT_FALSE(violated && c.law.promised) << name;
  }
}

TEST(Certificate, StopsWhenAsked) {
  const std::atomic<bool> stop = true;
  EXPECT_EQ(error_of([&] { certify(gkdv_case(), {.t_end = 1, .stop = &stop}); }), "interrupted");
}

// zᵀMDz < 0 for M = (1, 0.9; 0.9, 1) and D = diag(0, 1): where the components have opposite signs, and nowhere else.
TEST(Certificate, AWitnessOfAMatrixHasItsSigns) {
  const RunSpec spec = parse_case(
      "[problem]\nname = \"custom\"\nfields = [\"a\", \"b\"]\nM = [[1, 0.9], [0.9, 1]]\nD = [[0, 0], [0, 1]]\n"
      "initial = { a = 1, b = 0 }\n",
      "x.toml");
  const Problem p = make_problem(spec);
  const Certificate certificate = certify(p, {.method = "egc4", .t_end = 1, .sample_solution = false});
  const auto MD = std::find_if(certificate.hypotheses.begin(), certificate.hypotheses.end(),
                               [](const Hypothesis& h) { return h.grade == Grade::violated; });
  ASSERT_NE(MD, certificate.hypotheses.end());
  EXPECT_THAT(MD->witness, HasSubstr("z = (a: 0.934, b: -0.358), where it is -0.172681"));
}

// D = diag(0, γ − 0.1) from a constant part that feeds and a constant rate that makes up for it; one that changes is
// judged alone.
TEST(Certificate, PartsOfAConstantDampingAreJudgedTogether) {
  const auto promised = [](bool by_matrices, const RatePointer& gamma) {
    Problem p = by_matrices ? truss({.panels = 3}) : klein_gordon_case();
    p.damping = {.constant = BlockStencil(2), .rate = gamma, .rate_fields = {false, true}};
    if (by_matrices) {
      p.damping.rate_fields = {false, false, true, true};
      SparseOperators matrices = *p.matrices;
      matrices.D.resize(p.size(), p.size());
      for (Index i = p.size() / 2; i < p.size(); ++i) matrices.D.insert(i, i) = -0.1;
      p.matrices = std::make_shared<SparseOperators>(matrices);
    } else {
      p.damping.constant(1, 1) += Stencil::identity(-0.1);
    }
    return promise_energy_law(p, 1).promised;
  };
  for (const bool by_matrices : {false, true}) {
    EXPECT_TRUE(promised(by_matrices, constant_rate(0.2)));
    EXPECT_TRUE(promised(by_matrices, constant_rate(0.1)));
    EXPECT_FALSE(promised(by_matrices, constant_rate(0.05)));
    EXPECT_FALSE(promised(by_matrices, formula_rate(compile_formula("0.2 + 0.01*sin(t)", {"t"}))));
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
