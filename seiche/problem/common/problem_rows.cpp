#include <seiche/core/error.hpp>
#include <seiche/problem/common/problem_rows.hpp>

#include <algorithm>

namespace seiche {

std::size_t place_among(const std::vector<std::string>& names, const std::string& name) {
  const auto place = std::find(names.begin(), names.end(), name);
  if (place == names.end()) throw unknown_name("choice", name, names);
  return static_cast<std::size_t>(place - names.begin());
}

}  // namespace seiche
