// What a checkpoint of a case holds: how far its files had come, and what a resume says of the run so far.
#pragma once

#include <seiche/core/control/archive.hpp>
#include <seiche/output/energy_trace.hpp>
#include <seiche/output/file/sha256.hpp>
#include <seiche/output/summary.hpp>
#include <seiche/record/checkpoint_file.hpp>
#include <seiche/record/run_folder.hpp>
#include <seiche/record/solution_file.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

struct SavedRun {
  RunKind kind = RunKind::run;
  std::vector<std::string> versions;      // what computed it, "compiler GNU 12.2.0": others may round another way
  std::string case_text;                  // as case.toml
  FileHashes hashes;                      // of that, and of the files that it names
  std::vector<std::string> notes;         // what was said before the first step
  std::vector<ResumedWith> resumed_with;  // where it had gone on from a checkpoint itself, and with what
  std::optional<double> new_end;          // of case_text, where a resume has put it there and no step was taken yet
  double t = 0.0;
  std::int64_t steps = 0;
  EnergyTrace::Mark energies;
  std::optional<SolutionFile::Mark> solution;  // of a run
  void archive(Archive& a);
};

struct Checkpoint {
  std::string name;  // of the file
  SavedRun run;
  Archive rest;  // what the time loop has written, to be read by it
};

// Puts a case with another end into every checkpoint of the folder that can be read; all else stays as it is. Throws
// Error where one cannot be written; since the newest comes last, a run then goes on to the end of before.
void write_new_end(const Folder& folder, const std::string& case_text, double t_end);
// Throws Error where it cannot be read, is damaged, or is of another format.
Checkpoint read_checkpoint(const std::filesystem::path& file, bool is_checked = false);

// The case in the newest checkpoint of a folder that can be read; "" where there is no such checkpoint.
std::string case_of_checkpoint(const std::filesystem::path& directory);

std::vector<std::string> lines_of(const std::map<std::string, std::string>& versions);  // as SavedRun::versions
// A sentence for each of these that is not among those that wrote the checkpoint.
std::vector<std::string> notes_on_versions(const SavedRun& run, const std::map<std::string, std::string>& versions);

// Throws Error where it is not of a case, but of a call of `seiche.solve`.
void require_case(const std::filesystem::path& directory, const SavedRun& run);

// Why a run cannot go on from it in this folder, whose files no longer begin as they did then; "" where it can.
std::string complaint_about(const Folder& folder, const SavedRun& run);

// The newest checkpoint of a folder that is whole, and with whose beginning the files of the folder agree. `notes` gets
// a sentence for each that is not. Throws Error, with these, where no checkpoint is left.
Checkpoint newest_checkpoint(const Folder& folder, std::vector<std::string>& notes);

}  // namespace seiche
