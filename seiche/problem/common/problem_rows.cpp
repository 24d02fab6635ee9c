#include <seiche/problem/common/problem_rows.hpp>

#include <algorithm>

namespace seiche {

std::size_t place_among(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace seiche
