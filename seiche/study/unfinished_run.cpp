#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/output/file/folder_lock.hpp>
#include <seiche/study/unfinished_run.hpp>

#include <fmt/format.h>

#include <utility>

namespace seiche {
namespace {

// The files beside it are not compared, which takes a reading of all of them: a run that goes on needs that.
SavedRun newest_saved(const std::filesystem::path& directory) {
  std::optional<Error> first;
  for (const std::string& name : checkpoints_in(directory)) {
    try {
      return read_checkpoint(directory / name).run;
    } catch (const Error& error) {
      if (!first) first = error;
    }
  }
  if (!first) throw Error("the run in {} ended while it was looked at: look at it again", directory.string());
  throw Error(*first);
}

}  // namespace

std::string UnfinishedRun::how_far() const {
  return fmt::format("{}, up to t = {:.6g}", is_running ? "still running" : "not finished", saved.t);
}

std::optional<UnfinishedRun> unfinished_run(const std::filesystem::path& directory) {
  if (std::filesystem::exists(directory / "summary.json") || !std::filesystem::is_directory(directory)) return {};
  const Folder folder(directory);
  const bool has_checkpoint = !checkpoints_in(directory).empty();
  if (!has_checkpoint && is_locked(folder))
    throw Error("the run in {} has no checkpoint yet, up to which it could be looked at: the first comes after seconds",
                directory.string());
  if (!has_checkpoint) return {};
  UnfinishedRun run{.saved = newest_saved(directory), .spec = {}, .energies = {}};
  require_case(directory, run.saved);
  run.is_running = is_locked(folder);
  run.spec = parse_case(run.saved.case_text, "the checkpoint", {}, directory);
  run.energies = directory / name_left_behind(folder, "energy.csv");
  return run;
}

}  // namespace seiche
