// Whatever has happened to the files that a run left, `seiche audit` and `seiche plot` read them or refuse them with a
// sentence. What is drawn of them is left out.
#include "bars.hpp"
#include "edits.hpp"
#include "own_folder.hpp"

#include <seiche/config/case/case_file.hpp>
#include <seiche/driver/run_case.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/study/audit/audit.hpp>
#include <seiche/study/energy_history.hpp>
#include <seiche/study/run_files.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace seiche::fuzz {
namespace {

constexpr std::array names = {"summary.json", "energy.csv", "solution.h5", "case.toml", "final.txt"};

struct Run {
  OwnFolder folder;
  std::vector<std::string> files;

  Run() {
    run_case(parse_case("[problem]\nname = \"klein_gordon\"\npoints = 4\n[method]\nname = \"seisav\"\nh = \"1/16\"\n"
                        "[time]\nend = 1\n[output]\nledger = \"on\"\nsnapshot_every = 4\nreport = \"off\"\n",
                        "case.toml"),
             folder.path);
    for (const char* name : names) files.push_back(bytes_of(folder.path / name));
  }
};

void read(const std::filesystem::path& folder) {
  within_bars([&] { audit(folder); });
  within_bars([&] { read_run(folder); });
  within_bars([&] { read_energy_history(folder / "energy.csv"); });
  within_bars([&] {
    const SolutionReader solution(folder / "solution.h5");
    Vector values;
    for (Index k = 0; k < solution.count(); ++k) solution.state(k, values);
    solution.energies();
    solution.nodes();
    solution.bars();
  });
}

}  // namespace
}  // namespace seiche::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seiche::fuzz;
  static const Run run;
  const Edits edits({data, size});
  for (unsigned i = 0; i < names.size(); ++i)
    write(run.folder.path / names[i], edits.applied(run.files[i], i, names.size()));
  read(run.folder.path);
  return 0;
}
