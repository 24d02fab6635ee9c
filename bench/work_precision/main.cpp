// The work–precision bench: Seiche beside other integrators.
#include <bench/peers/groups.hpp>
#include <bench/work_precision/page.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/output/file/atomic_file.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>

namespace seiche::bench {
namespace {

// Writes what there is after every problem, so that an interrupted run leaves its tables.
void write_tables(const std::vector<ProblemResult>& results, const Manifest& manifest, const Options& options) {
  std::string csv = as_csv_comment(manifest) + csv_head();
  for (const ProblemResult& result : results) {
    for (const Row& row : result.rows) csv += csv_line(row);
  }
  write_file(options.out / "work_precision.csv", csv);
  write_file(options.out / "manifest.json", as_json(manifest));
}

// Throws Error where a name is no peer's.
void keep_asked(std::vector<Peer>& peers, const std::vector<std::string>& asked) {
  std::vector<std::string> known;
  for (const Peer& peer : peers) known.push_back(peer.name);
  for (const std::string& name : asked)
    if (std::find(known.begin(), known.end(), name) == known.end()) throw unknown_name("peer", name, known);
  if (!asked.empty())
    std::erase_if(peers, [&](const Peer& p) { return std::find(asked.begin(), asked.end(), p.name) == asked.end(); });
}

int run(const Options& options) {
  make_directory(options.out);
  const std::vector<PeerGroup> groups = options.peers ? peer_groups() : std::vector<PeerGroup>{};
  const Manifest manifest = make_manifest(options, groups);
  std::vector<Peer> peers;
  for (const PeerGroup& group : groups) peers.insert(peers.end(), group.peers.begin(), group.peers.end());
  keep_asked(peers, options.peer_names);
  std::vector<ProblemResult> results;
  for (const std::string& problem : options.problems) {
    results.push_back(sweep(problem, peers, options));
    write_tables(results, manifest, options);
  }
  std::string no_figures_because;
  try {
    draw_figures(results, options.out);
  } catch (const Error& error) {
    no_figures_because = error.what();
  }
  write_page(results, manifest, options.out, no_figures_because);
  std::printf("%s\n", (options.out / "index.html").c_str());
  return 0;
}

}  // namespace
}  // namespace seiche::bench

int main(int argc, char** argv) {
  using namespace seiche::bench;
  constexpr int wrong_usage = 2;
  int on_error = wrong_usage;
  try {
    const Options options = Options::parse({argv + 1, argv + argc});
    on_error = 1;
    if (!options.help) return run(options);
    std::fputs(usage, stdout);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "seiche_work_precision: %s\n", error.what());
    return on_error;
  }
}
