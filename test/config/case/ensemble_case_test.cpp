// [ensemble] in a case file: its members, its mistakes, and the files that a run leaves.
#include <test/support/background.hpp>
#include <test/support/error_of.hpp>
#include <test/support/paths.hpp>
#include <test/support/temporary_directory.hpp>
#include <test/support/text_of.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/ensemble/members.hpp>
#include <seiche/ensemble/statistics.hpp>
#include <seiche/study/audit/audit.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

RunSpec ensemble_case(const std::string& section) {
  return parse_case("[problem]\nname = \"klein_gordon\"\nalpha = 1.0\n[time]\nend = 1.0\n[ensemble]\n" + section,
                    "a.toml");
}

std::string complaint(const std::string& section) {
  return test::error_of([&] { make_members(ensemble_case(section)); });
}

TEST(EnsembleCase, SamplesRepeatWithTheSeedAndMoreMembersBeginWithTheSameOnes) {
  const std::string samples =
      "gamma = { uniform = [0.1, 0.2] }\nalpha = { normal = [1, 0.1] }\nperturb_initial = 0.01\n";
  const Members five = make_members(ensemble_case("members = 5\nseed = 7\n" + samples));
  const Members again = make_members(ensemble_case("members = 8\nseed = 7\n" + samples));
  const Members other = make_members(ensemble_case("members = 5\nseed = 8\n" + samples));
  EXPECT_EQ(five.parameters, (std::vector<std::string>{"gamma", "alpha"}));
  for (std::size_t m = 0; m < 5; ++m) {
    EXPECT_EQ(five.values[m], again.values[m]);
    EXPECT_EQ(five.list[m].initial, again.list[m].initial);
    EXPECT_NE(five.values[m], other.values[m]);
    EXPECT_GE(five.values[m][0], 0.1);
    EXPECT_LE(five.values[m][0], 0.2);
    EXPECT_DOUBLE_EQ(five.list[m].problem->damping.rate->value(0), five.values[m][0]);
  }
}

TEST(EnsembleCase, MembersThatWouldNotFitIntoMemoryAreRefusedBeforeTheyAreMade) {
  const std::string wide =
      "[problem]\nname = \"klein_gordon\"\npoints = 1000000\n[time]\nend = 1.0\n[ensemble]\nmembers = ";
  const auto refusal = [&](const std::string& rest) -> std::string {
    try {
      make_members(parse_case(wide + rest, "a.toml"));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  for (const char* rest : {"10000000\nperturb_initial = 0.1\n", "10000000\nkappa = { from = 0.1, to = 0.2 }\n"}) {
    EXPECT_NE(refusal(rest).find("10000000 members"), std::string::npos) << refusal(rest);
    EXPECT_NE(refusal(rest).find("fewer members"), std::string::npos) << refusal(rest);
  }
  // members that differ in a parameter need a simulation each
  EXPECT_GT(ensemble_bytes(ensemble_case("members = 100\nkappa = { from = 0.1, to = 0.2 }\n")),
            3 * ensemble_bytes(ensemble_case("members = 100\nperturb_initial = 0.1\n")));
}

TEST(EnsembleCase, ARateThatNamesAParameterVariesWithIt) {
  const std::string text =
      "[problem]\nname = \"klein_gordon\"\npoints = 8\ngamma = \"alpha/10*(1 + sin(t))\"\n"
      "[ensemble]\nmembers = 3\nalpha = { from = 1.0, to = 3.0 }\n";
  const Members members = make_members(parse_case(text, "a.toml"));
  ASSERT_EQ(members.list.size(), 3U);
  for (std::size_t m = 0; m < 3; ++m)
    EXPECT_DOUBLE_EQ(members.list[m].problem->damping.rate->value(0), 0.1 * static_cast<double>(m + 1));
}

TEST(EnsembleCase, NormalSamplesHaveTheirMeanAndDeviation) {
  const Members members = make_members(ensemble_case("members = 2000\nomega_squared = { normal = [3, 0.5] }\n"));
  std::vector<double> values;
  for (const std::vector<double>& v : members.values) values.push_back(v[0]);
  const Statistics s = statistics(values);
  EXPECT_NEAR(s.mean, 3, 4 * 0.5 / std::sqrt(2000));
  EXPECT_NEAR(s.standard_deviation, 0.5, 0.04);
  EXPECT_NEAR(s.high - 3, 1.6449 * 0.5, 0.08);
}

TEST(EnsembleCase, RangesAreEvenlySpacedAndTheSectionIsWrittenAsItIsRead) {
  const RunSpec spec = ensemble_case("members = 5\nkappa = { from = 0.1, to = 0.3 }\nalpha = { uniform = [0, 1] }\n");
  const Members members = make_members(spec);
  EXPECT_DOUBLE_EQ(members.values[0][0], 0.1);
  EXPECT_DOUBLE_EQ(members.values[1][0], 0.15);
  EXPECT_DOUBLE_EQ(members.values[4][0], 0.3);
  EXPECT_EQ(parse_case(write_case(spec), "b.toml").ensemble, spec.ensemble);
}

TEST(EnsembleCase, MistakesAreOneSentenceWithTheKey) {
  EXPECT_NE(complaint("members = 0\n").find("ensemble.members = 0 must be ≥ 1"), std::string::npos);
  EXPECT_NE(complaint("seed = 1\n").find("has no members"), std::string::npos);
  EXPECT_NE(complaint("members = 5\n").find("5 members and nothing in which they differ"), std::string::npos);
  EXPECT_EQ(complaint("members = 1\n"), "");
  EXPECT_NE(complaint("members = 2\ngama = { from = 0, to = 1 }\n").find("did you mean 'gamma'"), std::string::npos);
  EXPECT_NE(complaint("members = 2\ngamma = 0.1\n").find("must be { from"), std::string::npos);
  EXPECT_NE(complaint("members = 2\ngamma = { form = 0, to = 1 }\n").find("did you mean 'from'"), std::string::npos);
  EXPECT_NE(complaint("members = 2\ngamma = { from = 0 }\n").find("must be { from"), std::string::npos);
  EXPECT_NE(complaint("members = 2\ngamma = { from = 1, to = 1 }\n").find("one value and no range"), std::string::npos);
  EXPECT_NE(complaint("members = 2\ngamma = { uniform = [2, 1] }\n").find("≤ the second"), std::string::npos);
  EXPECT_NE(complaint("members = 2\ngamma = { normal = [2, -1] }\n").find("deviation must be ≥ 0"), std::string::npos);
  EXPECT_NE(complaint("members = 2\nkappa = { from = -1, to = 1 }\n").find("kappa"), std::string::npos);
  EXPECT_NE(complaint("members = 9\nkappa = { normal = [0, 1] }\n").find("of the ensemble: problem.kappa"),
            std::string::npos);
  EXPECT_NE(complaint("members = 2\nperturb_initial = -1\n").find("must be ≥ 0"), std::string::npos);
  EXPECT_NE(complaint("members = 2\ninitial = { files = [] }\n").find("files = ["), std::string::npos);
  EXPECT_NE(complaint("initial = { files = [\"nowhere.txt\"] }\n").find("does not exist"), std::string::npos);
}

class EnsembleProgram : public InTemporaryDirectory {
 protected:
  // The exit code of a run of this case into `out`.
  int run_case(const std::string& ensemble, const std::string& more = "", const std::string& arguments = "",
               const std::string& before = "") const {
    std::ofstream(directory / "case.toml") << "[problem]\nname = \"klein_gordon\"\nalpha = -1.0\n[method]\nh = 0.0625\n"
                                           << more << "[time]\nend = 1.0\n[ensemble]\n"
                                           << ensemble;
    const std::string command = "cd '" + directory.string() + "' && " + before + " '" + test::program_path() +
                                "' run case.toml --out out --quiet " + arguments + " >stdout.txt 2>stderr.txt";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::vector<std::string> lines(const std::string& name) const {
    std::ifstream in(directory / name);
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
};

TEST_F(EnsembleProgram, LeavesARowForEveryMemberAndTheStatisticsOfTheEnergies) {
  ASSERT_EQ(run_case("members = 19\ngamma = { from = 0.0, to = 0.18 }\nperturb_initial = 0.01\n", "", "--threads 2"),
            0);
  const std::vector<std::string> members = lines("out/members.csv");
  ASSERT_EQ(members.size(), 20U);
  EXPECT_EQ(members[0].substr(0, 31), "member,gamma,status,steps,t,H_i");
  EXPECT_EQ(members[1].substr(0, 17), "1,0,success,16,1,");
  EXPECT_EQ(lines("out/energy.csv").size(), 18U);  // a header, and t = 0, h, …, 1
  EXPECT_EQ(lines("out/finals.csv").size(), 20U);
  std::ifstream file(directory / "out/summary.json");
  const nlohmann::json summary = nlohmann::json::parse(file);
  EXPECT_EQ(summary["status"], "success");
  EXPECT_EQ(summary["statuses"]["success"], 19);
  EXPECT_EQ(summary["laws"]["holds"], 19);
  EXPECT_EQ(summary["side_by_side"], true);

  const std::vector<std::string> finals = lines("out/finals.csv");
  ASSERT_EQ(run_case("members = 19\ngamma = { from = 0.0, to = 0.18 }\nperturb_initial = 0.01\n"), 0);
  EXPECT_EQ(lines("out/finals.csv"), finals) << "one thread or two";
}

TEST_F(EnsembleProgram, IsAuditedFromItsFilesWhichShowWhatWasChanged) {
  const auto audit_out = [&] { return audit(directory / "out"); };
  const auto verdicts = [&] {
    std::string text;
    for (const AuditEntry& entry : audit_out().entries)
      text += to_string(entry.verdict) + ": " + entry.claim + "\n  " + entry.evidence + "\n";
    return text;
  };
  for (const std::string method : {"seisav", "seidm", "egc4"}) {
    ASSERT_EQ(run_case("members = 19\ngamma = { from = 0.0, to = 0.18 }\nperturb_initial = 0.01\n",
                       "name = \"" + method + "\"\n"),
              0);
    EXPECT_TRUE(audit_out().confirms()) << verdicts();
    EXPECT_THAT(verdicts(), testing::Not(testing::HasSubstr("not checked"))) << method;
    EXPECT_EQ(audit_out().entries.size(), 9U);
  }
  // a digit of the last number of a row, and of the file
  for (const std::string file : {"members.csv", "finals.csv", "energy.csv", "summary.json", "case.toml"}) {
    const std::string whole = test::text_of(directory / "out" / file);
    std::string changed = whole;
    const std::size_t from = file == "members.csv"    ? whole.find(",success,", whole.size() / 2) + 14
                             : file == "summary.json" ? whole.find("\"holds\"")
                             : file == "case.toml"    ? whole.find("seed")
                             : file == "finals.csv"   ? whole.find('\n', whole.size() / 2) + 5
                                                      : whole.find('\n') + 6;
    const std::size_t digit = changed.find_first_of("123456789", from);
    changed[digit] = changed[digit] == '9' ? '1' : '9';
    std::ofstream(directory / "out" / file) << changed;
    EXPECT_FALSE(audit_out().confirms()) << file << ", column " << digit << "\n" << verdicts();
    std::ofstream(directory / "out" / file) << whole;
  }
  EXPECT_TRUE(audit_out().confirms());
  std::filesystem::remove(directory / "out/finals.csv");
  EXPECT_THAT(test::error_of(audit_out), testing::HasSubstr("finals.csv cannot be read"));
}

TEST_F(EnsembleProgram, IsAuditedWithMembersThatFailed) {
  EXPECT_EQ(run_case("members = 40\nperturb_initial = 0.6\n", "C = 1\n"), 1);
  const Audit result = audit(directory / "out");
  EXPECT_TRUE(result.confirms());
  EXPECT_EQ(result.entries.size(), 9U);
}

TEST_F(EnsembleProgram, SaysWhichMembersFailedAndKeepsTheOthers) {
  // C = 1 is too small for the members whose perturbation makes V(z₀) < −1.
  EXPECT_EQ(run_case("members = 40\nperturb_initial = 0.6\n", "C = 1\n"), 1);
  const std::vector<std::string> members = lines("out/members.csv");
  const auto failed = std::count_if(members.begin(), members.end(), [](const std::string& line) {
    return line.find(",failed,") != std::string::npos && line.find("C = 1 is too small") != std::string::npos;
  });
  EXPECT_GT(failed, 0);
  EXPECT_LT(failed, 40);
  EXPECT_EQ(static_cast<std::ptrdiff_t>(members.size()), 41);
}

// Steps of this size are too long for large waves.
TEST_F(EnsembleProgram, SaysWhichMembersHoldReplacedSteps) {
  ASSERT_EQ(run_case("members = 2\nperturb_initial = 0.01\n", "name = \"egc4\"\n"), 0);
  EXPECT_TRUE(lines("stderr.txt").empty());
  const std::string large =
      "--set problem.alpha=1 problem.initial='{u=\"4*sin(pi*x)\",v=\"0\"}' method.h=0.8 time.end=200";
  ASSERT_EQ(run_case("members = 2\nperturb_initial = 0.01\n", "name = \"egc4\"\n", large), 0);
  std::ifstream file(directory / "out/summary.json");
  const nlohmann::json summary = nlohmann::json::parse(file);
  ASSERT_GT(summary["counts"]["replaced"], 0);
  const std::string message = summary["message"];
  EXPECT_NE(message.find("hold replaced steps, the first of them member "), std::string::npos) << message;
  ASSERT_EQ(lines("stderr.txt").size(), 1U);
  EXPECT_NE(lines("stderr.txt")[0].find("no solution was found"), std::string::npos) << lines("stderr.txt")[0];
}

// V is unbounded below: large waves grow beyond all bounds.
TEST_F(EnsembleProgram, EndsWhereNoMemberRunsAnyMore) {
  const std::string large =
      "--set problem.alpha=-1 problem.initial='{u=\"40*sin(pi*x)\",v=\"0\"}' method.name=sav method.h=1/16 method.C=1e9 "
      "method.auxiliary=frozen time.end=2000";
  EXPECT_EQ(run_case("members = 3\nperturb_initial = 0.01\n", "", large), 1);
  std::ifstream file(directory / "out/summary.json");
  const nlohmann::json summary = nlohmann::json::parse(file);
  ASSERT_EQ(summary["statuses"]["failed"], 3) << summary.dump(1);
  EXPECT_TRUE(summary["energy"]["law"].is_null()) << summary.dump(1);
  EXPECT_EQ(summary["laws"]["holds"], 0);
  EXPECT_LT(summary["t"], 2000);
  const std::vector<std::string> rows = lines("out/energy.csv");
  EXPECT_LT(rows.size(), 32000U);
  for (const std::string& row : rows) EXPECT_EQ(row.find("nan"), std::string::npos) << row;
  EXPECT_EQ(rows.back().substr(0, rows.back().find(',')), fmt::format("{}", summary["t"].get<double>()));
  for (const std::string& row : lines("out/members.csv")) EXPECT_EQ(row.find("nan"), std::string::npos) << row;
}

TEST_F(EnsembleProgram, CtrlCLeavesWholeFilesHoweverFarRecordsLieApart) {
  ASSERT_EQ(run_case("members = 3\nperturb_initial = 0.01\n"), 0);
  std::filesystem::remove_all(directory / "out");
  Background run(directory, {"run", "case.toml", "--out", "out", "--json", "--set", "time.end=1e7",
                             "output.energy_every=100000000"});
  ASSERT_TRUE(Background::wait_until([&] { return std::filesystem::exists(directory / "out/energy.csv.partial"); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(run.end(SIGINT), 130);
  std::ifstream file(directory / "out/summary.json");
  const nlohmann::json summary = nlohmann::json::parse(file);
  EXPECT_EQ(summary["status"], "interrupted");
  EXPECT_EQ(summary["statuses"]["interrupted"], 3);
  EXPECT_GT(summary["t"], 0);
  EXPECT_EQ(lines("out/energy.csv").size(), 3U);
  EXPECT_EQ(std::stod(lines("out/energy.csv").back()), summary["t"]);
  EXPECT_EQ(lines("out/members.csv").size(), 4U);
  EXPECT_EQ(lines("out/finals.csv").size(), 4U);
}

TEST_F(EnsembleProgram, ADiskThatFillsUpCostsOnlyWhatDoesNotFit) {
  // No file of more than 100 KiB.
  EXPECT_EQ(run_case("members = 3\nperturb_initial = 0.01\n", "", "--set time.end=1000", "ulimit -f 100;"), 1);
  EXPECT_EQ(lines("out/members.csv").size(), 4U);
  EXPECT_EQ(lines("out/finals.csv").size(), 4U);
  std::ifstream file(directory / "out/summary.json");
  const nlohmann::json summary = nlohmann::json::parse(file);
  EXPECT_EQ(summary["status"], "failed");
  const std::string message = summary["message"];
  EXPECT_NE(message.find("energy.csv: File too large"), std::string::npos) << message;
  EXPECT_EQ(message.find("energy.csv", message.find("energy.csv") + 1), std::string::npos) << "said once: " << message;
  ASSERT_EQ(lines("stderr.txt").size(), 1U);
}

TEST_F(EnsembleProgram, RefusesACaseThatIsWrongBeforeAnythingIsWritten) {
  EXPECT_EQ(run_case("members = 2\nC = { from = 1, to = 2 }\n"), 2);
  EXPECT_EQ(run_case("members = 2\n", "name = \"avf\"\nauxiliary = \"frozen\"\n"), 2);
  EXPECT_FALSE(std::filesystem::exists(directory / "out"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
