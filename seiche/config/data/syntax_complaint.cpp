#include <seiche/config/data/syntax_complaint.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/characters.hpp>

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
  return trimmed(line.substr(begin, end - begin));
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
  if (value.empty() || value.find_first_of("\"'={}[]") != std::string_view::npos) return false;
  const bool is_text =
      std::any_of(value.begin(), value.end(), is_letter) || value.find_first_of("/*^(") != std::string_view::npos;
  return is_text && value.find_first_not_of("0123456789.eE+-_") != std::string_view::npos && !is_toml_value(value);
}

bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789.eE+-_") == std::string_view::npos;
}

std::string in_quotes(std::string_view value) {
  constexpr std::size_t longest_quoted = 40;
  constexpr std::string_view rule = "names, fractions and formulas stand in quotes";
  return value.size() <= longest_quoted ? fmt::format("{}: \"{}\"", rule, value) : std::string(rule);
}

// What one wrote who thinks of JSON, YAML or Python, or forgot a quote; "" for another.
std::string mistake_in(std::string_view line) {
  line = trimmed(line.substr(0, line.find('#')));
  const std::size_t equals = line.find('='), colon = line.find(':');
  if (line.starts_with('{')) return "this is not TOML but looks like JSON: write [problem], and below it key = value";
  if (colon < equals && !line.starts_with('[')) {
    const std::string_view key = trimmed(line.substr(0, colon)), value = trimmed(line.substr(colon + 1));
    return fmt::format("a key and its value are joined by = and not by a colon: {} = {}", shortened(key, 40),
                       value.empty() ? "…" : shortened(value, 40));
  }
  for (const std::string_view quote : {"“", "”", "„", "«", "»", "‘", "’"})
    if (line.find(quote) != std::string_view::npos)
      return fmt::format("the quotes {} are not those of TOML: write straight ones, \"…\"", quote);
  if (equals == std::string_view::npos) return "";
  const std::string_view value = trimmed(line.substr(equals + 1));
  if (value.starts_with('"') && !value.starts_with("\"\"\"") && std::count(value.begin(), value.end(), '"') == 1)
    return "the text is not closed: a \" is missing at its end";
  if (const std::size_t comma = value.find(','); comma != std::string_view::npos && is_number(value.substr(0, comma)) &&
                                                 is_number(trimmed(value.substr(comma + 1))))
    return fmt::format("decimals are written with a point: {}.{}", value.substr(0, comma),
                       trimmed(value.substr(comma + 1)));
  return "";
}

}  // namespace

std::string syntax_complaint(std::string_view text, std::string_view said, std::size_t line, std::size_t column) {
  constexpr std::string_view preamble = "Error while parsing ";
  if (said.starts_with(preamble)) said.remove_prefix(preamble.size());
  const std::string_view whole = line_of(text, line);
  const std::string place = whole.empty() ? "" : fmt::format(", in `{}`", shortened(whole));
  if (const std::string mistake = mistake_in(whole); !mistake.empty()) return mistake + place;
  const std::string_view value = value_around(whole, column);
  const std::string sentence = shortened(said, 160) + place;
  if (said.find("cannot redefine existing table") != std::string_view::npos)
    return sentence + "; a section stands once, with all of its keys";
  if (value == "True" || value == "False")
    return sentence + "; true and false are in lower case, and " + in_quotes("on");
  return is_bare_text(value) ? fmt::format("{}; {}", sentence, in_quotes(value)) : sentence;
}

}  // namespace seiche
