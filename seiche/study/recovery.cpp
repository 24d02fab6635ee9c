#include <seiche/backend/backends.hpp>
#include <seiche/config/case/case_file.hpp>
#include <seiche/core/error.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/output/csv_table.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/file/reserve_file.hpp>
#include <seiche/output/final_state.hpp>
#include <seiche/output/run_folder.hpp>
#include <seiche/output/solution_file.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/output/summary.hpp>
#include <seiche/output/xdmf.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/study/killed_ensemble.hpp>
#include <seiche/study/recorded_energies.hpp>
#include <seiche/study/recovery.hpp>
#include <seiche/study/versions.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>

namespace seiche {
namespace {

namespace fs = std::filesystem;

constexpr const char* case_name = "case.toml";

// What energy.csv says about a run.
struct Energies {
  double first_t = 0, last_t = 0;
  std::size_t rows = 0;
  EnergySummary H, modified;  // but for the largest increases
  bool has_modified = false;
};

void follow(EnergySummary& summary, double value, std::size_t row) {
  if (row == 0) summary.initial = value;
  summary.final = value;
}

Energies read_energies(const fs::path& file) {
  CsvReader reader(file);
  const std::size_t t = column_of(reader, "t", file), H = column_of(reader, "H", file);
  const std::optional<std::size_t> modified = find_column(reader, "H_modified");
  Energies found;
  found.has_modified = modified.has_value();
  for (std::vector<double> row; reader.next(row); ++found.rows) {
    if (found.rows == 0) found.first_t = row[t];
    found.last_t = row[t];
    follow(found.H, row[H], found.rows);
    if (modified) follow(found.modified, row[*modified], found.rows);
  }
  return found;
}

class Rescue {
 public:
  Rescue(const Folder& folder, const std::string& saved_case)
      : folder_(folder),
        directory_(folder.path()),
        has_checkpoint_(!saved_case.empty()),
        spec_(read_case(case_file(saved_case))) {}

  Recovery run() {
    if (is_of_new_end_ || (has_checkpoint_ && has("energy.csv.partial"))) forget_earlier_end();
    tables();
    spec_.ensemble ? members() : solution();
    // A run that had ended all but for its states tells of more than there is.
    if (has("summary.json") && !has("solution.h5") && is_solution_lost_) remove_file(folder_, "summary.json");
    if (!has("summary.json")) has("energy.csv") ? summary() : summary_without_rows();
    // These can be had again, or are no longer needed.
    for (const char* name : {"checkpoint.seiche.partial", "checkpoint_prev.seiche.partial", "solution.xdmf.partial",
                             "report.html.partial", "summary.json.partial", "case.toml.partial", "members.csv.partial",
                             "finals.csv.partial", reserve_name, settling_name})
      remove_file(folder_, name);
    if (unfinished_files(directory_).empty())  // without a row
      for (const char* name : {"energy.csv.partial", "solution.h5.partial"}) remove_file(folder_, name);
    if (has("final.txt")) remove_file(folder_, "final.txt.partial");
    return found_;
  }

 private:
  fs::path case_file(const std::string& saved_case) {
    const fs::path file = directory_ / case_name;
    if (has_checkpoint_ && !is_case_of_run(file, saved_case)) restore_case(saved_case);
    if (!has(case_name)) throw Error("{} holds no run: there is no {} in it", directory_.string(), case_name);
    return file;
  }

  // A run that goes on to another end may have been killed before that stood in case.toml.
  bool is_case_of_run(const fs::path& file, const std::string& saved_case) const {
    const bool has_gone_on = has("energy.csv.partial") || has("solution.h5.partial");
    if (!has(case_name) || (has_gone_on && text_of_file(file) != saved_case)) return false;
    try {
      read_case(file);
      return true;
    } catch (const Error&) {
      return false;
    }
  }

  void restore_case(const std::string& saved_case) {
    std::string said = "case.toml, from the checkpoint";
    if (look_at(directory_ / case_name).kind != InputKind::missing)
      said += "; what was there is " + put_aside(folder_, case_name, "case_before_recover.toml");
    is_of_new_end_ = has("energy.csv.partial") || has("solution.h5.partial");
    write_file(folder_, case_name, saved_case);
    found_.saved.push_back(said);
  }

  // What was written when the run stopped from which this one went on. At an end of its own energy.csv gets its name
  // first, so that no energy.csv.partial is left beside these.
  void forget_earlier_end() {
    for (const char* name : {"summary.json", "final.txt", "solution.xdmf"}) remove_file(folder_, name);
    remove_own_report(directory_);
  }

  // A link under such a name leads to a file that is not the run's.
  bool has(const char* name) const {
    std::error_code not_there;
    return fs::is_regular_file(fs::symlink_status(directory_ / name, not_there));
  }

  void tables() {
    if (!has("energy.csv.partial")) return;
    const fs::path partial = directory_ / "energy.csv.partial";
    const std::uintmax_t whole = end_of_lines(partial), all = fs::file_size(partial);
    if (whole < all) {
      fs::resize_file(partial, whole);
      found_.lost.push_back(fmt::format("{} bytes of a last line of energy.csv that is not whole", all - whole));
    }
    std::size_t rows = 0;
    if (whole > 0) {
      CsvReader reader(partial);
      for (std::vector<double> row; reader.next(row);) ++rows;
    }
    if (rows == 0) {
      found_.lost.emplace_back("all of energy.csv, which has no row yet");
      return;
    }
    PartialPath(folder_, "energy.csv").commit();
    found_.saved.push_back(fmt::format("energy.csv, {} rows", rows));
  }

  void solution() {
    if (has("solution.h5.partial") && unfinished_files(directory_).find("solution.h5") == std::string::npos) {
      found_.lost.emplace_back("all of solution.h5, which has no row yet");
      is_solution_lost_ = true;
    } else if (has("solution.h5.partial")) {
      try {
        rescue_solution();
      } catch (const Error& error) {
        found_.lost.push_back(fmt::format("solution.h5.partial, which is left as it is: {}", error.what()));
      }
    }
    if (!has("solution.h5")) return;
    const SolutionReader solution(directory_ / "solution.h5");
    if (solution.count() == 0) return;
    if (!has("final.txt")) {
      Vector state;
      solution.state(solution.count() - 1, state);
      write_final_state(folder_, state);
      found_.saved.push_back(fmt::format("final.txt, the state at t = {:.9g}, the last in solution.h5",
                                         solution.time(solution.count() - 1)));
    }
    if (has("solution.xdmf")) return;
    write_xdmf(folder_, "solution.h5", solution_layout(make_problem(spec_)));
    found_.saved.emplace_back("solution.xdmf");
  }

  // Every row is read before the file gets its name.
  void rescue_solution() {
    const fs::path partial = directory_ / "solution.h5.partial";
    std::optional<SolutionReader> solution(partial);
    const Index count = solution->count();
    Vector state;
    for (Index k = 0; k < count; ++k) solution->state(k, state);
    const double last = solution->time(count - 1);
    const std::uint64_t cut = solution->surplus();
    solution.reset();
    if (cut > 0) {
      cut_solution(folder_, "solution.h5.partial");
      found_.lost.push_back(fmt::format("{} values of solution.h5 at times for which others are missing", cut));
    }
    PartialPath(folder_, "solution.h5").commit();
    found_.saved.push_back(fmt::format("solution.h5, {} times up to t = {:.9g}", count, last));
  }

  // Of an ensemble that has ended members.csv and finals.csv are there, in this order.
  void members() {
    if (!has("members.csv"))
      found_.lost.emplace_back("the members of the ensemble, whose files are written when all have ended");
    else if (!has("finals.csv"))
      found_.lost.emplace_back("finals.csv, the last states of the members");
  }

  void summary() {
    const fs::path file = directory_ / "energy.csv";
    if (std::vector<double> row; !CsvReader(file).next(row)) return;
    if (spec_.ensemble) return write_summary(summary_of_killed_ensemble(directory_, spec_));
    const Energies energies = read_energies(file);
    RunReport report;
    report.message = fmt::format(
        "the run ended, killed or without a disk to write to, before its files were whole; `seiche recover` found rows up "
        "to t = {:.9g} of {:.9g}; no energy law is promised: it was not judged",
        energies.last_t, spec_.t_end);
    report.t = energies.last_t;
    const LargestIncreases increases = largest_increases(directory_, spec_);
    report.energy = energies.H;
    report.energy.max_increase = increases.H;
    report.has_modified_energy = energies.has_modified;
    report.modified = energies.modified;
    report.modified.max_increase = increases.modified;
    if (!spec_.tolerance)
      report.steps = static_cast<std::int64_t>(std::ceil((energies.last_t - energies.first_t) / spec_.h - 1e-6));
    write_summary(report);
  }

  // So that the folder says what it holds. A case that was written by a person is of no run.
  void summary_without_rows() {
    if (spec_.ensemble || text_of_file(directory_ / case_name) != write_case(spec_)) return;
    RunReport report;
    report.message = "the run ended, killed or without a disk to write to, before it had written a row";
    report.t = report.energy.initial = report.energy.final = report.energy.max_increase = std::nan("");
    write_summary(report);
  }

  void write_summary(RunReport& report) {
    report.wall_seconds = std::nan("");
    const Problem problem = make_problem(spec_);
    const RunIdentity identity{.problem = problem.name,
                               .method = spec_.method,
                               .backend = spec_.backend == "auto" ? std::string(automatic_backend(problem).name)
                                                                  : spec_.backend,
                               .h = spec_.tolerance ? std::nan("") : spec_.h,
                               .tolerance = spec_.tolerance,
                               .versions = versions_in_use()};
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(summary_json(identity, report));
    json["status"] = "unfinished";
    if (spec_.tolerance) json["steps"] = nullptr;
    json["counts"] = nullptr;  // the counts up to the end are not known
    write_summary(json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }

  void write_summary(const std::string& json) {
    write_file(folder_, "summary.json", json);
    found_.saved.emplace_back("summary.json, with the status unfinished");
  }

  Folder folder_;
  fs::path directory_;
  Recovery found_;
  bool has_checkpoint_;
  bool is_solution_lost_ = false;
  bool is_of_new_end_ = false;  // a run that went on, and not yet its case.toml
  RunSpec spec_;
};

}  // namespace

Recovery recover(const Folder& folder, const std::string& saved_case) { return Rescue(folder, saved_case).run(); }

}  // namespace seiche
