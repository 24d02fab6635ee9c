#include <seiche/core/base/error.hpp>
#include <seiche/ensemble/members.hpp>
#include <seiche/ensemble/statistics.hpp>
#include <seiche/law/law.hpp>
#include <seiche/output/csv_table.hpp>
#include <seiche/output/text_table.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/study/audit/audit_book.hpp>
#include <seiche/study/audit/audit_ensemble.hpp>
#include <seiche/study/member_counts.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace seiche {
namespace {

using Json = nlohmann::ordered_json;
using Verdict = AuditEntry::Verdict;

// Of the columns H_mean … H_max, and of their keys in summary.json.
struct Statistic {
  const char* name;
  double Statistics::*value;
};
constexpr std::array<Statistic, 7> all_statistics = {{{"mean", &Statistics::mean},
                                                      {"sd", &Statistics::standard_deviation},
                                                      {"min", &Statistics::minimum},
                                                      {"q05", &Statistics::low},
                                                      {"median", &Statistics::median},
                                                      {"q95", &Statistics::high},
                                                      {"max", &Statistics::maximum}}};

Json ensemble_summary(const std::filesystem::path& file) {
  std::ifstream input(file);
  if (!input) throw Error("{} cannot be read", file.string());
  Json summary = Json::parse(input, nullptr, false);
  if (!summary.is_object() || !summary.contains("energy") || !summary.contains("members"))
    throw Error("{} is no summary of an ensemble", file.string());
  return summary;
}

std::map<std::size_t, Vector> read_finals(const std::filesystem::path& file) {
  CsvReader reader(file);
  std::map<std::size_t, Vector> finals;
  for (std::vector<double> row; reader.next(row);)
    finals[static_cast<std::size_t>(row.front()) - 1] =
        Eigen::Map<const Vector>(row.data() + 1, static_cast<Index>(row.size()) - 1);
  return finals;
}

// H of the states of members, of which many share a problem.
class MemberEnergies {
 public:
  EnergyTerms of(const EnsembleMember& member, const Vector& physical) {
    if (member.problem != problem_) {
      problem_ = member.problem;
      energy_.emplace(*problem_);
    }
    return energy_->of(physical);
  }

 private:
  std::shared_ptr<const Problem> problem_;
  std::optional<RecomputedEnergy> energy_;
};

// The largest of the ratios distance/allowed, and whose it is; NaN is the worst of all.
class Worst {
 public:
  void add(std::size_t member, double distance, double allowed) {
    ++count_;
    const double ratio = distance / std::max(allowed, std::numeric_limits<double>::min());
    if (ratio <= ratio_ || std::isnan(ratio_)) return;
    ratio_ = ratio;
    member_ = member;
  }
  std::size_t count() const { return count_; }
  Verdict verdict() const {
    if (count_ == 0) return Verdict::not_checked;
    return ratio_ <= 1 ? Verdict::confirmed : Verdict::contradicted;
  }
  std::string text() const {
    if (count_ == 0) return "no member has one";
    return fmt::format("{} members; the largest difference, of member {}, is {:.2g} of what round-off explains", count_,
                       member_ + 1, ratio_);
  }

 private:
  std::size_t count_ = 0, member_ = 0;
  double ratio_ = 0;
};

void compare_origin(AuditBook& book, const RunSpec& spec, const CsvTable& energy, const Json& summary) {
  std::vector<std::string> differences;
  const auto compare = [&](const char* what, const auto& of_case, const auto& of_summary) {
    if (of_case != of_summary)
      differences.push_back(fmt::format("{} = {} in case.toml and {} in summary.json", what, of_case, of_summary));
  };
  const auto number = [&](const char* key) {
    return summary.contains(key) && summary[key].is_number() ? summary[key].get<double>() : std::nan("");
  };
  compare("method", spec.method,
          summary.value("method", Json()).is_string() ? summary["method"].get<std::string>() : "");
  compare("h", spec.h, number("h"));
  compare("members", static_cast<double>(spec.ensemble->count()), number("members"));
  const double t = energy.column("t").back();
  if (number("t") != t)
    differences.push_back(fmt::format("t = {} in summary.json and {} in energy.csv", number("t"), t));
  book.add_differences("case.toml, summary.json and energy.csv are of one ensemble", differences,
                       fmt::format("{}, h = {} and {} members in all", spec.method, spec.h, spec.ensemble->count()));
}

class EnsembleAuditor {
 public:
  EnsembleAuditor(const std::filesystem::path& directory, const RunSpec& spec)
      : spec_(spec),
        members_(make_members(spec)),
        table_(directory / "members.csv"),
        finals_(read_finals(directory / "finals.csv")),
        energy_(CsvTable::read(directory / "energy.csv")),
        summary_(ensemble_summary(directory / "summary.json")) {
    book_.compare_hashes(directory, hashes_in(directory / "summary.json"));
    if (table_.rows() != members_.list.size())
      throw Error("{} has {} rows and case.toml {} members", (directory / "members.csv").string(), table_.rows(),
                  members_.list.size());
    for (std::size_t m = 0; m < table_.rows(); ++m) {
      initial_.push_back(energies_.of(members_.list[m], members_.list[m].initial));
      for (const char* column : {"H_initial", "H_final"})
        if (const double H = table_.number(m, column); std::isfinite(H)) largest_ = std::max(largest_, std::abs(H));
    }
  }

  Audit run() {
    compare_origin(book_, spec_, energy_, summary_);
    parameters();
    initial_energies();
    final_energies();
    statistics_of_rows();
    counts();
    law();
    return book_.audit();
  }

 private:
  double round_off() const { return 50 * epsilon * largest_; }
  bool has_started(std::size_t m) const {
    return !table_.text(m, "H_initial").empty() && std::isfinite(initial_[m].sum());
  }
  // Members that ended earlier are in no statistics of the last row.
  bool is_in_last_row(std::size_t m) const { return table_.number(m, "t") == energy_.column("t").back(); }

  void parameters() {
    std::vector<std::string> differences;
    for (std::size_t m = 0; m < members_.list.size() && differences.empty(); ++m)
      for (std::size_t p = 0; p < members_.parameters.size(); ++p)
        if (const double written = table_.number(m, members_.parameters[p]); written != members_.values[m][p])
          differences.push_back(fmt::format("member {} has {} = {:.17g} by the case and {:.17g} in members.csv", m + 1,
                                            members_.parameters[p], members_.values[m][p], written));
    book_.add_differences("members.csv has the parameters that the case gives its members", differences,
                          members_.parameters.empty() ? "they differ in their initial states alone"
                                                      : fmt::format("{} members, to the last bit", table_.rows()));
  }

  void initial_energies() {
    Worst worst;
    for (std::size_t m = 0; m < members_.list.size(); ++m) {
      if (!has_started(m)) continue;
      worst.add(m, std::abs(initial_[m].sum() - table_.number(m, "H_initial")), initial_[m].round_off());
    }
    book_.add("the first H of every member is that of its initial state", worst.verdict(), worst.text());
  }

  // A member that failed between two records has no H of its last state on record.
  void final_energies() {
    Worst worst;
    for (std::size_t m = 0; m < members_.list.size(); ++m) {
      if (!is_in_last_row(m)) continue;
      const auto found = finals_.find(m);
      if (found == finals_.end()) {
        worst.add(m, std::nan(""), 1);
        continue;
      }
      const EnergyTerms terms = energies_.of(members_.list[m], found->second);
      worst.add(m, std::abs(terms.sum() - table_.number(m, "H_final")), std::max(terms.round_off(), round_off()));
    }
    book_.add("the last H of every member that still ran is that of its state in finals.csv", worst.verdict(),
              worst.text());
  }

  void statistics_of_rows() {
    for (const bool last : {false, true}) {
      std::vector<double> values;
      for (std::size_t m = 0; m < members_.list.size(); ++m)
        if (last ? is_in_last_row(m) : has_started(m))
          values.push_back(table_.number(m, last ? "H_final" : "H_initial"));
      const std::string claim = fmt::format("the {} row of energy.csv and summary.json has the statistics of these H",
                                            last ? "last" : "first");
      const std::size_t row = last ? energy_.rows.size() - 1 : 0;
      const auto written = static_cast<std::size_t>(energy_.column("members")[row]);
      if (values.size() != written) {
        book_.add(claim, last && values.empty() ? Verdict::not_checked : Verdict::contradicted,
                  fmt::format("{} members by members.csv, {} in energy.csv", values.size(), written));
        continue;
      }
      std::vector<std::string> differences;
      const Statistics expected = statistics(values);
      for (const auto& [name, value] : all_statistics) {
        const double in_row = energy_.column(fmt::format("H_{}", name))[row];
        const Json said = in_summary(fmt::format("/energy/{}/{}", last ? "final" : "initial", name));
        const double beside = said.is_number() ? said.get<double>() : std::nan("");
        if (std::abs(expected.*value - in_row) <= round_off() && in_row == beside) continue;
        differences.push_back(fmt::format("{} is {:.17g} recomputed, {:.17g} in energy.csv and {:.17g} in summary.json",
                                          name, expected.*value, in_row, beside));
      }
      book_.add_differences(claim, differences, fmt::format("{} members", written));
    }
  }

  // Of summary.json, which may be damaged; null where there is no such thing.
  Json in_summary(const std::string& path) const {
    const Json::json_pointer place(path);
    return summary_.contains(place) ? summary_.at(place) : Json();
  }

  void counts() {
    MemberCounts found = count_members(table_);
    std::vector<std::string> differences;
    const auto compare = [&](const std::string& what, std::int64_t counted, const Json& written) {
      if (!written.is_number_integer() || written.get<std::int64_t>() != counted)
        differences.push_back(
            fmt::format("{}: {} in members.csv and {} in summary.json", what, counted, written.dump()));
    };
    for (const char* status : {"success", "failed", "interrupted"})
      compare(status, found.statuses[status], in_summary(fmt::format("/statuses/{}", status)));
    for (const char* law : {"holds", "violated", "not promised"})
      compare(fmt::format("law {}", law), found.laws[law], in_summary(fmt::format("/laws/{}", law)));
    compare("steps", found.steps, in_summary("/steps"));
    book_.add_differences("summary.json counts the members as members.csv has them", differences,
                          fmt::format("{} steps; {} members reached the end, the law holds for {}", found.steps,
                                      found.statuses["success"], found.laws["holds"]));
  }

  // Between start and end there are statistics of H alone: of every member its largest increase is looked at.
  void law() {
    const bool modified = table_.has("max_modified_increase");
    const std::string claim = fmt::format("the verdict on the law of {} of every member fits its largest increase",
                                          modified ? "the modified energy" : "H");
    const std::string objection = objection_of(spec_);
    std::vector<std::string> differences;
    std::size_t judged = 0;
    double largest = -std::numeric_limits<double>::infinity();
    std::shared_ptr<const Problem> problem;
    LawPromise promise;
    for (std::size_t m = 0; m < table_.rows(); ++m) {
      const EnsembleMember& member = members_.list[m];
      const std::string& verdict = table_.text(m, "law");
      if (verdict == "not promised" || verdict == "not tested" || !has_started(m)) continue;
      if (member.problem != problem) {
        problem = member.problem;
        promise = promise_energy_law(*problem, spec_.t_end);
        if (!objection.empty()) promise.withdraw(objection);
      }
      ++judged;
      const double increase = table_.number(m, modified ? "max_modified_increase" : "max_increase");
      largest = std::max(largest, increase);
      const double allowed = 2 * std::max(initial_[m].round_off(), round_off()) *
                             static_cast<double>(std::max<std::int64_t>(1, spec_.energy_every));
      const bool holds = increase <= allowed;
      if (!promise.promised)
        differences.push_back(fmt::format("member {} is promised no law: {}", m + 1, promise.reason));
      else if (holds != (verdict == "holds"))
        differences.push_back(
            fmt::format("member {}: {}, and its largest increase is {:.3g}", m + 1, verdict, increase));
    }
    if (judged == 0) return book_.add(claim, Verdict::not_checked, "no member is promised a law");
    book_.add_differences(
        claim, differences,
        fmt::format(
            "{} members with a promise, largest increase {:.3g}; the energies between the first and the last row are "
            "not in the files member by member",
            judged, largest));
  }

  const RunSpec& spec_;
  Members members_;
  TextTable table_;
  std::map<std::size_t, Vector> finals_;  // of members, from 0
  CsvTable energy_;
  Json summary_;
  MemberEnergies energies_;
  std::vector<EnergyTerms> initial_;  // of every member
  double largest_ = 0;                // |H|
  AuditBook book_;
};

}  // namespace

Audit audit_ensemble(const std::filesystem::path& directory, const RunSpec& spec) {
  return EnsembleAuditor(directory, spec).run();
}

}  // namespace seiche
