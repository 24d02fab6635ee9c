// Parts of pictures and pages by themselves: the triangle of slope two, styles of methods, text and numbers in HTML.
#include <seiche/figure/html.hpp>
#include <seiche/figure/plot/slope_triangle.hpp>
#include <seiche/figure/plot/style.hpp>
#include <seiche/method/methods.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace seiche {
namespace TEST_FILE {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(SlopeTriangle, HasSlopeTwoAndIsClearOfTheCurves) {
  for (const double spread : {1.0, 3.0, 10.0, 1e3, 1e6}) {
    Plot plot;
    std::vector<double> all;
    const std::vector<double> h = {0.03125, 0.015625, 0.0078125, 0.00390625};
    for (int k = 0; k < 3; ++k) {
      Series series{.label = "x", .style = {}, .x = h, .y = {}};
      for (const double step : h) series.y.push_back(step * step * std::pow(spread, k));
      all.insert(all.end(), series.y.begin(), series.y.end());
      plot.series.push_back(series);
    }
    plot.x = step_size_axis(h);
    plot.y = fitted_axis(true, all, 0.1);
    const auto triangle = clear_slope_triangle(plot, 2.7, 1.8);
    ASSERT_TRUE(triangle) << spread;
    EXPECT_NEAR(std::log(triangle->y1 / triangle->y0) / std::log(triangle->x1 / triangle->x0), 2.0, 1e-12);
    EXPECT_GT(plot.x.place(triangle->x0), 0);
    EXPECT_LT(plot.x.place(triangle->x1), 1);
    EXPECT_GT(plot.y.place(triangle->y0), 0);
    EXPECT_LT(plot.y.place(triangle->y1), 1);
    for (int k = 0; k < 3; ++k) {
      // A line h² c passes its corners (x0, y0) and (x1, y1) on one side, the right angle on the same.
      const double c = std::pow(spread, k);
      const auto above = [&](double x, double y) { return y > c * x * x; };
      const bool first = above(triangle->x0, triangle->y0);
      EXPECT_EQ(above(triangle->x1, triangle->y1), first) << spread;
      EXPECT_EQ(above(triangle->x1, triangle->y0), first) << spread;
    }
  }
}

TEST(MethodStyle, EveryMethodThatHasAStyleLooksLikeNoOther) {
  std::set<std::string> colours, shapes;
  for (const MethodEntry& method : methods()) {
    const MethodStyle* style = find_method_style(method.name);
    if (style == nullptr) continue;  // drawn by the default
    EXPECT_NE(style->line.marker, Marker::none) << method.name;
    EXPECT_TRUE(colours.insert(style->line.colour).second) << method.name;
    const bool one_step = method.kind.make_base != nullptr;
    const bool collocation = method.projects() && !one_step;
    const std::string marker = gnuplot_marker({.marker = style->line.marker, .filled = style->line.filled});
    EXPECT_TRUE(shapes.insert(collocation ? "long dashes, " + marker
                              : one_step  ? "dots, " + marker
                                          : marker)
                    .second)
        << method.name;
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
