// energy.csv read in one pass for pictures and tables: however long the run was, no more points than are seen.
#pragma once

#include <seiche/output/csv_table.hpp>
#include <seiche/study/results.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

struct EnergyHistory {
  Curve H;
  std::optional<Curve> modified;
  // By cause, as the columns of the ledger name them: the sum of all changes up to t. Empty where the run kept no
  // ledger.
  std::vector<Curve> causes;
  std::int64_t rows = 0;
};

// Of each of some thousand stretches of time the rows with the smallest and the largest value, and the first and the
// last row. Of a file that grows, of its first bytes alone. Throws Error where the file is missing or no table of
// energies.
EnergyHistory read_energy_history(const std::filesystem::path& file, std::uintmax_t bytes = CsvReader::all_bytes);

// A column of the ledger in words. Where a method takes its damping in one piece, as collocation does, the ledger has
// all of it in the first of its two columns, and it is called so.
std::string cause_label(const EnergyHistory& history, const std::string& column);

}  // namespace seiche
