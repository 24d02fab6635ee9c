// Whatever stands in a file of Matrix Market or of PETSc, a problem is made of it, or it is refused with a sentence.
// Files that need more than 128 MB, by their header, are left out; scripts/fuzz-program runs what needs twice that.
#include "bars.hpp"
#include "own_folder.hpp"

#include <seiche/config/case/case_file.hpp>
#include <seiche/config/data/matrix_file.hpp>
#include <seiche/simulation/simulation.hpp>

#include <algorithm>
#include <cstdint>
#include <string>

namespace seiche::fuzz {
namespace {

constexpr double memory = 128e6, bytes_per_row = 270;
constexpr Index most_rows = 64;  // with which a step is taken

void read(const std::string& text) {
  static const OwnFolder folder;
  write(folder.path / "M.mtx", text);
  const MatrixSizes sizes = matrix_sizes(folder.path / "M.mtx");
  if (static_cast<double>(std::max(sizes.rows, sizes.columns)) * bytes_per_row > memory) return;
  for (const char* matrices : {"M = \"M.mtx\"\n", "M = \"M.mtx\"\nS = \"M.mtx\"\nfields = 1\n"}) {
    const RunSpec spec =
        parse_case(std::string("[problem]\nname = \"sparse\"\n") + matrices, "case.toml", {}, folder.path);
    const Problem problem = make_problem(spec);
    if (problem.size() > most_rows) continue;
    Simulation simulation(problem);
    simulation.step(1.0 / 64);
  }
}

}  // namespace
}  // namespace seiche::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  seiche::fuzz::within_bars([&] { seiche::fuzz::read(text); }, text);
  return 0;
}
