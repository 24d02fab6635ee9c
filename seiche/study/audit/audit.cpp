#include <seiche/config/case/case_file.hpp>
#include <seiche/config/data/case_value.hpp>
#include <seiche/config/data/initial_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/law/law.hpp>
#include <seiche/output/csv_table.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/record/run_folder.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/study/audit/audit.hpp>
#include <seiche/study/audit/audit_book.hpp>
#include <seiche/study/audit/audit_ensemble.hpp>
#include <seiche/study/audit/recorded_energies.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <utility>

namespace seiche {
namespace {

using Verdict = AuditEntry::Verdict;
using Json = nlohmann::ordered_json;

constexpr double ledger_round_off = 1e-13;  // relative to the largest |H|, per row

Json summary_of(const std::filesystem::path& file) {
  std::ifstream input(file);
  if (!input) throw Error("{} cannot be read", file.string());
  Json summary = Json::parse(input, nullptr, false);
  if (summary.is_discarded() || !summary.contains("energy") || !summary.contains("method"))
    throw Error("{} is no summary of a run", file.string());
  return summary;
}

class Auditor {
 public:
  // `lost`: the initial file, in whose place the spec has another one, where it is no longer there.
  Auditor(const std::filesystem::path& directory, RunSpec spec, const std::string& lost)
      : directory_(directory),
        spec_(std::move(spec)),
        problem_(make_problem(spec_)),
        energies_(problem_),
        energy_(CsvTable::read(directory / "energy.csv")),
        summary_(summary_of(directory / "summary.json")),
        t_(energy_.column("t")),
        H_(energy_.column("H")),
        increases_(largest_increases(directory, spec_)) {
    for (const double H : H_) largest_ = std::max(largest_, std::abs(H));
    if (!lost.empty()) begin_with_first_state(lost);
    const EnergyTerms start = energies_.of(problem_.initial);
    round_off_ = std::max(start.round_off(), 50 * epsilon * largest_);  // H may grow, where it is driven
    book_.compare_hashes(directory, hashes_in(directory / "summary.json"));
    const std::string claim = "H at the start is that of the initial data in case.toml";
    if (lost.empty()) {
      book_.compare(claim, start.sum(), H_.front(), start.round_off());
    } else {
      book_.add(claim, Verdict::not_checked, fmt::format("{} is no longer there", shortened_path(lost)));
    }
  }

  Audit run() {
    origin();
    times();
    final_state();
    if (has_states()) snapshots();
    summary();
    law();
    ledger();
    return book_.audit();
  }

 private:
  void begin_with_first_state(const std::string& lost) {
    spec_.initial = FileData{lost};
    const SolutionReader solution(directory_ / "solution.h5");
    if (static_cast<Index>(solution.fields().size()) * solution.points() == problem_.size() && solution.count() > 0)
      solution.state(0, problem_.initial);
  }

  // Files of two runs in one folder are no evidence of either.
  void origin() {
    std::vector<std::string> differences;
    const auto number = [&](const char* key) {
      const auto found = summary_.find(key);
      return found != summary_.end() && found->is_number() ? found->get<double>() : std::nan("");
    };
    const auto compare_number = [&](const char* key, double of_case) {
      if (number(key) != of_case)
        differences.push_back(
            fmt::format("{} = {:.17g} in case.toml and {:.17g} in summary.json", key, of_case, number(key)));
    };
    const std::string method = text("/method");
    if (method != spec_.method)
      differences.push_back(fmt::format("method = {} in case.toml and {} in summary.json", spec_.method, method));
    if (spec_.tolerance) {
      compare_number("tolerance", *spec_.tolerance);
    } else {
      compare_number("h", spec_.h);
    }
    const double t = number("t");
    const bool is_whole = summary_.value("status", Json()) == "success";
    if (is_whole ? t != spec_.t_end : !(t <= spec_.t_end))
      differences.push_back(fmt::format("end = {:.17g} in case.toml and t = {:.17g} in summary.json", spec_.t_end, t));
    if (t != t_.back())
      differences.push_back(fmt::format("t = {:.17g} in summary.json and {:.17g} in energy.csv", t, t_.back()));
    book_.add_differences("case.toml, summary.json and energy.csv are of one run", differences,
                          fmt::format("{}, the same {} and t = {:.6g} in all", method,
                                      spec_.tolerance ? "tolerance" : "h", t));
  }

  // From the start on and rising; with steps of one size after every energy_every of them, and so many as there are.
  void times() {
    const std::string claim = "energy.csv has the rows of this run, one after the other";
    const double apart = spec_.h * static_cast<double>(spec_.energy_every);
    const auto contradict = [&](std::string evidence) { book_.add(claim, Verdict::contradicted, std::move(evidence)); };
    const auto is_expected = [&](std::size_t i) {
      if (i == 0) return t_[0] == spec_.t_start;
      if (!(t_[i] > t_[i - 1])) return false;
      const bool is_any_time = spec_.tolerance || i + 1 == t_.size();
      return is_any_time || std::abs(t_[i] - spec_.t_start - static_cast<double>(i) * apart) <= 1e-9 * spec_.duration();
    };
    for (const std::string& name : energy_.names) {
      const std::vector<double> values = energy_.column(name);
      const auto none = std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
      if (none != values.end())
        return contradict(fmt::format("row {} has {} = {}", none - values.begin() + 1, name, *none));
    }
    for (std::size_t i = 0; i < t_.size(); ++i)
      if (!is_expected(i))
        return contradict(fmt::format("row {} is at t = {:.17g}{}", i + 1, t_[i],
                                      i == 0 ? "" : fmt::format(", after {:.17g}", t_[i - 1])));
    if (!spec_.tolerance) {
      const double steps = std::ceil((t_.back() - spec_.t_start) / spec_.h - 1e-6);
      const Json written = summary_.value("steps", Json());
      if (written.is_number() && written.get<double>() != steps)
        return contradict(fmt::format("t = {:.6g} takes {} steps of h = {:.6g}, and summary.json says {}", t_.back(),
                                      steps, spec_.h, written.get<double>()));
      const double rows = std::ceil(steps / static_cast<double>(spec_.energy_every) - 1e-9) + 1;
      if (static_cast<double>(t_.size()) != rows)
        return contradict(fmt::format("{} rows, where the run has {}", t_.size(), rows));
    }
    book_.add(claim, Verdict::confirmed,
              fmt::format("{} rows from t = {:.6g} to {:.6g}", t_.size(), spec_.t_start, t_.back()));
  }

  void case_of(const SolutionReader& solution) {
    const std::string claim = "solution.h5 is of the case in case.toml";
    const std::string inside = solution.text("case");
    if (inside.empty()) return book_.add(claim, Verdict::not_checked, "it does not say of which case it is");
    const std::string beside = text_of_file(directory_ / "case.toml");
    // A comment makes no other case, nor does another folder.
    const bool same = inside == case_in_any_folder(spec_) || inside == beside || inside == write_case(spec_);
    book_.add(claim, same ? Verdict::confirmed : Verdict::contradicted,
              same ? "the case that it holds says the same" : "the case that it holds says something else");
  }

  void final_state() {
    const EnergyTerms end = energies_.of(read_initial_file(directory_ / "final.txt", problem_));
    book_.compare("the last H is that of final.txt", end.sum(), H_.back(), std::max(round_off_, end.round_off()));
  }
  // A run whose disk was full may have left none.
  bool has_states() const {
    return summary_.value("status", Json()) != "failed" || std::filesystem::exists(directory_ / "solution.h5");
  }

  // H of every state in solution.h5 against the H beside it, and against energy.csv where that has the time too.
  void snapshots() {
    const SolutionReader solution(directory_ / "solution.h5");
    solution.require_whole();
    if (static_cast<Index>(solution.fields().size()) * solution.points() != problem_.size())
      throw Error("solution.h5 has {} values at a time and the case {} unknowns",
                  static_cast<Index>(solution.fields().size()) * solution.points(), problem_.size());
    case_of(solution);
    const std::vector<double> times = solution.times();
    const std::vector<double> beside = solution.energies();
    const std::vector<double> modified = solution.modified_energies();
    const std::vector<double> modified_in_rows =
        energy_.has("H_modified") ? energy_.column("H_modified") : std::vector<double>();
    const std::string claim = "H of every state in solution.h5 is what it and energy.csv say";
    if (times.empty()) return book_.add(claim, Verdict::not_checked, "it holds no state");
    std::size_t in_both = 0;
    double worst = 0;
    double at = 0;
    Vector z;
    for (std::size_t k = 0; k < times.size(); ++k) {
      solution.state(static_cast<Index>(k), z);
      if (std::string wrong = invalid_value(times, beside, modified, z, k); !wrong.empty())
        return book_.add(claim, Verdict::contradicted, std::move(wrong));
      const EnergyTerms terms = energies_.of(z);
      const double allowed = std::max({terms.round_off(), round_off_, std::numeric_limits<double>::min()});
      double ratio = std::abs(terms.sum() - beside[k]) / allowed;
      const auto found = std::lower_bound(t_.begin(), t_.end(), times[k]);
      if (found != t_.end() && *found == times[k]) {
        const auto row = static_cast<std::size_t>(found - t_.begin());
        ratio = worse(ratio, std::abs(terms.sum() - H_[row]) / allowed);
        if (!modified.empty() && !modified_in_rows.empty())
          ratio = worse(ratio, std::abs(modified[k] - modified_in_rows[row]) /
                                   std::max(allowed, 50 * epsilon * std::abs(modified[k])));
        ++in_both;
      }
      if (worse(ratio, worst) == worst || std::isnan(worst)) continue;
      worst = ratio;
      at = times[k];
    }
    if (in_both == 0)
      return book_.add(claim, Verdict::contradicted,
                       fmt::format("{} states, and none of them at a time of energy.csv", times.size()));
    book_.add(
        claim, worst <= 1 ? Verdict::confirmed : Verdict::contradicted,
        fmt::format("{} states, {} of them at times of energy.csv; the largest difference, at t = {:.6g}, is {:.2g} of "
                    "what round-off explains",
                    times.size(), in_both, at, worst));
  }

  // NaN is the worst of all.
  static double worse(double a, double b) { return std::isnan(a) ? a : std::isnan(b) ? b : std::max(a, b); }

  // What of state k is not finite, or that its time is not after the one before; else "".
  static std::string invalid_value(const std::vector<double>& times, const std::vector<double>& energies,
                                   const std::vector<double>& modified, const Vector& z, std::size_t k) {
    if (!std::isfinite(times[k]) || (k > 0 && !(times[k] > times[k - 1])))
      return fmt::format("state {} is at t = {:.17g}{}", k + 1, times[k],
                         k == 0 ? "" : fmt::format(", after {:.17g}", times[k - 1]));
    if (!std::isfinite(energies[k])) return fmt::format("H at t = {:.6g} is {}", times[k], energies[k]);
    if (!modified.empty() && !std::isfinite(modified[k]))
      return fmt::format("the modified energy at t = {:.6g} is {}", times[k], modified[k]);
    for (Index i = 0; i < z.size(); ++i)
      if (!std::isfinite(z[i])) return fmt::format("value {} of the state at t = {:.6g} is {}", i + 1, times[k], z[i]);
    return "";
  }

  void summary() {
    const auto number = [this](const char* path) {
      const Json value = in_summary(path);
      return value.is_number() ? value.get<double>() : std::nan("");
    };
    book_.compare("energy.initial of summary.json is the first H", H_.front(), number("/energy/initial"), 0);
    book_.compare("energy.final of summary.json is the last H", H_.back(), number("/energy/final"), 0);
    largest_rise(number("/energy/max_increase"));
  }

  // Of summary.json, which may be damaged; null, or "", where there is no such thing.
  Json in_summary(const char* path) const {
    const Json::json_pointer place(path);
    return summary_.contains(place) ? summary_.at(place) : Json();
  }
  std::string text(const char* path) const {
    const Json value = in_summary(path);
    return value.is_string() ? value.get<std::string>() : "";
  }

  // Between two rows of a file no step rises by more than the largest rise of a step.
  void largest_rise(double written) {
    if (increases_.of_all)
      return book_.compare("energy.max_increase of summary.json is the largest of energy.csv and solution.h5",
                           increases_.H, written, 0);
    const double most = std::max(1.0, written > 0 ? steps_between_rows() : 1.0) * written + 50 * epsilon * largest_;
    book_.add(
        "energy.max_increase of summary.json explains those of energy.csv and solution.h5",
        increases_.H <= most ? Verdict::confirmed : Verdict::contradicted,
        fmt::format("{:.3g} in a step, as it says, makes {:.3g} at most between two rows, and the largest is {:.3g}",
                    written, most, increases_.H));
  }
  double steps_between_rows() const { return static_cast<double>(std::max<std::int64_t>(1, spec_.energy_every)); }

  // The energy that the law is about, with the tolerance of a run: 50ε of its terms for every step between two rows.
  void law() {
    const bool modified = has_modified_energy(simulation_options(spec_));
    const std::string verdict = text("/energy/law");
    const std::string claim = fmt::format("the law of {} {}", modified ? "the modified energy" : "H", verdict);
    if (modified && !energy_.has("H_modified"))
      return book_.add(claim, Verdict::contradicted,
                       fmt::format("energy.csv has no column H_modified, and {} keeps that law", spec_.method));
    const std::string objection = objection_of(spec_);
    const LawPromise promise =
        objection.empty() ? promise_energy_law(problem_, spec_.t_end) : LawPromise{false, objection};
    promised_ = promise.promised;
    const double increase = modified ? increases_.modified : increases_.H;
    const double allowed = 2 * round_off_ * steps_between_rows();
    const std::string evidence =
        fmt::format("largest increase {:.3g}, round-off explains about {:.3g}; {}", increase, allowed,
                    promise.promised ? "promised: " + promise.reason : "not promised: " + promise.reason);
    if (verdict == "not promised" || verdict == "not tested") return book_.add(claim, Verdict::not_checked, evidence);
    const bool holds = increase <= allowed;
    if (verdict == "violated" && holds && !increases_.of_all)
      return book_.add(claim, Verdict::not_checked, evidence + "; the step that broke it is in none of the files");
    book_.add(claim, promise.promised && holds == (verdict == "holds") ? Verdict::confirmed : Verdict::contradicted,
              evidence);
  }

  void ledger() {
    const std::string claim = "the columns of the ledger add up to the change of H";
    if (!energy_.has("damping_left"))
      return book_.add(claim, Verdict::not_checked, "the run kept none; output.ledger = \"on\" does");
    std::vector<std::vector<double>> columns;
    for (const LedgerPart& part : ledger_parts())
      if (energy_.has(std::string(part.name))) columns.push_back(energy_.column(std::string(part.name)));
    if (energy_.has("round_off")) columns.push_back(energy_.column("round_off"));
    double worst = 0;
    double unexplained = 0;
    double total = 0;
    for (std::size_t i = 1; i < H_.size(); ++i) {
      double sum = 0;
      for (const auto& column : columns) sum += column[i];
      total += sum;
      worst = std::max(worst, std::abs(sum - (H_[i] - H_[i - 1])));
      unexplained = std::max(unexplained, std::abs(columns.back()[i]));
    }
    const double allowed = ledger_round_off * largest_;
    const bool sums = worst <= allowed && std::abs(total - (H_.back() - H_.front())) <= allowed;
    book_.add(claim, sums ? Verdict::confirmed : Verdict::contradicted,
              fmt::format("{} rows; the sum of all is {:.17g} and H(end) − H(start) is {:.17g}", H_.size() - 1, total,
                          H_.back() - H_.front()));
    if (problem_.forces.empty() && !problem_.friction && energy_.has("work")) {
      const std::vector<double> work = energy_.column("work");
      const bool none = std::all_of(work.begin() + 1, work.end(), [](double w) { return w == 0; });
      book_.add("without a force none does work", none ? Verdict::confirmed : Verdict::contradicted,
                none ? "the column is 0" : "the column is not 0");
    }
    const double explained = 4 * round_off_ * steps_between_rows();
    if (promised_) {
      double fed = 0;
      for (const char* part : {"damping_left", "damping_right"})
        if (energy_.has(part))
          for (const double row : energy_.column(part)) fed = std::max(fed, row);
      book_.add("damping feeds no energy in any row", fed <= explained ? Verdict::confirmed : Verdict::contradicted,
                fmt::format("at most {:.2g}, and round-off explains {:.2g}", fed, explained));
    }
    book_.add("what the ledger calls round-off is no more than that",
              unexplained <= explained ? Verdict::confirmed : Verdict::contradicted,
              fmt::format("at most {:.2g} a row, and {:.2g} is explained", unexplained, explained));
  }

  std::filesystem::path directory_;
  RunSpec spec_;
  Problem problem_;
  RecomputedEnergy energies_;
  CsvTable energy_;
  Json summary_;
  std::vector<double> t_, H_;
  LargestIncreases increases_;
  double largest_ = 0, round_off_ = 0;
  bool promised_ = false;  // the law
  AuditBook book_;
};

// The case of a run; where its initial file is no longer there, `lost` is the name of that, and final.txt in its place.
RunSpec case_of_run(const std::filesystem::path& directory, std::string& lost) {
  try {
    return read_case(directory / "case.toml");
  } catch (const Error&) {
    for (const auto& [file, hash] : hashes_in(directory / "summary.json"))
      if (file != "case.toml" && !std::filesystem::exists(file)) lost = file;
    if (lost.empty()) throw;
  }
  const std::string stand_in = toml_string(std::filesystem::absolute(directory / "final.txt").string());
  return read_case(directory / "case.toml", {fmt::format("problem.initial={{file={}}}", stand_in)});
}

// A pipe in the place of one of them would be waited for.
void require_plain_files(const std::filesystem::path& directory) {
  for (const char* name :
       {"case.toml", "energy.csv", "solution.h5", "final.txt", "summary.json", "members.csv", "finals.csv"}) {
    const std::filesystem::path file = directory / name;
    const std::string complaint = complaint_about_file(file);
    if (!complaint.empty() && look_at(file).kind != InputKind::missing) throw Error("{} {}", file.string(), complaint);
  }
}

}  // namespace

bool Audit::confirms() const {
  bool something = false;
  for (const AuditEntry& entry : entries) {
    if (entry.verdict == Verdict::contradicted) return false;
    something = something || entry.verdict == Verdict::confirmed;
  }
  return something;
}

Audit audit(const std::filesystem::path& directory) {
  if (!std::filesystem::is_directory(directory)) throw Error("{} is no directory of a run", directory.string());
  require_plain_files(directory);
  require_ended(directory);
  if (look_at(directory / "case.toml").kind == InputKind::missing)
    throw Error("{} is no directory of a finished run: it has no case.toml", directory.string());
  if (std::filesystem::exists(directory / "solution.h5")) require_readable(directory / "solution.h5");
  std::string lost;
  RunSpec spec = case_of_run(directory, lost);
  return spec.ensemble ? audit_ensemble(directory, spec) : Auditor(directory, std::move(spec), lost).run();
}

std::string to_string(AuditEntry::Verdict verdict) {
  switch (verdict) {
    case Verdict::confirmed: return "confirmed";
    case Verdict::contradicted: return "contradicted";
    case Verdict::not_checked: return "not checked";
  }
  return "unknown";
}

}  // namespace seiche
