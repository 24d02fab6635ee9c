// A written list, and the rows that a program adds to it while it runs.
#pragma once

#include <seiche/core/error.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace seiche {

// Rows stay where they are: whoever found one may keep a reference to it.
template <class Row>
class Listed {
 public:
  explicit Listed(std::span<const Row> written) {
    rows_.reserve(written.size() + most_added);
    rows_.assign(written.begin(), written.end());
  }
  std::span<const Row> rows() const { return rows_; }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Row& row : rows_) names.emplace_back(row.name);
    return names;
  }
  const Row* find(std::string_view name) const {  // null: no such row
    const auto place = std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) { return row.name == name; });
    return place == rows_.end() ? nullptr : &*place;
  }

  void add(Row row) {
    if (find(row.name) != nullptr) throw Error("'{}' is in the list already", row.name);
    if (rows_.size() == rows_.capacity()) throw Error("no more than {} rows can be added", most_added);
    rows_.push_back(std::move(row));
  }
  void remove_last() { rows_.pop_back(); }

 private:
  static constexpr std::size_t most_added = 64;
  std::vector<Row> rows_;
};

}  // namespace seiche
