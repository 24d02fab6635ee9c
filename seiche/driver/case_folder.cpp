#include <seiche/config/case/case_file.hpp>
#include <seiche/core/error.hpp>
#include <seiche/driver/case_folder.hpp>
#include <seiche/driver/saved_run.hpp>
#include <seiche/figure/run_pictures.hpp>
#include <seiche/output/csv_table.hpp>
#include <seiche/study/versions.hpp>

#include <algorithm>

namespace seiche {
namespace {

const std::filesystem::path& made(const std::filesystem::path& path) {
  make_directory(path);
  return path;
}

// Throws Error where the folder holds an ensemble without summary.json, which comes last.
void require_summed_up(const std::filesystem::path& path) {
  const std::filesystem::path energies = path / "energy.csv";
  if (std::filesystem::exists(path / "summary.json") || !std::filesystem::exists(energies)) return;
  const CsvReader table(energies);
  if (std::find(table.names().begin(), table.names().end(), "members") == table.names().end()) return;
  throw Error(
      "{0} holds an ensemble that did not finish: `seiche recover {0}` makes it readable, `seiche run` with --restart "
      "removes it and begins anew, and another folder keeps both",
      path.string());
}

}  // namespace

CaseFolder::CaseFolder(const std::filesystem::path& path, RunKind kind, const RunSpec& spec, bool restart)
    : folder_(made(path)), lock_(folder_) {
  require_own_files(path, kind, kind == RunKind::run && spec.report);
  if (!restart) {
    require_no_checkpoint(path);
    require_finished(path);
    require_summed_up(path);
  }
  remove_earlier_results(path);
  remove_checkpoints(folder_);
  remove_own_report(path);
  remove_pictures(path);
  write_file(folder_, "case.toml", write_case(spec));
}

CaseFolder::CaseFolder(const std::filesystem::path& path) : folder_(path), lock_(folder_) {}

void require_no_checkpoint(const std::filesystem::path& path) {
  if (!checkpoints_in(path).empty())
    throw Error(
        "{0} holds a checkpoint of a run that did not reach its end: `seiche resume {0}` goes on from it, `seiche run` "
        "with --restart removes it and begins anew, and another folder keeps both",
        path.string());
}

const std::atomic<bool>* begin_run(const RunCaseOptions& options) {
  static const std::atomic<bool> never = false;
  const std::atomic<bool>* stop = options.begins ? options.begins() : nullptr;
  return stop != nullptr ? stop : &never;
}

FileHashes hashes_of(const RunSpec& spec, const std::string& case_text) {
  FileHashes hashes = {{"case.toml", sha256(case_text)}};
  for (const std::filesystem::path& file : input_files(spec)) hashes[file.string()] = sha256_of_file(file);
  return hashes;
}

std::map<std::string, std::string> all_versions(const RunCaseOptions& options) {
  std::map<std::string, std::string> all = versions_in_use();
  all.insert(options.versions.begin(), options.versions.end());
  return all;
}

}  // namespace seiche
