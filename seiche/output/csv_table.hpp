// Tables of numbers with a header line.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace seiche {

// Row by row, for those that are too long to be kept. Throws Error, with file and line, for what is no such table.
class CsvReader {
 public:
  explicit CsvReader(const std::filesystem::path& file);
  const std::vector<std::string>& names() const { return names_; }
  bool next(std::vector<double>& row);  // false: no row is left

 private:
  std::filesystem::path file_;
  std::ifstream input_;
  std::size_t line_number_ = 1;
  std::string line_;
  std::vector<std::string> names_;
};

struct CsvTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;

  // Throws Error as CsvReader does, and for a table without a row.
  static CsvTable read(const std::filesystem::path& file);
  bool has(const std::string& name) const;
  std::vector<double> column(const std::string& name) const;  // throws Error where it is missing
};

}  // namespace seiche
