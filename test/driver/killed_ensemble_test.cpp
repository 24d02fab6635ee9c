// An ensemble that is killed when its members have ended, before all of its files are written.
#include <test/support/error_of.hpp>
#include <test/support/temporary_directory.hpp>
#include <test/support/text_of.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/driver/run_ensemble_case.hpp>
#include <seiche/study/audit/audit.hpp>
#include <seiche/study/recovery.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class KilledEnsemble : public InTemporaryDirectory {
 protected:
  void run(bool restart = false) const {
    const RunSpec spec = parse_case(
        "[problem]\nname = \"oscillator\"\n[method]\nname = \"seisav\"\nh = \"1/32\"\n[time]\nend = 1.0\n"
        "[ensemble]\nmembers = 3\nperturb_initial = 0.01\n",
        "case.toml", {}, directory);
    RunCaseOptions options;
    options.restart = restart;
    run_ensemble_case(spec, out(), options);
  }
  fs::path out() const { return directory / "out"; }
  nlohmann::json summary() const { return nlohmann::json::parse(text_of(out() / "summary.json")); }
};

// summary.json is the last file, finals.csv and members.csv come before it.
TEST_F(KilledEnsemble, IsKeptAndRecoveredWhicheverFileItHadComeTo) {
  run();
  const nlohmann::json whole = summary();
  std::vector<std::string> lost;
  for (const char* name : {"summary.json", "finals.csv", "members.csv"}) {
    fs::remove(out() / "summary.json");
    fs::remove(out() / name);
    const std::string energies = text_of(out() / "energy.csv");
    EXPECT_THAT(error_of([&] { run(); }), AllOf(HasSubstr("seiche recover"), HasSubstr("--restart"))) << name;

    const Recovery found = recover(Folder(out()));
    EXPECT_THAT(found.saved, testing::ElementsAre("summary.json, with the status unfinished")) << name;
    lost.insert(lost.end(), found.lost.begin(), found.lost.end());
    const nlohmann::json recovered = summary();
    EXPECT_EQ(recovered["status"], "unfinished");
    for (const char* key : {"problem", "method", "backend", "h", "members", "t"})
      EXPECT_EQ(recovered[key], whole[key]) << name << " " << key;
    for (const char* key : {"initial", "final", "modified"})
      EXPECT_EQ(recovered["energy"][key], whole["energy"][key]) << name << " " << key;
    const bool has_members = fs::exists(out() / "members.csv");
    for (const char* key : {"statuses", "laws", "steps"})
      EXPECT_EQ(recovered[key], has_members ? whole[key] : nlohmann::json(nullptr)) << name << " " << key;

    const Audit audited = audit(out());
    EXPECT_TRUE(audited.confirms()) << name;
    EXPECT_THAT(error_of([&] { run(); }), HasSubstr("--restart")) << "nor is it erased when it was recovered";
    EXPECT_EQ(text_of(out() / "energy.csv"), energies);
  }
  EXPECT_THAT(lost, testing::ElementsAre(HasSubstr("finals.csv"), HasSubstr("the members of the ensemble")));
  run(true);
  EXPECT_EQ(summary()["status"], "success");
}

}  // namespace TEST_FILE
}  // namespace seiche::test
