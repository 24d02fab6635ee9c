#include <seiche/core/error.hpp>
#include <seiche/figure/html.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>

namespace seiche {

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
  const std::string text = fmt::format("{:.2e}", value);
  const std::size_t e = text.find('e');
  std::string mantissa = text.substr(0, e);
  if (mantissa.front() == '-') mantissa.replace(0, 1, "−");
  const int exponent = std::stoi(text.substr(e + 1));
  return fmt::format("{}·10<sup>{}{}</sup>", mantissa, exponent < 0 ? "−" : "", std::abs(exponent));
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
