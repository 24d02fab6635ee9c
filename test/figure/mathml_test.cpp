// Formulas as MathML: what stands for what, and that nothing is lost or left open.
#include <seiche/figure/mathml.hpp>
#include <seiche/problem/problems.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace seiche {
namespace TEST_FILE {

using testing::HasSubstr;

std::string from_case(const std::string& text) { return mathml_part(text, Notation::case_file); }
std::string printed(const std::string& text) { return mathml_part(text, Notation::printed); }

// Every element is closed where it was opened. Returns what stands between the tags.
std::string text_of(const std::string& markup) {
  std::vector<std::string> open;
  std::string text;
  for (std::size_t at = 0; at < markup.size(); ++at) {
    if (markup[at] != '<') {
      text += markup[at];
      continue;
    }
    const std::size_t end = markup.find('>', at);
    const std::string inside = markup.substr(at + 1, end - at - 1);
    if (inside.front() == '/') {
      EXPECT_FALSE(open.empty()) << markup;
      if (open.empty()) return text;
      EXPECT_EQ(inside.substr(1), open.back()) << markup;
      open.pop_back();
    } else if (inside.back() != '/') {
      open.push_back(inside.substr(0, inside.find(' ')));
    }
    at = end;
  }
  EXPECT_TRUE(open.empty()) << markup;
  return text;
}

TEST(MathMl, TakesProductsBeforeAQuotientIntoIt) {
  EXPECT_EQ(from_case("a*b/c"),
            "<mfrac><mrow><mi>a</mi><mo>&#x2062;</mo><mi>b</mi></mrow><mrow><mi>c</mi></mrow></mfrac>");
  EXPECT_EQ(printed("EA/ℓ e"), "<mfrac><mrow><mi>E</mi><mi>A</mi></mrow><mrow><mi>ℓ</mi></mrow></mfrac><mi>e</mi>");
  EXPECT_THAT(from_case("a/b^2"), HasSubstr("<mrow><mi>a</mi></mrow><mrow><msup>"));
}

TEST(MathMl, LeavesOutParenthesesThatAFractionOrARootReplaces) {
  EXPECT_EQ(text_of(from_case("(a + b)/(c - 1)")), "a+bc−1");
  EXPECT_EQ(text_of(from_case("x^(1/3)")), "x13");
  EXPECT_EQ(from_case("sqrt(2)"), "<msqrt><mrow><mn>2</mn></mrow></msqrt>");
  EXPECT_EQ(text_of(from_case("abs(q - 1)")), "|q−1|");
  EXPECT_EQ(text_of(from_case("(a + b)*c")), "(a+b)&#x2062;c") << "a factor keeps them";
}

TEST(MathMl, PutsASignBehindAFactorAndAPowerOfAPowerIntoParentheses) {
  EXPECT_EQ(text_of(from_case("a*-b*q")), "a&#x2062;(−b)&#x2062;q");
  EXPECT_EQ(text_of(from_case("a - -b + +c")), "a−(−b)+(+c)");
  EXPECT_EQ(text_of(from_case("-x^2")), "−x2");
  EXPECT_EQ(text_of(from_case("a/-b")), "a−b") << "a fraction";
  EXPECT_EQ(text_of(from_case("1e3^2")), "(103)2");
  EXPECT_EQ(text_of(from_case("omega_squared^2")), "(ω2)2");
  EXPECT_EQ(text_of(from_case("2^3^x")), "23x") << "to the right, as formulas are read";
}

TEST(MathMl, PutsIndexAndPowerAboveEachOther) {
  const std::string both = "<msubsup><mrow><mi>u</mi></mrow><mrow><mi>x</mi></mrow><mrow><mn>2</mn></mrow></msubsup>";
  EXPECT_EQ(from_case("u_x^2"), both);
  EXPECT_EQ(from_case("u_x**2"), both);
  EXPECT_EQ(printed("u_x²"), both);
}

TEST(MathMl, KnowsNamesOfCaseFiles) {
  EXPECT_EQ(from_case("gamma"), "<mi>γ</mi>");
  EXPECT_EQ(from_case("omega_squared"), "<msup><mi>ω</mi><mn>2</mn></msup>");
  EXPECT_EQ(from_case("stiffness"), "<mi>stiffness</mi>") << "a name stays one";
  EXPECT_EQ(text_of(from_case("q12")), "q12");
  EXPECT_THAT(from_case("q12"), HasSubstr("<msub>"));
  EXPECT_EQ(from_case("1.5e-3"),
            "<mrow><mn>1.5</mn><mo>·</mo><msup><mn>10</mn><mrow><mo>−</mo><mn>3</mn></mrow></msup></mrow>");
}

TEST(MathMl, SetsLettersSideBySideAsAProductAndWordsAsWords) {
  EXPECT_EQ(text_of(printed("γu + iψ")), "γu+iψ");
  EXPECT_EQ(printed("cu"), "<mi>c</mi><mi>u</mi>");
  EXPECT_THAT(printed("u = 0 at both ends"), HasSubstr("<mtext>&#xA0;at&#xA0;both&#xA0;ends</mtext>"));
  EXPECT_THAT(printed("α sin u"), HasSubstr("<mi>sin</mi>"));
}

TEST(MathMl, ClosesWhatItOpensForEveryProblemAndForNonsense) {
  for (const ProblemEntry& problem : problems()) {
    EXPECT_FALSE(problem.title.empty()) << problem.name;
    const std::string text = text_of(mathml(problem.equation, Notation::printed));
    EXPECT_EQ(text.find('_'), std::string::npos) << text;
    EXPECT_EQ(text.find('^'), std::string::npos) << text;
  }
  for (const char* nonsense : {"",   ")",        "((",   "|",  "a|b",  "{",     "^",   "_", "1e", "a/",  "*",
                               "u^", "<script>", "\xc3", "₂²", "sqrt", "sqrt(", "a)b", "]", "--", "e^{", "\xff\xfe"}) {
    for (const Notation notation : {Notation::printed, Notation::case_file}) {
      const std::string markup = mathml(nonsense, notation);
      text_of(markup);
      EXPECT_EQ(markup.find("<script"), std::string::npos);
    }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche
