#include <seiche/config/data/case_value.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/characters.hpp>
#include <seiche/formula/formula_compiler.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

std::size_t digits_at(std::string_view text, std::size_t at) {
  std::size_t count = 0;
  while (at + count < text.size() && is_digit(text[at + count])) ++count;
  return count;
}

}  // namespace

std::string CaseValue::shown() const { return kind == Kind::text ? fmt::format("\"{}\"", shortened(text)) : text; }

double read_number(std::string_view key, const CaseValue& value) {
  if (value.kind == CaseValue::Kind::number) {
    if (!std::isfinite(value.number)) throw Error("{} = {} must be a finite number", key, value.shown());
    return value.number;
  }
  if (value.kind != CaseValue::Kind::text)
    throw Error("{} = {} must be a number, or a fraction in quotes such as \"1/256\"", key, value.shown());

  const std::string text(trimmed(value.text));
  std::string bare = text.substr(text.find_first_not_of("+-") == std::string::npos ? 0 : text.find_first_not_of("+-"));
  std::transform(bare.begin(), bare.end(), bare.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  if (bare == "nan" || bare == "inf" || bare == "infinity")
    throw Error("{} = {} must be a finite number", key, value.shown());
  try {
    return (*compile_formula(text, {}))({});
  } catch (const Error& error) {
    const bool meant_as_number = text.find_first_of("0123456789(") != std::string::npos;
    throw Error("{} = {} must be a finite number, or a fraction in quotes such as \"1/256\"{}{}", key, value.shown(),
                meant_as_number ? ": " : "", meant_as_number ? error.what() : "");
  }
}

long read_whole(std::string_view key, const CaseValue& value, long minimum) {
  constexpr double largest = 9007199254740992.0;  // 2⁵³: above, doubles skip whole numbers
  const double number = read_number(key, value);
  if (number != std::floor(number) || std::abs(number) > largest)
    throw Error("{} = {} must be a whole number", key, value.shown());
  if (number < static_cast<double>(minimum)) throw Error("{} = {} must be ≥ {}", key, value.shown(), minimum);
  return static_cast<long>(number);
}

std::string read_text(std::string_view key, const CaseValue& value) {
  if (value.kind == CaseValue::Kind::text) return value.text;
  if (!value.given.empty()) return value.given;  // --set output.directory=2024
  throw Error("{} = {} must be a text in quotes", key, value.shown());
}

std::string read_name(std::string_view key, const CaseValue& value, const std::vector<std::string>& names) {
  std::string name = read_text(key, value);
  if (std::find(names.begin(), names.end(), name) == names.end()) throw unknown_name(key, name, names);
  return name;
}

bool is_toml_number(std::string_view text) {
  std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const std::size_t whole = digits_at(text, at);
  if (whole == 0 || (whole > 1 && text[at] == '0')) return false;
  if (whole > 15) return false;  // TOML's integers end at 2⁶³
  at += whole;
  if (at < text.size() && text[at] == '.') {
    const std::size_t fraction = digits_at(text, at + 1);
    if (fraction == 0) return false;
    at += 1 + fraction;
  }
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
    const std::size_t exponent = digits_at(text, at);
    if (exponent == 0) return false;
    at += exponent;
  }
  return at == text.size();
}

std::string toml_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (code < 0x20U || code == 0x7FU) {
      quoted += fmt::format("\\u{:04X}", code);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

}  // namespace seiche
