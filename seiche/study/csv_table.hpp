// A table of numbers with a header line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

struct CsvTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;

  // Throws Error, with file and line, for what is no such table.
  static CsvTable read(const std::filesystem::path& file);
  bool has(const std::string& name) const;
  std::vector<double> column(const std::string& name) const;  // throws Error if there is none
};

}  // namespace seiche
