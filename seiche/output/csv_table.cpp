#include <seiche/core/base/error.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/output/csv_table.hpp>

#include <algorithm>
#include <charconv>
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

CsvReader::CsvReader(const std::filesystem::path& file, std::uintmax_t bytes) : file_(file), bytes_(bytes) {
  if (look_at(file).kind == InputKind::other) throw Error("{} is not a file", file.string());
  input_.open(file);
  if (!input_) throw Error("{} cannot be read", file.string());
  if (!next_line()) return;
  for (const std::string_view name : cells(line_)) names_.emplace_back(name);
}

bool CsvReader::next_line() {
  if (bytes_ == 0 || !std::getline(input_, line_)) return false;
  bytes_ -= std::min<std::uintmax_t>(bytes_, line_.size() + 1);
  return true;
}

bool CsvReader::next(std::vector<double>& row) {
  if (!next_line()) return false;
  ++line_number_;
  row.clear();
  const char* at = line_.data();
  const char* const end = at + line_.size();
  while (at <= end) {
    double value = 0;
    const auto [rest, error] = std::from_chars(at, end, value);
    if (error != std::errc{} || (rest != end && *rest != ','))
      throw Error("{}:{}: '{}' is not a number", file_.string(), line_number_,
                  std::string_view(at, std::find(at, end, ',')));
    row.push_back(value);
    at = rest + 1;
  }
  if (row.size() != names_.size())
    throw Error("{}:{}: {} cells under {} names", file_.string(), line_number_, row.size(), names_.size());
  return true;
}

CsvTable CsvTable::read(const std::filesystem::path& file, std::uintmax_t bytes) {
  CsvReader reader(file, bytes);
  CsvTable table{.names = reader.names(), .rows = {}};
  for (std::vector<double> row; reader.next(row);) table.rows.push_back(row);
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
