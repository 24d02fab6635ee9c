// An audit finds the energies of a healthy run healthy, whichever rows and states its files have.
#include <test/support/error_of.hpp>
#include <test/support/repetitions.hpp>
#include <test/support/temporary_directory.hpp>

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <seiche/config/case/case_file.hpp>
#include <seiche/driver/run_case.hpp>
#include <seiche/output/csv_table.hpp>
#include <seiche/study/audit/audit.hpp>
#include <seiche/study/audit/recorded_energies.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

class AuditOfRows : public InTemporaryDirectory {
 protected:
  RunSpec run(const std::string& method, const std::string& output) const {
    const RunSpec spec = parse_case(
        fmt::format(
            "[problem]\nname = \"oscillator\"\nalpha = 1.0\ngamma = 0.1\n[method]\n{}\n[time]\nend = 3.1\n[output]\nreport = \"off\"\n{}\n",
            method, output),
        "case.toml", {}, directory);
    run_case(spec, directory / "out");
    return read_case(directory / "out/case.toml");
  }
  std::vector<std::string> contradicted() const {
    std::vector<std::string> all;
    for (const AuditEntry& entry : audit(directory / "out").entries)
      if (entry.verdict == AuditEntry::Verdict::contradicted) all.push_back(entry.claim + ": " + entry.evidence);
    return all;
  }
  // energy.csv with these of its columns, in this order.
  void rewrite_columns(const std::vector<std::string>& names) const {
    const CsvTable table = CsvTable::read(directory / "whole.csv");
    std::ofstream file(directory / "out/energy.csv");
    file << fmt::format("{}\n", fmt::join(names, ","));
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      std::vector<double> values;
      for (const std::string& name : names) values.push_back(table.column(name)[row]);
      file << fmt::format("{:.17g}\n", fmt::join(values, ","));
    }
  }
};

TEST_F(AuditOfRows, AgreesWithEveryRhythmOfRowsAndSnapshots) {
  const std::string steps = "h = \"1/64\"", tolerance = "tolerance = 1e-5";
  const std::vector<std::string> all = {"egc4", "seisav", "seilm", "avf"};
  for (const std::string& name : std::span(all).first(sanitized ? 1 : all.size())) {
    for (const std::string& by : {steps, tolerance}) {
      for (const auto& [rows, states] :
           std::vector<std::pair<int, int>>{{1, 1}, {16, 4}, {3, 7}, {16, 1}, {6, 4}, {1, 64}, {1000, 0}, {5, 1000}}) {
        const std::string output = fmt::format("energy_every = {}\nsnapshot_every = {}", rows, states);
        run(fmt::format("name = \"{}\"\n{}", name, by), output);
        EXPECT_THAT(contradicted(), testing::IsEmpty()) << name << " " << by << " " << output;
      }
      for (const double interval : {0.25, 0.01}) {
        const std::string output = fmt::format("energy_every = 3\nsnapshot_interval = {}", interval);
        run(fmt::format("name = \"{}\"\n{}", name, by == steps ? "h = 0.005" : by), output);
        EXPECT_THAT(contradicted(), testing::IsEmpty()) << name << " " << by << " " << output;
      }
    }
  }
}

TEST_F(AuditOfRows, TakeTheRiseFromBothFiles) {
  for (const auto& [rows, states] : std::vector<std::pair<int, int>>{{16, 4}, {3, 7}, {1, 0}}) {
    const RunSpec spec =
        run("name = \"seisav\"\nh = \"1/64\"", fmt::format("energy_every = {}\nsnapshot_every = {}\n", rows, states));
    const LargestIncreases read = largest_increases(directory / "out", spec);
    EXPECT_TRUE(read.of_all);
    const RunReport report = run_case(spec, directory / "again").report;
    EXPECT_EQ(read.H, report.energy.max_increase) << rows << " " << states;
    EXPECT_EQ(read.modified, report.modified.max_increase) << rows << " " << states;
  }
  const RunSpec spec = run("name = \"seisav\"\ntolerance = 1e-5", "energy_every = 3");
  EXPECT_FALSE(largest_increases(directory / "out", spec).of_all) << "the steps between are in no file";
}

TEST_F(AuditOfRows, FindTheirColumnsByName) {
  const RunSpec spec = run("name = \"seisav\"\nh = \"1/64\"", "energy_every = 16\nsnapshot_every = 4\n");
  const LargestIncreases before = largest_increases(directory / "out", spec);
  std::filesystem::copy_file(directory / "out/energy.csv", directory / "whole.csv");

  rewrite_columns({"H_modified", "H", "t"});
  const LargestIncreases after = largest_increases(directory / "out", spec);
  EXPECT_EQ(after.H, before.H);
  EXPECT_EQ(after.modified, before.modified);
  EXPECT_THAT(contradicted(), testing::IsEmpty());

  rewrite_columns({"t", "H"});
  EXPECT_TRUE(std::isnan(largest_increases(directory / "out", spec).modified)) << "what is not there did not fall";
  EXPECT_THAT(contradicted(), testing::Contains(testing::HasSubstr("no column H_modified")));

  rewrite_columns({"t", "H_modified"});
  EXPECT_THAT(error_of([&] { largest_increases(directory / "out", spec); }),
              testing::HasSubstr("no column H: its columns are t, H_modified"));
}

TEST_F(AuditOfRows, AreContradictedByASummaryThatIsDamaged) {
  run("name = \"seisav\"\nh = \"1/64\"", "energy_every = 16\n");
  const std::filesystem::path file = directory / "out/summary.json";
  std::ifstream in(file);
  const nlohmann::json whole = nlohmann::json::parse(in);
  for (const char* key : {"initial", "final", "max_increase", "law"}) {
    nlohmann::json damaged = whole;
    damaged["energy"].erase(key);
    std::ofstream(file) << damaged;
    EXPECT_THAT(contradicted(), testing::Not(testing::IsEmpty())) << key;
  }
  for (const char* energy : {"[]", "5", "null", "{\"law\": 7}"}) {
    nlohmann::json damaged = whole;
    damaged["energy"] = nlohmann::json::parse(energy);
    std::ofstream(file) << damaged;
    EXPECT_THAT(contradicted(), testing::Not(testing::IsEmpty())) << energy;
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
