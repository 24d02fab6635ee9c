// The files that a run or an ensemble leaves in its folder, told from those of others by how they begin.
#pragma once

#include <seiche/output/file/folder.hpp>

#include <filesystem>

namespace seiche {

enum class RunKind { run, ensemble, solve };  // solve: a call from Python, which leaves checkpoints alone

// In the head of every report.html of ours.
inline constexpr const char* report_mark = "<meta name=\"generator\" content=\"Seiche\">";

// Throws Error with the file where something that Seiche did not write has the name of a file that is to be written.
void require_own_files(const std::filesystem::path& directory, RunKind kind, bool report);
void require_own_report(const std::filesystem::path& directory);

// Throws Error, which names the ways on, where a run in the folder could go on from a checkpoint: for those who would
// write there.
void require_no_checkpoint(const std::filesystem::path& directory);
// The same for those who would read what a run leaves at its end, where it has left none yet.
void require_ended(const std::filesystem::path& directory);

// Is everything there that is to be read when a run or an ensemble has ended, or was interrupted?
bool is_complete(const std::filesystem::path& directory);

// Is there a solution.h5 that needs no segments beside it? Not where it cannot be read.
bool holds_joined_solution(const std::filesystem::path& directory);

void remove_partial_files(const Folder& folder);  // of a run that was killed, and whose rows they do not hold
// What a run that goes on leaves anew at its end.
void remove_what_tells_of_end(const Folder& folder);
// Of an earlier run or ensemble everything but its pictures and fftw_wisdom: a program that is killed must not leave
// its case beside another one's results.
void remove_earlier_results(const Folder& folder);
void remove_own_report(const std::filesystem::path& directory);

}  // namespace seiche
