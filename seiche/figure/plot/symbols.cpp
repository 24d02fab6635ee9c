#include <seiche/figure/gnuplot.hpp>
#include <seiche/figure/plot/style.hpp>
#include <seiche/figure/plot/symbols.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace seiche {
namespace {

// Without o, which is a Latin letter to the eye.
constexpr auto greek = std::to_array<std::pair<std::string_view, std::string_view>>(
    {{"alpha", "α"},   {"beta", "β"},  {"gamma", "γ"}, {"delta", "δ"}, {"epsilon", "ε"}, {"zeta", "ζ"},
     {"eta", "η"},     {"theta", "θ"}, {"iota", "ι"},  {"kappa", "κ"}, {"lambda", "λ"},  {"mu", "μ"},
     {"nu", "ν"},      {"xi", "ξ"},    {"pi", "π"},    {"rho", "ρ"},   {"sigma", "σ"},   {"tau", "τ"},
     {"upsilon", "υ"}, {"phi", "φ"},   {"chi", "χ"},   {"psi", "ψ"},   {"omega", "ω"}});

// What comes behind a single letter, where it is an index: l1, px.
std::string_view index_of(std::string_view name) {
  const std::string_view rest = name.substr(1);
  const bool digits = std::all_of(rest.begin(), rest.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  return digits || rest == "x" || rest == "y" || rest == "z" ? rest : std::string_view();
}

}  // namespace

std::string in_text(std::string_view name) {
  for (const auto& [word, letter] : greek)
    if (word == name) return std::string(letter);
  if (name.empty()) return "";
  const std::string_view index = index_of(name);
  if (index.empty() || std::isdigit(static_cast<unsigned char>(index[0])) == 0) return std::string(name);
  constexpr std::array<std::string_view, 10> digits = {"₀", "₁", "₂", "₃", "₄", "₅", "₆", "₇", "₈", "₉"};
  std::string text(1, name[0]);
  for (const char c : index) text += digits[static_cast<std::size_t>(c - '0')];
  return text;
}

std::string symbol(std::string_view name) {
  for (const auto& [word, letter] : greek)
    if (word == name) return fmt::format("'{{/:Italic {}}}'", letter);
  if (name.empty()) return "''";
  const std::string_view index = index_of(name);
  const std::string_view letter = name.substr(0, name.size() - index.size());
  std::string text = "'{/:Italic ' . " + gnuplot_text(letter) + " . '}'";
  if (!index.empty()) text += " . '_{' . " + gnuplot_text(index) + " . '}'";
  return "(" + text + ")";
}

std::string labelled(std::string_view meaning, std::string_view name) {
  constexpr double room = 1.4;  // inches along an axis
  if (meaning.empty() || meaning.starts_with("field ") || text_width(meaning, 7) > room) return symbol(name);
  return fmt::format("({} . {})", gnuplot_text(fmt::format("{} ", meaning)), symbol(name));
}

std::string axis_label(const std::string& name) { return name == "point" ? "'point'" : symbol(name); }

std::string at_time(double t) { return fmt::format("'{{/:Italic t}} = {:.4g}'", t); }

}  // namespace seiche
