// What other programs call the keys of a case file.
#pragma once

#include <string>
#include <string_view>

namespace seiche {

// A key by its meaning.
struct MeantKey {
  std::string section, key;  // both "" for a word that means none
};

// { "method", "h" } for "dt", { "method", "tolerance" } for "rtol".
MeantKey meant_key(std::string_view word);

}  // namespace seiche
