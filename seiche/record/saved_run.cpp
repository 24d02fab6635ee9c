#include <seiche/core/base/error.hpp>
#include <seiche/record/saved_run.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

namespace seiche {
namespace {

std::uint64_t archived_size(SavedRun run) {
  std::uint64_t size = 0;
  Archive archive([&size](std::string_view bytes) { size += bytes.size(); });
  archive(run);
  return size;
}

}  // namespace

void SavedRun::archive(Archive& a) {
  a(kind);
  a.require(kind >= RunKind::run && kind <= RunKind::solve);
  a(versions, case_text, hashes, notes, resumed_with, new_end, t, steps, energies, solution);
}

Checkpoint read_checkpoint(const std::filesystem::path& file, bool is_checked) {
  Checkpoint found{.name = file.filename().string(), .run = {}, .rest = read_checkpoint_file(file, is_checked)};
  found.rest(found.run);
  return found;
}

void write_new_end(const Folder& folder, const std::string& case_text, double t_end) {
  for (const char* name : {earlier_checkpoint_name, checkpoint_name}) {
    SavedRun run;
    try {
      run = read_checkpoint(folder.path() / name).run;
    } catch (const Error&) {  // it is not there, or of no use
      continue;
    }
    const std::uint64_t before = archived_size(run);
    run.case_text = case_text;
    run.hashes["case.toml"] = sha256(case_text);
    run.new_end = t_end;
    replace_beginning(folder, name, before, [&run](Archive& archive) { archive(run); });
  }
}

std::string case_of_checkpoint(const std::filesystem::path& directory) {
  for (const char* name : {checkpoint_name, earlier_checkpoint_name}) {
    try {
      return read_checkpoint(directory / name).run.case_text;
    } catch (const Error&) {  // the other one may serve
    }
  }
  return "";
}

std::vector<std::string> lines_of(const std::map<std::string, std::string>& versions) {
  std::vector<std::string> lines;
  for (const auto& [name, version] : versions) lines.push_back(fmt::format("{} {}", name, version));
  return lines;
}

std::vector<std::string> notes_on_versions(const SavedRun& run, const std::map<std::string, std::string>& versions) {
  std::vector<std::string> notes;
  for (const std::string& version : lines_of(versions))
    if (std::find(run.versions.begin(), run.versions.end(), version) == run.versions.end())
      notes.push_back(fmt::format("the checkpoint was not written by {}: last bits may differ", version));
  return notes;
}

void require_case(const std::filesystem::path& directory, const SavedRun& run) {
  if (run.kind == RunKind::solve)
    throw Error(
        "{0} holds a checkpoint of a call of seiche.solve: the same call with checkpoint = \"{0}\" goes on from it",
        directory.string());
}

std::string complaint_about(const Folder& folder, const SavedRun& run) {
  if (run.kind == RunKind::solve) return "";
  std::string of_energies = EnergyTrace::complaint(folder, run.energies);
  return of_energies.empty() && run.solution ? complaint_about(folder, run.solution->rows) : of_energies;
}

Checkpoint newest_checkpoint(const Folder& folder, std::vector<std::string>& notes) {
  for (const std::string& name : checkpoints_in(folder.path())) {
    const std::filesystem::path file = folder.path() / name;
    try {
      Checkpoint found = read_checkpoint(file);
      const std::string said = complaint_about(folder, found.run);
      if (said.empty()) return found;
      notes.push_back(fmt::format("{} is of no use: {}", name, said));
    } catch (const Error& error) {
      notes.push_back(fmt::format("{} is of no use: {}", name, error.what()));
    }
  }
  if (notes.empty())
    throw Error(
        "{} holds no checkpoint, from which a run could go on; another one may begin with initial = {{ file = \"final.txt\" "
        "}}",
        folder.path().string());
  throw Error("no run can go on from {}: {}", folder.path().string(), fmt::join(notes, "; "));
}

}  // namespace seiche
