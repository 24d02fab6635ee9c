// Parts of pictures and pages by themselves: styles of methods, text and numbers in HTML.
#include <seiche/figure/curves.hpp>
#include <seiche/figure/html.hpp>
#include <seiche/figure/style.hpp>
#include <seiche/method/methods.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace seiche {
namespace TEST_FILE {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(MethodStyle, EveryMethodThatHasAStyleLooksLikeNoOther) {
  std::set<std::string> colours;
  std::set<std::tuple<std::string, Marker, bool>> shapes;
  for (const MethodEntry& method : methods()) {
    const MethodStyle* style = find_method_style(method.name);
    if (style == nullptr) continue;  // drawn by the default
    EXPECT_NE(style->line.marker, Marker::none) << method.name;
    EXPECT_TRUE(colours.insert(style->line.colour).second) << method.name;
    const bool one_step = method.kind.make_base != nullptr;
    const bool collocation = method.projects() && !one_step;
    const char* kind = collocation ? "long dashes" : one_step ? "dots" : "";
    EXPECT_TRUE(shapes.insert({kind, style->line.marker, style->line.filled}).second) << method.name;
    const bool exponential = method.propagator == PropagatorKind::exponential;
    EXPECT_EQ(style->line.filled, exponential) << method.name;
    EXPECT_EQ(style->line.dash == Dash::solid, exponential && !method.projects()) << method.name;
    EXPECT_EQ(style->line.dash == Dash::long_dashed, collocation) << method.name;
    EXPECT_EQ(exponential && style->line.dash == Dash::dotted, one_step) << method.name;
    EXPECT_EQ(style->proposed, method.name == "seisav" || method.name == "seilm");
  }
  EXPECT_GE(colours.size(), 23U);
  EXPECT_EQ(method_label("seisav"), "SEISAV");
  EXPECT_EQ(method_label("own_method"), "own_method");
  EXPECT_FALSE(method_line("own_method").colour.empty());
  EXPECT_EQ(method_of_curve("SEILM, V transported"), "seilm");
  EXPECT_EQ(method_of_curve("seisavage"), "");
}

TEST(MethodStyle, ASchemeAsPrintedIsGreyAndDottedInWhateverCompany) {
  const LineStyle third = curve_line("SEILM as printed (V frozen, Newton)", 2, 0);
  const LineStyle second = curve_line("SEILM as printed (V frozen, Newton)", 1, 4);
  for (const LineStyle& line : {third, second}) {
    EXPECT_EQ(line.colour, "#808080");
    EXPECT_EQ(line.dash, Dash::dotted);
  }
  EXPECT_EQ(curve_line("SEILM, V transported, Newton", 1, 0).colour, method_line("seilm").colour);
}

TEST(StepText, IsAPowerOfTwoWhereItIsOneAndHasItsExponentRaised) {
  EXPECT_EQ(step_text(0.00390625), "2⁻⁸");
  EXPECT_EQ(step_text(2), "2¹");
  EXPECT_EQ(step_text(0.05), "0.05");
  EXPECT_EQ(step_text(1e-8), "10⁻⁸");
  EXPECT_EQ(step_text(2.5e-7), "2.5·10⁻⁷");
}

TEST(Html, TextIsEscapedNumbersAreSetAndBytesAreEncoded) {
  EXPECT_EQ(html_escaped("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
  EXPECT_EQ(html_number(1.42e-5), "1.42·10<sup>−5</sup>");
  EXPECT_EQ(html_number(-3e7), "−3.00·10<sup>7</sup>");
  EXPECT_EQ(html_number(nan), "—");
  const std::string tenth = "<span class=\"number\">−7.3·10<sup>−6</sup></span>";
  EXPECT_EQ(html_text("gkdv -7.3e-06; a<b"), "gkdv " + tenth + "; a&lt;b");
  EXPECT_EQ(html_text("|V| < 1e-15."), "|V| &lt; <span class=\"number\">10<sup>−15</sup></span>.");
  EXPECT_EQ(html_text("4e+05"), "<span class=\"number\">4·10<sup>5</sup></span>");
  for (const char* plain : {"2.1e", "x1e5", "1e5x", "a_1e-3", "0.5", "-3", "e-06", "1.e5", ""}) {
    EXPECT_EQ(html_text(plain), plain);
  }
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

}  // namespace TEST_FILE
}  // namespace seiche
