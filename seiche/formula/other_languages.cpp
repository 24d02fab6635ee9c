#include <seiche/core/text/characters.hpp>
#include <seiche/formula/other_languages.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace seiche {
namespace {

using Entry = std::pair<std::string_view, std::string_view>;

template <std::size_t N>
std::string_view second_of(const std::array<Entry, N>& table, std::string_view first) {
  const auto* found =
      std::find_if(table.begin(), table.end(), [&](const Entry& entry) { return entry.first == first; });
  return found == table.end() ? std::string_view() : found->second;
}

constexpr std::string_view switching = "a switch is written with step: step(x - 1) is 0 before x = 1 and 1 behind it";

constexpr std::array<Entry, 46> names_elsewhere = {{
    {"e", "write exp(1)"},
    {"ln", "write log( )"},
    {"log10", "write log( )/log(10)"},
    {"log2", "write log( )/log(2)"},
    {"exp2", "write 2^( )"},
    {"pow", "write a^b"},
    {"power", "write a^b"},
    {"square", "write ( )^2"},
    {"cbrt", "write ( )^(1/3)"},
    {"fabs", "write abs( )"},
    {"Abs", "write abs( )"},
    {"sgn", "write sign( )"},
    {"sec", "write 1/cos( )"},
    {"csc", "write 1/sin( )"},
    {"cot", "write 1/tan( )"},
    {"coth", "write 1/tanh( )"},
    {"csch", "write 1/sinh( )"},
    {"arcsin", "write asin( )"},
    {"arccos", "write acos( )"},
    {"arctan", "write atan( )"},
    {"arcsinh", "write asinh( )"},
    {"arccosh", "write acosh( )"},
    {"arctanh", "write atanh( )"},
    {"arsinh", "write asinh( )"},
    {"arcosh", "write acosh( )"},
    {"artanh", "write atanh( )"},
    {"maximum", "write max( , )"},
    {"minimum", "write min( , )"},
    {"fmax", "write max( , )"},
    {"fmin", "write min( , )"},
    {"heaviside", "write step( )"},
    {"Heaviside", "write step( )"},
    {"where", switching},
    {"piecewise", switching},
    {"Piecewise", switching},
    {"if", switching},
    {"else", switching},
    {"and", switching},
    {"or", switching},
    {"nan", "numbers in formulas are finite"},
    {"inf", "numbers in formulas are finite"},
    {"infinity", "numbers in formulas are finite"},
    {"conj", "formulas are real, and a complex field is two real ones"},
    {"real", "formulas are real, and a complex field is two real ones"},
    {"imag", "formulas are real, and a complex field is two real ones"},
    {"rand", "numbers by chance are drawn in [ensemble]"},
}};

constexpr std::array<Entry, 28> characters_elsewhere = {{
    {"=", "; a formula is a value, not an equation"},
    {"[", "; write ( )"},
    {"{", "; write ( )"},
    {";", "; write , between arguments"},
    {"·", "; write *"},
    {"×", "; write *"},
    {"÷", "; write /"},
    {"−", "; write -"},
    {"⁰", "; write ^0"},
    {"¹", "; write ^1"},
    {"²", "; write ^2"},
    {"³", "; write ^3"},
    {"⁴", "; write ^4"},
    {"⁵", "; write ^5"},
    {"⁶", "; write ^6"},
    {"½", "; write 1/2"},
    {"¼", "; write 1/4"},
    {"√", "; write sqrt( )"},
    {"|", "; write abs( )"},
    {"\\", "; formulas are not LaTeX: write a/b, sqrt( ), alpha*u"},
    {"∂", "; derivatives are written u_x in an energy, and d_x in S, M and D"},
    {"∇", "; derivatives are written u_x in an energy, and d_x in S, M and D"},
    {"Δ", "; write laplacian in S, M and D, and u_x or u_xx in an energy"},
    {"∞", "; numbers in formulas are finite"},
    {"∫", "; an energy is given per point, and its sum is taken"},
    {"∑", "; an energy is given per point, and its sum is taken"},
    {"Σ", "; an energy is given per point, and its sum is taken"},
    {"π", "; write pi"},
}};

constexpr std::array<std::string_view, 7> comparisons = {"≤", "≥", "<", ">", ":", "&", "!"};

constexpr std::array<Entry, 24> greek_letters = {{
    {"α", "alpha"}, {"β", "beta"}, {"γ", "gamma"}, {"δ", "delta"}, {"ε", "epsilon"}, {"ϵ", "epsilon"},
    {"ζ", "zeta"},  {"η", "eta"},  {"θ", "theta"}, {"κ", "kappa"}, {"λ", "lambda"},  {"μ", "mu"},
    {"µ", "mu"},    {"ν", "nu"},   {"ξ", "xi"},    {"ρ", "rho"},   {"σ", "sigma"},   {"τ", "tau"},
    {"φ", "phi"},   {"ϕ", "phi"},  {"χ", "chi"},   {"ψ", "psi"},   {"ω", "omega"},   {"Ω", "Omega"},
}};

std::string_view name_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && begins_name(text[end])) ++end;
  return text.substr(at, end - at);
}

// np.sin and a.*b
std::string advice_on_dot(std::string_view text, std::size_t at, std::string_view name_before) {
  const std::string_view behind = text.substr(at + 1);
  if (!name_before.empty() && !behind.empty() && begins_name(behind.front()))
    return fmt::format("; functions stand without a module: write {}", name_at(behind, 0));
  if (!behind.empty() && (behind.front() == '*' || behind.front() == '/' || behind.front() == '^'))
    return fmt::format("; every formula is that of one point: write {}", behind.front());
  return "";
}

}  // namespace

std::string_view spelling_here(std::string_view name) { return second_of(names_elsewhere, name); }

std::string advice_on_character(std::string_view text, std::size_t at, std::string_view character,
                                std::string_view name_before, const std::vector<std::string>& names) {
  if (character == ".") return advice_on_dot(text, at, name_before);
  if (character == "'" || character == "′") {
    const std::string derivative = fmt::format("{}_x", name_before);
    const bool known = std::find(names.begin(), names.end(), derivative) != names.end();
    return known ? fmt::format("; the derivative of {} along x is {}", name_before, derivative) : "";
  }
  if (const std::string_view letter = second_of(greek_letters, character); !letter.empty())
    return fmt::format("; names are in Latin letters: write {}", letter);
  const bool chooses = character == "?" && text.find(':', at) != std::string_view::npos;
  if (chooses || std::find(comparisons.begin(), comparisons.end(), character) != comparisons.end())
    return fmt::format("; {}", switching);
  return std::string(second_of(characters_elsewhere, character));
}

}  // namespace seiche
