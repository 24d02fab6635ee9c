#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/characters.hpp>
#include <seiche/formula/formula_text.hpp>
#include <seiche/formula/other_languages.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace seiche {
namespace {

using TokenKind = FormulaToken::Kind;

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }  // in UTF-8

std::size_t characters(std::string_view text) {
  return text.size() - static_cast<std::size_t>(std::count_if(text.begin(), text.end(), continues_character));
}

std::size_t end_of_character(std::string_view text, std::size_t position) {
  ++position;
  while (position < text.size() && continues_character(text[position])) ++position;
  return position;
}

// digits [. digits] [e [±] digits]; an e that no digits follow is the start of a name.
std::size_t end_of_number(std::string_view text, std::size_t at) {
  const auto skip_digits = [&](std::size_t i) {
    while (i < text.size() && is_digit(text[i])) ++i;
    return i;
  };
  at = skip_digits(at);
  if (at < text.size() && text[at] == '.') at = skip_digits(at + 1);
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t digits = at + 1;
    if (digits < text.size() && (text[digits] == '+' || text[digits] == '-')) ++digits;
    if (digits < text.size() && is_digit(text[digits])) at = skip_digits(digits);
  }
  return at;
}

FormulaToken number_token(std::string_view text, std::size_t begin, std::size_t end) {
  const std::string_view digits = text.substr(begin, end - begin);
  double value = 0.0;
  const auto [rest, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (status == std::errc::result_out_of_range || !std::isfinite(value))
    throw formula_error(text, begin, fmt::format("{} is too large or too small for a double", shortened(digits)));
  if (status != std::errc() || rest != digits.data() + digits.size())
    throw formula_error(text, begin, fmt::format("'{}' is not a number", shortened(digits)));
  return {.kind = TokenKind::number, .text = digits, .position = begin, .value = value};
}

}  // namespace

Error formula_error(std::string_view text, std::size_t position, std::string_view sentence) {
  constexpr std::size_t reach = 24;  // bytes shown on either side
  std::size_t begin = position > reach ? position - reach : 0;
  while (begin > 0 && continues_character(text[begin])) --begin;
  std::size_t end = std::min(text.size(), position + reach);
  while (end < text.size() && continues_character(text[end])) ++end;

  return Error("formula, column {}: {} (in \"{}{}{}\")", characters(text.substr(0, position)) + 1, sentence,
               begin > 0 ? "…" : "", shortened(text.substr(begin, end - begin), 2 * reach + 8),
               end < text.size() ? "…" : "");
}

std::string hint_on_neighbours(std::string_view whole_name, const std::vector<std::string>& names) {
  const std::string name = shortened(whole_name);  // a longer one is not among them
  const auto known = [&](const std::string& other) {
    return std::find(names.begin(), names.end(), other) != names.end();
  };
  if (known(fmt::format("d{}", name)))
    return fmt::format("d{0} is the difference to the next point, {0}_{{j+1}} − {0}_j", name);
  return known(fmt::format("{}_x", name)) ? fmt::format("{0}_x is its derivative along x", name) : "";
}

std::vector<FormulaToken> tokenise_formula(std::string_view text, const std::vector<std::string>& names) {
  if (text.size() > longest_formula)
    throw Error("a formula of {} characters is too long: at most {} are read", text.size(), longest_formula);

  std::vector<FormulaToken> tokens;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t begin = at;
    const char c = text[at];
    if (is_space(c)) {
      ++at;
    } else if (is_digit(c) || (c == '.' && at + 1 < text.size() && is_digit(text[at + 1]))) {
      at = end_of_number(text, at);
      tokens.push_back(number_token(text, begin, at));
    } else if (begins_name(c)) {
      while (at < text.size() && (begins_name(text[at]) || is_digit(text[at]))) ++at;
      tokens.push_back({.kind = TokenKind::name, .text = text.substr(begin, at - begin), .position = begin});
    } else if (text.substr(at, 2) == "**") {
      throw formula_error(text, at, "a power is written with ^, not **");
    } else if (std::string_view("+-*/^(),").find(c) != std::string_view::npos) {
      ++at;
      tokens.push_back({.kind = TokenKind::symbol, .text = text.substr(begin, 1), .position = begin});
    } else {
      const std::string_view character = text.substr(at, end_of_character(text, at) - at);
      const bool shows = static_cast<unsigned char>(c) >= 0x20U && c != 0x7F;
      const std::string_view name_before =
          !tokens.empty() && tokens.back().kind == TokenKind::name ? tokens.back().text : std::string_view();
      if (c == '[' && !name_before.empty())
        if (const std::string hint = hint_on_neighbours(name_before, names); !hint.empty())
          throw formula_error(text, at, fmt::format("{} has no index: {}", shortened(name_before), hint));
      const std::string sign =
          shows ? fmt::format("'{}'", character) : fmt::format("with code {}", static_cast<int>(c));
      throw formula_error(text, at,
                          fmt::format("the character {} has no meaning here{}", sign,
                                      advice_on_character(text, at, character, name_before, names)));
    }
  }
  tokens.push_back({.kind = TokenKind::end, .text = {}, .position = text.size()});
  return tokens;
}

}  // namespace seiche
