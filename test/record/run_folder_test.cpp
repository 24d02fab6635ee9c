// The folder of a run: what is removed from it, what is kept, and that it never holds two runs.
#include <test/support/background.hpp>
#include <test/support/program.hpp>
#include <test/support/run_folder.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class RunFolders : public Cli {
 protected:
  std::set<std::string> names(const fs::path& folder) const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(directory / folder)) all.insert(entry.path().filename().string());
    return all;
  }
  // One that would take hours, once it writes.
  static std::vector<std::string> endless(bool ensemble) {
    std::vector<std::string> words = {
        "run", "case.toml", "--out", "out", "--set", "time.end=1e7", "output.energy_every=1000"};
    if (ensemble) words.insert(words.end(), {"ensemble.members=3", "ensemble.perturb_initial=0.01"});
    return words;
  }
  static constexpr const char* of_an_ensemble = " --set ensemble.members=2 ensemble.perturb_initial=0.01";
  bool is_writing() const {
    return Background::wait_until([&] {
      return fs::exists(directory / "out/energy.csv.partial") && !fs::exists(directory / "out/summary.json");
    });
  }
};

TEST_F(RunFolders, RunsAndPlotsRemoveWhatSeicheDrawsAndNothingElse) {
  write_case();
  const std::vector<std::string> foreign = {"figures/holiday.png",   "figures/energy_balance.pdf",
                                            "figures/profile.svg",   "figures/filmed.mp4",
                                            "figures/film/u_01.png", "figures/film/poster.png",
                                            "figures/energy.txt",    "figures/film/u_0001.jpg"};
  const std::vector<std::string> ours = {"figures/energy.png",      "figures/energy_dark.svg",
                                         "figures/profiles_u.pdf",  "figures/space_time_v_dark.png",
                                         "figures/film_u_dark.mp4", "figures/film_v.webm",
                                         "figures/film/u_0001.png", "figures/film/u_0001_dark.png"};
  fs::create_directories(directory / "here/figures/film");
  for (const auto& names : {foreign, ours})
    for (const std::string& name : names) write("here/" + name, "drawn");
  ASSERT_EQ(seiche("run case.toml --out here --quiet").exit, 0);
  for (const std::string& name : foreign) EXPECT_EQ(text("here/" + name), "drawn") << name;
  for (const std::string& name : ours) EXPECT_FALSE(fs::exists(directory / "here" / name)) << name;
  if (!test::can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  ASSERT_EQ(seiche("plot here --format png").exit, 0);
  for (const std::string& name : foreign) EXPECT_EQ(text("here/" + name), "drawn") << name;
}

TEST_F(RunFolders, AFileThatSeicheDidNotWriteIsRefusedAndKept) {
  write_case();
  fs::create_directories(directory / "here");
  const auto refused_for = [&](const std::string& name, const std::string& settings = "") {
    const Result result = seiche("run case.toml --out here" + settings);
    EXPECT_EQ(result.exit, 2) << name;
    EXPECT_THAT(result.err, AllOf(HasSubstr("here/" + name), HasSubstr("Seiche did not write it")));
    EXPECT_EQ(text("here/" + name), "mine") << name;
    EXPECT_EQ(names("here").size(), 1U) << name << " alone";
    fs::remove(directory / "here" / name);
  };
  for (const char* name : {"report.html", "energy.csv", "summary.json", "solution.h5", "final.txt"}) {
    write(fs::path("here") / name, "mine");
    refused_for(name);
  }
  for (const char* name : {"members.csv", "finals.csv"}) {
    write(fs::path("here") / name, "mine");
    refused_for(name, of_an_ensemble);
  }
  // The case that a person wrote, with its comments.
  write("mine.toml", text("case.toml"));
  write_case("# why 8 points are enough\n");
  EXPECT_EQ(seiche("run case.toml --out .").exit, 2);
  EXPECT_THAT(text("case.toml"), HasSubstr("enough"));

  // Where nothing of that name is written, it stays.
  for (const char* name : {"report.html", "members.csv"}) write(fs::path("here") / name, "mine");
  for (int again = 0; again < 2; ++again)
    EXPECT_EQ(seiche("run mine.toml --out here --quiet --set output.report=off").exit, 0);
  for (const char* name : {"report.html", "members.csv"}) EXPECT_EQ(text(fs::path("here") / name), "mine");
  EXPECT_EQ(seiche("plot here").exit, 2);
  EXPECT_EQ(seiche("paper --quick --quiet --out here").exit, 2);
  EXPECT_EQ(text("here/report.html"), "mine");
}

TEST_F(RunFolders, ARunThatIsKilledLeavesNothingOfAnEarlierOne) {
  write_case();
  for (const std::string earlier : {"", of_an_ensemble}) {
    for (const bool later : {false, true}) {
      ASSERT_EQ(seiche("run case.toml --restart --out out --quiet" + earlier).exit, 0);
      Background run(directory, endless(later));
      ASSERT_TRUE(is_writing()) << earlier << later << text("stderr.txt");
      EXPECT_EQ(run.end(SIGKILL), -SIGKILL);
      for (const std::string& name : names("out"))
        EXPECT_TRUE(name == "case.toml" || name.starts_with(".seiche.") || name.ends_with(".partial"))
            << earlier << name;
      EXPECT_THAT(text("out/case.toml"), HasSubstr("end = 10000000.0"));
    }
  }
  ASSERT_EQ(seiche("run case.toml --restart --out out --quiet").exit, 0);
  EXPECT_EQ(names("out"), (std::set<std::string>{"case.toml", "energy.csv", "final.txt", "report.html", "solution.h5",
                                                 "solution.xdmf", "summary.json"}));
}

TEST_F(RunFolders, AnAuditSeesFilesOfTwoRuns) {
  write_case();
  const auto contradicted = [&](const std::string& settings, const std::string& file, const std::string& evidence) {
    ASSERT_EQ(seiche("run case.toml --out one --quiet").exit, 0);
    ASSERT_EQ(seiche("run case.toml --out two --quiet --set " + settings).exit, 0);
    ASSERT_EQ(seiche("audit one").exit, 0) << text("stdout.txt");
    fs::copy_file(directory / "two" / file, directory / "one" / file, fs::copy_options::overwrite_existing);
    const Result audit = seiche("audit one");
    EXPECT_EQ(audit.exit, 1) << settings << audit.out;
    EXPECT_THAT(audit.out, HasSubstr(evidence)) << settings;
  };
  contradicted("method.name=seilm", "case.toml", "method = seilm in case.toml and seisav in summary.json");
  contradicted("method.h=1/32", "case.toml", "h = 0.03125 in case.toml and 0.015625 in summary.json");
  contradicted("time.end=2", "case.toml", "end = 2 in case.toml and t = 1 in summary.json");
  contradicted("time.end=2", "summary.json", "t = 2 in summary.json and 1 in energy.csv");
  contradicted("method.tolerance=1e-6", "case.toml", "tolerance = ");
  contradicted("method.C=3", "solution.h5", "the case that it holds says something else");
}

TEST_F(RunFolders, TwoRunsDoNotWriteIntoOneFolder) {
  write_case();
  for (const bool ensemble : {false, true}) {
    Background first(directory, endless(ensemble));
    ASSERT_TRUE(is_writing()) << text("stderr.txt");
    const std::string run = "run case.toml --out out";
    for (const std::string& second : {run, run + of_an_ensemble, std::string("spectrum case.toml --out out")}) {
      const Result result = seiche(second);
      EXPECT_EQ(result.exit, 2) << second;
      EXPECT_THAT(result.err, HasSubstr("another run is writing into out")) << second;
      EXPECT_FALSE(fs::exists(directory / "out/summary.json")) << second;
      EXPECT_THAT(text("out/case.toml"), HasSubstr("end = 10000000.0")) << second;
    }
    EXPECT_EQ(first.end(SIGKILL), -SIGKILL);
    ASSERT_TRUE(fs::exists(directory / "out/.seiche.lock")) << "left by the run that was killed";
    EXPECT_EQ(seiche("run case.toml --restart --out out --quiet").exit, 0) << text("stderr.txt");
    EXPECT_FALSE(fs::exists(directory / "out/.seiche.lock"));
  }
}

// What a failing program has drawn so far is half a picture.
TEST_F(RunFolders, PicturesAreWholeOrThoseOfBefore) {
  write_case();
  ASSERT_EQ(seiche("run case.toml --out out --quiet").exit, 0);
  fs::create_directories(directory / "bin");
  write("bin/python3", "#!/bin/sh\nfor f in energy spectrum_decay; do echo half >$f.png; done\nexit 1\n");
  fs::permissions(directory / "bin/python3", fs::perms::owner_all);
  const std::string path = "PATH=\"" + (directory / "bin").string() + ":$PATH\"";
  EXPECT_EQ(seiche("plot out", path).exit, 1);
  EXPECT_EQ(names("out/figures"), (std::set<std::string>{}));
  EXPECT_THAT(text("out/report.html"), HasSubstr("Without pictures"));
  EXPECT_EQ(seiche("spectrum case.toml --out modes", path).exit, 1);
  EXPECT_EQ(names("modes"), (std::set<std::string>{"spectrum.csv"}));

  for (const char* name : {"energy.png", "energy_dark.png", "profiles_u.svg"})
    write(fs::path("out/figures") / name, "whole");
  write("out/report.html", text("out/report.html") + "<!-- with pictures -->");
  EXPECT_EQ(seiche("plot out", path).exit, 1);
  EXPECT_EQ(names("out/figures"), (std::set<std::string>{"energy.png", "energy_dark.png", "profiles_u.svg"}));
  EXPECT_EQ(text("out/figures/energy.png"), "whole");
  EXPECT_THAT(text("out/report.html"), HasSubstr("with pictures")) << "they are in it";
}

// An ffmpeg that gives up behind half a film.
TEST_F(RunFolders, AFilmIsWholeOrNotThere) {
  if (!test::can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  write_case();
  ASSERT_EQ(seiche("run case.toml --out out --quiet --set problem.points=[8,8] problem.length=[2.0,2.0] "
                   "output.snapshot_every=16")
                .exit,
            0)
      << text("stderr.txt");
  fs::create_directories(directory / "bin");
  const auto program = [&](const fs::path& name, const std::string& script) {
    write("bin" / name, "#!/bin/sh\n" + script);
    fs::permissions(directory / "bin" / name, fs::perms::owner_all);
  };
  program("ffmpeg", "for last; do :; done\necho half >$last\nexit 1\n");
  EXPECT_EQ(seiche("plot out", "PATH=\"" + (directory / "bin").string() + ":$PATH\"").exit, 0) << text("stderr.txt");
  EXPECT_THAT(text("stderr.txt"), HasSubstr("an animated picture, since ffmpeg failed"));
  const std::set<std::string> drawn = names("out/figures");
  EXPECT_TRUE(drawn.count("film_u.webp") == 1 && drawn.count("film_u_dark.webp") == 1);
  for (const char* half : {"film_u.mp4", "film_u.webm", "film_u_dark.mp4", "film_u_dark.webm"})
    EXPECT_EQ(drawn.count(half), 0U) << half;
}

}  // namespace TEST_FILE
}  // namespace seiche::test
