// Rows of a written list, by their names.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

template <class Row>
std::vector<std::string> names_of(std::span<const Row> rows) {
  std::vector<std::string> names;
  for (const Row& row : rows) names.emplace_back(row.name);
  return names;
}

template <class Row>
const Row* find_row(std::span<const Row> rows, std::string_view name) {  // null: no such row
  const auto place = std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.name == name; });
  return place == rows.end() ? nullptr : &*place;
}

}  // namespace seiche
