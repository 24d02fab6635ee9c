#include <seiche/driver/ensemble_files.hpp>
#include <seiche/output/csv_text.hpp>

#include <fmt/format.h>

namespace seiche {
namespace {

std::string energy_columns(const EnergySummary& e) {
  return fmt::format(",{},{},{}", e.initial, e.final, e.max_increase);
}

}  // namespace

StatisticsFile::StatisticsFile(const Folder& folder, bool has_modified)
    : file_(folder, "energy.csv"), has_modified_(has_modified) {
  std::string header = "t,members";
  for (const char* of : {"H", "H_modified"}) {
    if (std::string_view(of) == "H_modified" && !has_modified) continue;
    for (const char* what : {"mean", "sd", "min", "q05", "median", "q95", "max"})
      header += fmt::format(",{}_{}", of, what);
  }
  file_.write(header + "\n");
}

StatisticsFile::StatisticsFile(const Folder& folder, bool has_modified, const FileMark& mark, Archive& archive)
    : file_(folder, "energy.csv", mark), has_modified_(has_modified) {
  archive(*this);
}

void StatisticsFile::archive(Archive& a) {
  for (EnsembleRecord* record : {&first_, &last_}) {
    a(record->t, record->running);
    a.numbers(record->H);
    a.numbers(record->modified);
  }
}

void StatisticsFile::write(const EnsembleRecord& record) {
  if (last_.running == 0) first_ = record;
  last_ = record;
  row_.clear();
  row_.add(record.t);
  row_.add(static_cast<double>(record.running));
  add(record.H);
  if (has_modified_) add(record.modified);
  file_.write(row_.line());
  file_.flush();  // records are far apart
  file_.keep_lines();
}
void StatisticsFile::add(const Statistics& s) {
  for (const double x : {s.mean, s.standard_deviation, s.minimum, s.low, s.median, s.high, s.maximum}) row_.add(x);
}

void write_members(const Folder& folder, const Members& members, const EnsembleResult& result, bool has_modified) {
  AtomicFile file(folder, "members.csv");
  std::string header = "member";
  for (const std::string& name : members.parameters) header += "," + name;
  header += ",status,steps,t,H_initial,H_final,max_increase";
  if (has_modified) header += ",H_modified_initial,H_modified_final,max_modified_increase";
  file.write(header + ",law,scalar_iterations,fallbacks,replaced,message\n");
  for (std::size_t m = 0; m < result.members.size(); ++m) {
    const RunReport& report = result.members[m].report;
    std::string row = fmt::format("{}", m + 1);
    for (const double value : members.values[m]) row += fmt::format(",{}", value);
    row += fmt::format(",{},{},{}", to_string(report.status), report.steps, report.t);
    const bool started = result.members[m].final.size() > 0;
    row += started ? energy_columns(report.energy) : ",,,";
    if (has_modified) row += started ? energy_columns(report.modified) : ",,,";
    row += fmt::format(",{},{},{},{},{}\n", to_string(report.law), report.scalar_iterations, report.fallbacks,
                       report.replaced.count, csv_quoted(report.message));
    file.write(row);
  }
  file.commit();
}

void write_finals(const Folder& folder, const Problem& problem, const EnsembleResult& result) {
  AtomicFile file(folder, "finals.csv");
  std::string header = "member";
  for (const std::string& field : problem.fields)
    for (Index j = 1; j <= problem.grid.unknowns(); ++j) header += fmt::format(",{}_{}", field, j);
  file.write(header + "\n");
  CsvRow row;
  for (std::size_t m = 0; m < result.members.size(); ++m) {
    if (result.members[m].final.size() == 0) continue;
    row.clear();
    row.add(static_cast<double>(m + 1));
    row.add(result.members[m].final);
    file.write(row.line());
  }
  file.commit();
}

}  // namespace seiche
