// Set-up mistakes are thrown as one sentence: the value, what is allowed, and the nearest valid name.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;

  template <class... Args>
    requires(sizeof...(Args) > 0)
  explicit Error(fmt::format_string<Args...> format, Args&&... args)
      : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

// The name closest to `wanted` by edit distance (transpositions count one), or "" if none is near. To a name of one or
// two letters only one of the same letters is near: Q to q, xu to ux, hh to h.
std::string nearest_name(std::string_view wanted, const std::vector<std::string>& names);

// "unknown method 'seisv'; did you mean 'seisav'? Allowed: avf, sav, …"
Error unknown_name(std::string_view what, std::string_view wanted, const std::vector<std::string>& names);

}  // namespace seiche
