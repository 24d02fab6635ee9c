#include <seiche/core/base/error.hpp>
#include <seiche/core/text/characters.hpp>
#include <seiche/figure/html.hpp>

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>

namespace seiche {
namespace {

// "-1.42e-05" as −1.42·10⁻⁵, "1e-15" as 10⁻¹⁵.
std::string power_of_ten(const std::string& scientific) {
  const std::size_t e = scientific.find('e');
  std::string mantissa = scientific.substr(0, e);
  const int exponent = std::stoi(scientific.substr(e + 1));
  if (mantissa.front() == '-') mantissa.replace(0, 1, "−");
  const std::string factor = mantissa == "1" ? "" : mantissa + "·";
  return fmt::format("{}10<sup>{}{}</sup>", factor, exponent < 0 ? "−" : "", std::abs(exponent));
}

bool is_part_of_a_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; }

// Length of the number in scientific notation that begins at `begin`; 0 where none begins, or if it is part of a word.
std::size_t scientific_number(std::string_view text, std::size_t begin) {
  if (begin > 0 && (is_part_of_a_word(text[begin - 1]) || text[begin - 1] == '-')) return 0;
  std::size_t at = begin;
  const auto digits = [&] {
    const std::size_t first = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return at > first;
  };
  const auto skip = [&](std::string_view any) {
    const bool found = at < text.size() && any.find(text[at]) != std::string_view::npos;
    if (found) ++at;
    return found;
  };
  skip("-");
  if (!digits() || (skip(".") && !digits()) || !skip("e")) return 0;
  skip("+-");
  const std::size_t exponent = at;
  if (!digits() || at - exponent > 3) return 0;
  const bool ends = at == text.size() || !is_part_of_a_word(text[at]) || text[at] == '.';
  return ends ? at - begin : 0;
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&': escaped += "&amp;"; break;
      case '<': escaped += "&lt;"; break;
      case '>': escaped += "&gt;"; break;
      case '"': escaped += "&quot;"; break;
      case '\'': escaped += "&#39;"; break;
      default: escaped += c;
    }
  }
  return escaped;
}

std::string html_number(double value) {
  if (!std::isfinite(value)) return "—";
  if (value == 0) return "0";
  return power_of_ten(fmt::format("{:.2e}", value));
}

std::string html_text(std::string_view text) {
  std::string result;
  std::size_t done = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = scientific_number(text, at);
    if (length == 0) {
      ++at;
      continue;
    }
    result += html_escaped(text.substr(done, at - done));
    result += "<span class=\"number\">" + power_of_ten(std::string(text.substr(at, length))) + "</span>";
    done = at += length;
  }
  return result + html_escaped(text.substr(done));
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? letters[group >> (6 * (3 - k)) & 63U] : '=';
    }
  }
  return text;
}

PngPicture read_png(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error("cannot read {}", path.string());
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  constexpr std::size_t header = 24;  // up to width and height
  if (bytes.size() < header || !bytes.starts_with("\x89PNG\r\n\x1a\n")) throw Error("{} is not a PNG", path.string());
  const auto big_endian = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
    return value;
  };
  return {"data:image/png;base64," + base64(bytes), big_endian(16), big_endian(20)};
}

}  // namespace seiche
