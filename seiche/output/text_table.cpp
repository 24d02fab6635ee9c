#include <seiche/core/base/error.hpp>
#include <seiche/output/text_table.hpp>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

namespace seiche {
namespace {

// The next row of `text`, from `at` on, which moves behind it.
std::vector<std::string> next_row(std::string_view text, std::size_t& at, const std::filesystem::path& file) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"' && quoted && text.substr(at + 1, 1) == "\"") {
      cells.back() += text[++at];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else if (c == '\n' && !quoted) {
      ++at;
      return cells;
    } else {
      cells.back() += c;
    }
  }
  if (quoted) throw Error("{} ends inside quotes", file.string());
  return cells;
}

}  // namespace

TextTable::TextTable(const std::filesystem::path& file) : file_(file) {
  std::ifstream input(file, std::ios::binary);
  if (!input) throw Error("{} cannot be read", file.string());
  const std::string text{std::istreambuf_iterator<char>(input), {}};
  std::size_t at = 0;
  names_ = next_row(text, at, file);
  while (at < text.size()) {
    rows_.push_back(next_row(text, at, file));
    if (rows_.back().size() != names_.size())
      throw Error("{}: row {} has {} cells under {} names", file.string(), rows_.size(), rows_.back().size(),
                  names_.size());
  }
}

bool TextTable::has(const std::string& name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::size_t TextTable::column(const std::string& name) const {
  if (!has(name)) throw Error("{} has no column {}", file_.string(), name);
  return static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
}

const std::string& TextTable::text(std::size_t row, const std::string& name) const {
  return rows_.at(row)[column(name)];
}

double TextTable::number(std::size_t row, const std::string& name) const {
  const std::string& cell = text(row, name);
  double value = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty()) return value;
  const auto [rest, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || rest != cell.data() + cell.size())
    throw Error("{}: '{}' in row {} under {} is not a number", file_.string(), cell, row + 1, name);
  return value;
}

}  // namespace seiche
