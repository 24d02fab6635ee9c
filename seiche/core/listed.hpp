// A written list, and the rows that a program adds to it while it runs.
#pragma once

#include <seiche/core/error.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
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

  void add(Row row) {
    if (std::any_of(rows_.begin(), rows_.end(), [&](const Row& r) { return r.name == row.name; }))
      throw Error("'{}' is in the list already", row.name);
    if (rows_.size() == rows_.capacity()) throw Error("no more than {} rows can be added", most_added);
    rows_.push_back(std::move(row));
  }
  void remove_last() { rows_.pop_back(); }

 private:
  static constexpr std::size_t most_added = 64;
  std::vector<Row> rows_;
};

}  // namespace seiche
