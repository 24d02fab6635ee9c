// The files that a run or an ensemble leaves in its folder, told from those of others by how they begin.
#pragma once

#include <filesystem>
#include <string>

namespace seiche {

enum class RunKind { run, ensemble };

// In the head of every report.html of ours.
inline constexpr const char* report_mark = "<meta name=\"generator\" content=\"Seiche\">";

// Throws Error with the file where something that Seiche did not write has the name of a file that is to be written.
void require_own_files(const std::filesystem::path& directory, RunKind kind, bool report);
void require_own_report(const std::filesystem::path& directory);

// What a run or ensemble that did not reach its end has left and no other one would leave again: "energy.csv.partial
// (18.2 MB) and solution.h5.partial (3.6 MB)"; "" where every run there has ended, or has not written a row.
std::string unfinished_files(const std::filesystem::path& directory);
// Throws Error, which says what can be done, where there are such files, or what was recovered of them.
void require_finished(const std::filesystem::path& directory);
// The same for those who would read them.
void require_recovered(const std::filesystem::path& directory);

// Of an earlier run or ensemble everything but its pictures and fftw_wisdom: a program that is killed must not leave
// its case beside another one's results.
void remove_earlier_results(const std::filesystem::path& directory);
void remove_own_report(const std::filesystem::path& directory);

}  // namespace seiche
