#include "edits.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace seiche::fuzz {
namespace {

constexpr std::array<std::string_view, 16> words = {"nan",
                                                    "-inf",
                                                    "1e999",
                                                    "-1",
                                                    "9223372036854775808",
                                                    "\"x\"",
                                                    "[[",
                                                    "{}",
                                                    ",",
                                                    "\n",
                                                    "null",
                                                    "0.5",
                                                    "1e-320",
                                                    "\xff\xfe",
                                                    "\"",
                                                    std::string_view("\0\0\0\0\0\0\0\0", 8)};

void edit(std::string& bytes, std::span<const std::uint8_t> e) {
  const std::size_t place = e[2] | static_cast<std::size_t>(e[3]) << 8 | static_cast<std::size_t>(e[4]) << 16;
  const std::size_t at = bytes.empty() ? 0 : place % bytes.size();
  const std::size_t length = std::min<std::size_t>(e[5], bytes.size() - at);
  switch (e[1] % 8) {
    case 0: std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, static_cast<char>(e[6])); break;
    case 1:
      if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << e[6] % 8));
      break;
    case 2: bytes.erase(at, length); break;
    case 3: bytes.insert(at, bytes.substr(at, length)); break;
    case 4: bytes.resize(at); break;
    case 5: bytes.insert(at, words[e[6] % words.size()]); break;
    case 6: {  // the number that stands there
      constexpr std::string_view of_numbers = "0123456789+-.eE";
      const std::size_t begin = std::min(bytes.find_first_of(of_numbers, at), bytes.size());
      const std::size_t end = std::min(bytes.find_first_not_of(of_numbers, begin), bytes.size());
      bytes.replace(begin, end - begin, words[e[6] % words.size()]);
      break;
    }
    default:  // one byte of a size or an address
      if (at < bytes.size()) bytes[at] = static_cast<char>(e[6]);
  }
}

}  // namespace

std::string Edits::applied(std::string bytes, unsigned file, unsigned files) const {
  for (std::size_t at = 0; at + size <= input_.size(); at += size)
    if (const auto e = input_.subspan(at, size); e[0] % files == file) edit(bytes, e);
  return bytes;
}

}  // namespace seiche::fuzz
