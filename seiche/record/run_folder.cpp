#include <seiche/core/base/error.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/record/checkpoint_file.hpp>
#include <seiche/record/run_folder.hpp>
#include <seiche/record/segments.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

namespace seiche {
namespace {

namespace fs = std::filesystem;

struct RunFile {
  const char* name;
  bool of_run, of_ensemble;
  bool tells_of_end;
  bool (*is_ours)(const std::string& text);
};

template <std::size_t N>
bool begins_with(const std::string& text, const std::array<std::string_view, N>& beginnings) {
  for (const std::string_view beginning : beginnings)
    if (text.starts_with(beginning)) return true;
  return false;
}

bool is_energies(const std::string& text) { return begins_with<2>(text, {"t,H", "t,members"}); }
bool is_members(const std::string& text) { return begins_with<2>(text, {"member,", "member\n"}); }
bool is_summary(const std::string& text) { return begins_with<1>(text, {"{\n  \"status\":"}); }
bool is_hdf5(const std::string& text) { return begins_with<1>(text, {hdf5_signature}); }
bool is_xdmf(const std::string& text) { return begins_with<1>(text, {"<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf"}); }
bool is_report(const std::string& text) { return text.find(report_mark) != std::string::npos; }

// One number in a line, and nothing to tell ours from another's by.
bool is_state(const std::string& text) { return text.find_first_not_of("0123456789+-.einfa\n") == std::string::npos; }

// As every run writes it anew: all sections, and no comment of a person.
bool is_settled_case(const std::string& text) {
  return text.starts_with("[problem]\nname = ") && text.find("\n[output]\ndirectory = ") != std::string::npos &&
         !text.starts_with('#') && text.find("\n#") == std::string::npos;
}

// In the order in which they are removed: by the case an earlier run is known.
constexpr std::array files = {
    RunFile{"summary.json", true, true, true, is_summary}, RunFile{"solution.h5", true, false, true, is_hdf5},
    RunFile{"solution.xdmf", true, false, true, is_xdmf},  RunFile{"final.txt", true, false, true, is_state},
    RunFile{"members.csv", false, true, true, is_members}, RunFile{"finals.csv", false, true, true, is_members},
    RunFile{"energy.csv", true, true, false, is_energies}, RunFile{"case.toml", true, true, false, is_settled_case}};

// Enough of a file to know it by; of a case all there is.
std::string beginning_of(const fs::path& path) {
  constexpr std::size_t enough = 1U << 20U;
  std::ifstream in(path, std::ios::binary);
  std::string text(enough, '\0');
  in.read(text.data(), static_cast<std::streamsize>(enough));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

bool is_foreign(const fs::path& path, bool (*is_ours)(const std::string&)) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return false;
  if (!fs::is_regular_file(path, ignored)) return true;
  const std::string text = beginning_of(path);
  return !text.empty() && !is_ours(text);  // of what is empty nothing is lost
}

void remove_own(const Folder& folder, const RunFile& file) {
  if (!is_foreign(folder.path() / file.name, file.is_ours)) remove_file(folder, file.name);
}

void require_own(const fs::path& path, bool (*is_ours)(const std::string&)) {
  if (is_foreign(path, is_ours))
    throw Error("{} would be replaced, and Seiche did not write it: move it away, or take another folder",
                path.string());
}

// By a case or a checkpoint of ours: without one nothing beside it is known to be ours, whatever it is called.
bool holds_run(const fs::path& directory) {
  std::error_code none;
  const fs::path settled = directory / "case.toml";
  return (fs::exists(settled, none) && !is_foreign(settled, is_settled_case)) || !checkpoints_in(directory).empty();
}

// Where segments of the solution will lie, which begin as any HDF5 file does; other files in there are left alone.
void require_own_segments(const fs::path& directory) {
  const fs::path inside = directory / segments_folder;
  std::error_code none;
  const fs::file_status status = fs::symlink_status(inside, none);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status))
    throw Error("{} is in the way of a folder of that name: move it away, or take another folder", inside.string());
  const auto nothing = [](const std::string&) { return false; };
  const bool may_be_ours = holds_run(directory);
  for (std::size_t n = 1; fs::exists(inside / segment_name(n), none); ++n)
    require_own(inside / segment_name(n), may_be_ours ? is_hdf5 : +nothing);
}

}  // namespace

void require_no_checkpoint(const fs::path& directory) {
  if (!checkpoints_in(directory).empty())
    throw Error(
        "{0} holds a checkpoint of a run that did not reach its end: `seiche resume {0}` goes on from it (of a call of "
        "seiche.solve the same call), --restart removes it and begins anew, and another folder keeps both",
        directory.string());
}

void require_ended(const fs::path& directory) {
  if (!fs::exists(directory / "summary.json") && !checkpoints_in(directory).empty())
    throw Error(
        "{0} holds a run that is going on, or was killed: in the latter case `seiche resume {0}` goes on from its "
        "checkpoint, and `seiche recover {0}` makes readable what it vouches for",
        directory.string());
}

void require_own_report(const fs::path& directory) { require_own(directory / "report.html", is_report); }

void require_own_files(const fs::path& directory, RunKind kind, bool report) {
  for (const RunFile& file : files)
    if (kind == RunKind::run ? file.of_run : file.of_ensemble) require_own(directory / file.name, file.is_ours);
  require_own_segments(directory);
  if (report) require_own_report(directory);
}

bool is_complete(const fs::path& directory) {
  const auto has_all = [&](bool RunFile::*kind) {
    return std::all_of(files.begin(), files.end(), [&](const RunFile& file) {
      return !(file.*kind) || file.name == std::string_view("solution.xdmf") || fs::exists(directory / file.name);
    });
  };
  return has_all(&RunFile::of_run) || has_all(&RunFile::of_ensemble);
}

bool holds_joined_solution(const fs::path& directory) {
  try {
    return fs::exists(directory / solution_name) && SolutionReader(directory / solution_name).parts().empty();
  } catch (const Error&) {
    return false;
  }
}

void remove_own_report(const fs::path& directory) {
  std::error_code ignored;
  const fs::path path = directory / "report.html";
  if (!is_foreign(path, is_report)) fs::remove(path, ignored);
}

void remove_partial_files(const Folder& folder) {
  for (const RunFile& file : files) remove_file(folder, std::string(file.name) + ".partial");
  remove_file(folder, "report.html.partial");
}

void remove_what_tells_of_end(const Folder& folder) {
  for (const RunFile& file : files)
    if (file.tells_of_end) remove_own(folder, file);
  if (folder.is_at_its_path()) remove_own_report(folder.path());
}

void remove_earlier_results(const Folder& folder) {
  if (!holds_run(folder.path())) return;
  remove_checkpoints(folder);
  remove_segments(folder);
  for (const RunFile& file : files) remove_own(folder, file);
  remove_partial_files(folder);
}

}  // namespace seiche
