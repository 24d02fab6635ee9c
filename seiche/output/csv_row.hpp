// One line of numbers with as few digits as tell each double from all others: reading gives the same one. Kept between
// rows, so that recording allocates nothing once the first row was written.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cstddef>
#include <string_view>

namespace seiche {

class CsvRow {
 public:
  void clear() { text_.clear(); }
  void add(double value) {
    if (text_.size() > 0) text_.push_back(',');
    const std::size_t begin = text_.size();
    text_.resize(begin + longest_number);  // writing in place is twice as fast as appending
    text_.resize(
        static_cast<std::size_t>(fmt::format_to(text_.data() + begin, FMT_COMPILE("{}"), value) - text_.data()));
  }
  void add(const Vector& values) {
    for (const double value : values) add(value);
  }
  std::string_view line() {
    text_.push_back('\n');
    return {text_.data(), text_.size()};
  }

 private:
  static constexpr std::size_t longest_number = 24;  // -2.2250738585072014e-308
  fmt::memory_buffer text_;
};

}  // namespace seiche
