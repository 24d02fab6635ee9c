#include <bench/peers/groups.hpp>
#include <bench/work_precision/manifest.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/version.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

namespace seiche::bench {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string name = "unknown";
  std::string sets;
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(':');
    if (line.starts_with("model name") && colon != std::string::npos) name = line.substr(colon + 2);
    if (!line.starts_with("flags")) continue;
    for (const char* set : {"avx2", "avx512f"}) {
      if (line.find(set) != std::string::npos) sets += fmt::format(", {}", set);
    }
    break;
  }
  return name + sets;
}

std::string load() {
  double averages[1] = {0};
  return getloadavg(averages, 1) == 1 ? fmt::format("{:.2f} when the bench began", averages[0]) : "unknown";
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", std::gmtime(&now));
  return text;
}

}  // namespace

Manifest make_manifest(const Options& options, const std::vector<PeerGroup>& groups) {
  Manifest manifest = {
      {"Seiche", fmt::format("{}, commit {}", version_number, version_commit)},
      {"measured", today() + (options.quick ? ", quick: every second level, short runs only" : "")},
      {"processor", fmt::format("{}; {} hardware threads", processor(), std::thread::hardware_concurrency())},
      {"load", load()},
      {"compiler", fmt::format("{}, {}; peers with {}", version_compiler, version_build_type, peer_compiler_flags())},
      {"times",
       fmt::format("CPU seconds of the process, time stepping alone; medians of at least {} runs in turn, of 3 above "
                   "0.1 s and of 1 above 0.5 s",
                   options.repeats)},
      {"cap", fmt::format("runs expected above {} s were skipped; {} s per problem, shared equally",
                          options.cap_seconds, options.problem_seconds)},
  };
  for (const PeerGroup& group : groups) {
    const PeerLibrary& library = group.library;
    manifest.emplace_back(library.name, library.version + (library.note.empty() ? "" : "; " + library.note));
  }
  for (const std::string& missing : missing_peer_libraries())
    manifest.emplace_back("not measured", missing + ": not found when this was built");
  for (const auto& [name, version] : backend_library_versions()) manifest.emplace_back("Seiche’s " + name, version);
  return manifest;
}

std::string as_csv_comment(const Manifest& manifest) {
  std::string text;
  for (const auto& [what, value] : manifest) text += fmt::format("# {}: {}\n", what, value);
  return text;
}

std::string as_json(const Manifest& manifest) {
  nlohmann::ordered_json json;
  for (const auto& [what, value] : manifest) {
    if (json.contains(what)) {
      json[what] = json[what].get<std::string>() + "; " + value;
    } else {
      json[what] = value;
    }
  }
  return json.dump(2) + "\n";
}

}  // namespace seiche::bench
