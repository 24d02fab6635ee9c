#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/driver/case_folder.hpp>
#include <seiche/figure/run_pictures.hpp>
#include <seiche/study/versions.hpp>

namespace seiche {
namespace {

const std::filesystem::path& made(const std::filesystem::path& path) {
  make_directory(path);
  return path;
}

}  // namespace

CaseFolder::CaseFolder(const std::filesystem::path& path, RunKind kind, const RunSpec& spec, bool restart)
    : folder_(made(path)), lock_(folder_) {
  require_own_files(path, kind, kind == RunKind::run && spec.report);
  if (!restart) require_no_checkpoint(path);
  remove_earlier_results(folder_);
  remove_own_report(path);
  remove_pictures(path);
  write_file(folder_, "case.toml", write_case(spec));
}

CaseFolder::CaseFolder(const std::filesystem::path& path) : folder_(path), lock_(folder_) {}

const std::atomic<bool>& never_stops() {
  static const std::atomic<bool> never = false;
  return never;
}

const std::atomic<bool>* begin_run(const RunCaseOptions& options) {
  const std::atomic<bool>* stop = options.begins ? options.begins() : nullptr;
  return stop != nullptr ? stop : &never_stops();
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
