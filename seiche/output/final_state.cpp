#include <seiche/output/csv_row.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/final_state.hpp>

namespace seiche {

void write_final_state(const Folder& folder, const Vector& physical_values) {
  AtomicFile file(folder, "final.txt");
  CsvRow row;
  for (const double value : physical_values) {
    row.clear();
    row.add(value);
    file.write(row.line());
  }
  file.commit();
}

}  // namespace seiche
