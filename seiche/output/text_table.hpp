// Tables of text and numbers with a header line: CSV (RFC 4180), whose quoted cells may hold commas, quotes and new
// lines.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

class TextTable {
 public:
  // Throws Error where the file cannot be read, a quote is not closed, or a row has other cells than the header.
  explicit TextTable(const std::filesystem::path& file);

  std::size_t rows() const { return rows_.size(); }
  bool has(const std::string& name) const;
  // Throw Error where there is no such column; `number` also where the cell holds none: an empty one is NaN.
  const std::string& text(std::size_t row, const std::string& name) const;
  double number(std::size_t row, const std::string& name) const;

 private:
  std::size_t column(const std::string& name) const;

  std::filesystem::path file_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace seiche
