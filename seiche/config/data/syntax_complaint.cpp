#include <seiche/config/data/syntax_complaint.hpp>
#include <seiche/core/text/shortened.hpp>

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

namespace seiche {
namespace {

std::string_view line_of(std::string_view text, std::size_t number) {
  for (std::size_t line = 1; line < number && !text.empty(); ++line)
    text.remove_prefix(std::min(text.size(), text.find('\n') + 1));
  return text.substr(0, text.find_first_of("\r\n"));
}

// The value there, behind "key = ", or in a list or table behind that.
std::string_view value_around(std::string_view line, std::size_t column) {
  const std::size_t at = std::min(line.size(), column > 0 ? column - 1 : 0);
  const std::size_t before = line.substr(0, at).find_last_of("=,[{");
  if (before == std::string_view::npos || line.substr(0, before + 1).find('=') == std::string_view::npos) return "";
  const std::size_t begin = before + 1;
  const bool is_inside = line.substr(0, begin).find_first_of("[{") != std::string_view::npos;
  const std::size_t end = std::min(line.find_first_of(is_inside ? "#,]}" : "#", std::max(begin, at)), line.size());
  const std::string_view value = line.substr(begin, end - begin);
  const std::size_t first = std::min(value.find_first_not_of(" \t"), value.size());
  return value.substr(first, value.find_last_not_of(" \t") - first + 1);
}

bool is_toml_value(std::string_view text) {
  try {
    return toml::parse(fmt::format("value = {}", text)).size() == 1;
  } catch (const toml::parse_error&) {
    return false;
  }
}

// A name, a fraction or a formula, without the quotes that it needs.
bool is_bare_text(std::string_view value) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  if (value.empty() || value.find_first_of("\"'={}[]") != std::string_view::npos) return false;
  const bool is_text =
      std::any_of(value.begin(), value.end(), is_letter) || value.find_first_of("/*^(") != std::string_view::npos;
  return is_text && value.find_first_not_of("0123456789.eE+-_") != std::string_view::npos && !is_toml_value(value);
}

}  // namespace

std::string syntax_complaint(std::string_view text, std::string_view said, std::size_t line, std::size_t column) {
  constexpr std::string_view preamble = "Error while parsing ";
  if (said.starts_with(preamble)) said.remove_prefix(preamble.size());
  const std::string_view whole = line_of(text, line);
  const std::string_view value = value_around(whole, column);
  std::string sentence = shortened(said, 160);
  if (!whole.empty()) sentence += fmt::format(", in `{}`", shortened(whole));
  if (!is_bare_text(value)) return sentence;
  constexpr std::size_t longest_quoted = 40;
  sentence += "; names, fractions and formulas stand in quotes";
  return value.size() <= longest_quoted ? sentence + fmt::format(": \"{}\"", value) : sentence;
}

}  // namespace seiche
