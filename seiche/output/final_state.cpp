#include <seiche/output/csv_row.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/final_state.hpp>

#include <optional>

namespace seiche {

void write_final_state(const Folder& folder, FunctionRef<void(FunctionRef<void(std::span<const double> piece)>)> join) {
  std::optional<AtomicFile> file;
  CsvRow row;
  join([&](std::span<const double> piece) {
    if (!file) file.emplace(folder, "final.txt");
    for (const double value : piece) {
      row.clear();
      row.add(value);
      file->write(row.line());
    }
  });
  if (file) file->commit();
}

}  // namespace seiche
