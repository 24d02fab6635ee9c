#include <seiche/core/base/shortened.hpp>

#include <algorithm>

namespace seiche {
namespace {

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }  // in UTF-8

// How many bytes the character takes that begins with this one, or 0.
std::size_t length_of_character(unsigned char first) {
  if (first < 0x80U) return 1;
  if (first >= 0xC2U && first < 0xE0U) return 2;
  if (first >= 0xE0U && first < 0xF0U) return 3;
  return first >= 0xF0U && first < 0xF5U ? 4 : 0;
}

// Not overlong, no half of a pair of UTF-16, and not above the last character.
bool is_second_byte(unsigned char first, unsigned char second) {
  switch (first) {
    case 0xE0U: return second >= 0xA0U;
    case 0xEDU: return second < 0xA0U;
    case 0xF0U: return second >= 0x90U;
    case 0xF4U: return second < 0x90U;
    default: return true;
  }
}

// Of the character that `text` begins with, or 0 where it begins with none.
std::size_t first_character(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = length_of_character(first);
  if (length == 0 || length > text.size()) return 0;
  if (length > 1 && !is_second_byte(first, static_cast<unsigned char>(text[1]))) return 0;
  const std::string_view rest = text.substr(1, length - 1);
  return std::all_of(rest.begin(), rest.end(), continues_character) ? length : 0;
}

std::string visible(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t length = first_character(text);
    const char c = text.front();
    if (c == '\n' || c == '\r' || c == '\t') {
      shown += ' ';
    } else if (length == 0 || static_cast<unsigned char>(c) < 0x20U || c == 0x7F) {
      shown += '?';
    } else {
      shown += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return shown;
}

// Not inside a character.
std::string_view beginning(std::string_view text, std::size_t most) {
  std::size_t end = std::min(most, text.size());
  while (end > 0 && end < text.size() && continues_character(text[end])) --end;
  return text.substr(0, end);
}

std::string_view ending(std::string_view text, std::size_t most) {
  std::size_t begin = text.size() - std::min(most, text.size());
  while (begin < text.size() && continues_character(text[begin])) ++begin;
  return text.substr(begin);
}

}  // namespace

std::string shortened(std::string_view text, std::size_t most) {
  return text.size() <= most ? visible(text) : visible(beginning(text, most)) + "…";
}

std::string shortened_path(std::string_view path, std::size_t most) {
  return path.size() <= most ? visible(path) : "…" + visible(ending(path, most));
}

std::string one_line(std::string_view sentence, std::size_t most) {
  std::string line;
  for (std::size_t at = 0; at < sentence.size(); ++at) {
    line += sentence[at];
    if (sentence[at] != '\n') continue;
    while (at + 1 < sentence.size() && (sentence[at + 1] == ' ' || sentence[at + 1] == '\n')) ++at;
  }
  if (line.size() <= most) return visible(line);
  constexpr std::size_t ellipsis = std::string_view("…").size();
  const std::size_t tail = most / 4;
  return visible(beginning(line, most - tail - ellipsis)) + "…" + visible(ending(line, tail));
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = first_character(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace seiche
