// Tables of numbers with a header line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace seiche {

// Row by row, for those that are too long to be kept. Throws Error, with file and line, for what is no such table.
class CsvReader {
 public:
  static constexpr std::uintmax_t all_bytes = std::numeric_limits<std::uintmax_t>::max();
  // Of a file that grows, the first bytes alone.
  explicit CsvReader(const std::filesystem::path& file, std::uintmax_t bytes = all_bytes);
  const std::vector<std::string>& names() const { return names_; }
  bool next(std::vector<double>& row);  // false: no row is left

 private:
  bool next_line();
  std::filesystem::path file_;
  std::ifstream input_;
  std::uintmax_t bytes_;  // that are left
  std::size_t line_number_ = 1;
  std::string line_;
  std::vector<std::string> names_;
};

struct CsvTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;

  // Throws Error as CsvReader does, and for a table without a row.
  static CsvTable read(const std::filesystem::path& file, std::uintmax_t bytes = CsvReader::all_bytes);
  bool has(const std::string& name) const;
  std::vector<double> column(const std::string& name) const;  // throws Error where it is missing
};

}  // namespace seiche
