#include <seiche/core/error.hpp>
#include <seiche/output/file/reserve_file.hpp>
#include <seiche/output/run_folder.hpp>
#include <seiche/output/solution_file.hpp>
#include <seiche/output/solution_reader.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {
namespace {

namespace fs = std::filesystem;

struct RunFile {
  const char* name;
  bool of_run, of_ensemble;
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
bool is_hdf5(const std::string& text) { return begins_with<1>(text, {"\x89HDF\r\n\x1a\n"}); }
bool is_xdmf(const std::string& text) { return begins_with<1>(text, {"<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf"}); }
bool is_report(const std::string& text) { return text.find(report_mark) != std::string::npos; }

// One number in a line, and nothing to tell ours from another's by.
bool is_state(const std::string& text) { return text.find_first_not_of("0123456789+-.einfa\n") == std::string::npos; }

// As every run writes it anew: all sections, and no comment of a person.
bool is_settled_case(const std::string& text) {
  return text.starts_with("[problem]\nname = ") && text.find("\n[output]\ndirectory = ") != std::string::npos &&
         !text.starts_with('#') && text.find("\n#") == std::string::npos;
}

// By the case an earlier run is known, so that it goes last.
constexpr std::array files = {
    RunFile{"energy.csv", true, true, is_energies},  RunFile{"solution.h5", true, false, is_hdf5},
    RunFile{"solution.xdmf", true, false, is_xdmf},  RunFile{"final.txt", true, false, is_state},
    RunFile{"members.csv", false, true, is_members}, RunFile{"finals.csv", false, true, is_members},
    RunFile{"summary.json", true, true, is_summary}, RunFile{"case.toml", true, true, is_settled_case}};

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

void require_own(const fs::path& path, bool (*is_ours)(const std::string&)) {
  if (is_foreign(path, is_ours))
    throw Error("{} would be replaced, and Seiche did not write it: move it away, or take another folder",
                path.string());
}

std::string in_bytes(std::uintmax_t size) {
  constexpr double kilo = 1e3, mega = 1e6;
  const auto bytes = static_cast<double>(size);
  if (bytes < kilo) return fmt::format("{} bytes", size);
  return bytes < mega ? fmt::format("{:.1f} kB", bytes / kilo) : fmt::format("{:.1f} MB", bytes / mega);
}

bool holds_rows_of_text(const fs::path& path) {
  const std::string text = beginning_of(path);
  return std::count(text.begin(), text.end(), '\n') > 1;  // one is the header
}

// What cannot be read may hold something all the same; but without its first bytes a file has never had a row.
bool holds_rows_of_solution(const fs::path& path) {
  if (!is_hdf5(beginning_of(path))) return false;
  try {
    return SolutionReader(path).count() > 0;
  } catch (const Error&) {
    return true;
  }
}

}  // namespace

std::string unfinished_files(const fs::path& directory) {
  const auto holds_rows = [](const fs::path& path) {
    std::error_code none;
    if (!fs::is_regular_file(fs::symlink_status(path, none)) || fs::file_size(path, none) == 0) return false;
    return path.stem() == "energy.csv" ? holds_rows_of_text(path) : holds_rows_of_solution(path);
  };
  std::vector<std::string> found;
  for (const char* name : {"energy.csv.partial", "solution.h5.partial"})
    if (const fs::path path = directory / name; holds_rows(path))
      found.push_back(fmt::format("{} ({})", name, in_bytes(fs::file_size(path))));
  return fmt::format("{}", fmt::join(found, " and "));
}

void require_finished(const fs::path& directory) {
  const std::string files = unfinished_files(directory);
  if (!files.empty())
    throw Error(
        "{0} holds a run that did not finish, {1}: `seiche recover {0}` makes it readable, `seiche run` with "
        "--restart removes it and begins anew, and another folder keeps both",
        directory.string(), files);
  if (fs::exists(directory / "energy.csv") &&
      beginning_of(directory / "summary.json").starts_with("{\n  \"status\": \"unfinished\""))
    throw Error(
        "{} holds what `seiche recover` saved of a run that did not finish: take another folder, or "
        "`seiche run` with --restart, which removes it and begins anew",
        directory.string());
}

void require_recovered(const fs::path& directory) {
  const std::string files = unfinished_files(directory);
  if (!files.empty())
    throw Error(
        "{0} holds a run that is going on, or did not finish, {1}: in the latter case `seiche recover "
        "{0}` makes it readable",
        directory.string(), files);
}

void require_own_report(const fs::path& directory) { require_own(directory / "report.html", is_report); }

void require_own_files(const fs::path& directory, RunKind kind, bool report) {
  for (const RunFile& file : files)
    if (kind == RunKind::run ? file.of_run : file.of_ensemble) require_own(directory / file.name, file.is_ours);
  if (report) require_own_report(directory);
}

void remove_own_report(const fs::path& directory) {
  std::error_code ignored;
  const fs::path path = directory / "report.html";
  if (!is_foreign(path, is_report)) fs::remove(path, ignored);
}

void remove_earlier_results(const fs::path& directory) {
  // Without a case of ours nothing beside it is known to be ours, whatever it is called.
  if (!fs::exists(directory / "case.toml") || is_foreign(directory / "case.toml", is_settled_case)) return;
  std::error_code ignored;
  for (const RunFile& file : files) {
    const fs::path path = directory / file.name;
    if (!is_foreign(path, file.is_ours)) fs::remove(path, ignored);
    fs::remove(path.string() + ".partial", ignored);  // of a run that was killed
  }
  for (const char* name : {reserve_name, settling_name}) fs::remove(directory / name, ignored);
}

}  // namespace seiche
