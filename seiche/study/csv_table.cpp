#include <seiche/core/error.hpp>
#include <seiche/study/csv_table.hpp>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string_view>

namespace seiche {
namespace {

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> list;
  for (;;) {
    const std::size_t comma = line.find(',');
    list.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return list;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

CsvTable CsvTable::read(const std::filesystem::path& file) {
  std::ifstream input(file);
  if (!input) throw Error("{} cannot be read", file.string());
  CsvTable table;
  std::string line;
  for (std::size_t number = 1; std::getline(input, line); ++number) {
    const std::vector<std::string_view> texts = cells(line);
    if (number == 1) {
      table.names.assign(texts.begin(), texts.end());
      continue;
    }
    if (texts.size() != table.names.size())
      throw Error("{}:{}: {} cells under {} names", file.string(), number, texts.size(), table.names.size());
    std::vector<double> row;
    for (const std::string_view text : texts) {
      double value = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc{} || end != text.data() + text.size())
        throw Error("{}:{}: '{}' is no number", file.string(), number, text);
      row.push_back(value);
    }
    table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) throw Error("{} holds no row of numbers", file.string());
  return table;
}

bool CsvTable::has(const std::string& name) const { return std::find(names.begin(), names.end(), name) != names.end(); }

std::vector<double> CsvTable::column(const std::string& name) const {
  const auto at = std::find(names.begin(), names.end(), name) - names.begin();
  if (at == static_cast<std::ptrdiff_t>(names.size())) throw Error("there is no column {}", name);
  std::vector<double> values;
  for (const auto& row : rows) values.push_back(row[static_cast<std::size_t>(at)]);
  return values;
}

}  // namespace seiche
