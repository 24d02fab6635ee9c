// One value of a case file, with the place it came from, and what it may be read as. Each reader throws Error with a
// sentence that names the key, the value and what is allowed; the place is put before it by the caller.
#pragma once

#include <seiche/core/text/number_text.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace seiche {

struct CaseValue {
  enum class Kind { number, boolean, text, table, list, other };
  Kind kind = Kind::other;
  std::string text;       // a number or boolean as written, a text without its quotes, else what it is: "a list"
  double number = 0.0;    // of a number
  std::string given;      // after the = of --set, where names and file names need no quotes; else empty
  std::string place;      // "case.toml:3:5" or "--set method.h=1/64"
  std::size_t order = 0;  // of the place among all places
  std::vector<std::pair<std::string, CaseValue>> entries = {};  // of a table, in source order; of a list, without names

  std::string shown() const;  // to be named in a sentence: 3.5, true, "abc", a list
};

// A number, or a text that is a constant formula: "1/256", "2*pi".
double read_number(std::string_view key, const CaseValue& value);
long read_whole(std::string_view key, const CaseValue& value, long minimum);
std::string read_text(std::string_view key, const CaseValue& value);
std::string read_name(std::string_view key, const CaseValue& value, const std::vector<std::string>& names);

bool is_toml_number(std::string_view text);      // true if it may stand in a case file without quotes
std::string toml_string(std::string_view text);  // in quotes, escaped

}  // namespace seiche
