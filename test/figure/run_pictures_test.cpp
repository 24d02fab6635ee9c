// Which pictures and films a run gives; what stands in them is tested with the programs that draw them
// (python/tests/test_drawing.py).
#include <test/support/run_folder.hpp>

#include <fmt/format.h>
#include <seiche/config/case/run_spec.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/problem/truss.hpp>
#include <seiche/study/energy_history.hpp>

#include <cstdlib>
#include <fstream>
#include <tuple>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using test::can_draw;
using test::text_of;
using testing::AllOf;
using testing::HasSubstr;

using PictureChoice = test::RunFolder;

TEST_F(PictureChoice, AFilmIsThereOnBothGroundsAndInTheReport) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  run("klein_gordon", "problem.points=[12,8] problem.length=[2.0,2.0] output.snapshot_every=4");
  ASSERT_EQ(seiche("plot --format png '" + out().string() + "'"), 0) << said();
  EXPECT_THAT(report(), HasSubstr("5 frames with one scale of colours"));
  for (const char* film : {"class=\"on-light\" src=\"figures/film_u.", "class=\"on-dark\" src=\"figures/film_u_dark."})
    EXPECT_THAT(report(), HasSubstr(film));
}

TEST_F(PictureChoice, WithoutFfmpegAFilmIsAnAnimatedPicture) {
  if (std::system("/usr/bin/python3 -c 'import matplotlib, h5py' 2>/dev/null") != 0)
    GTEST_SKIP() << "the system's Python has no Matplotlib or h5py";
  run("klein_gordon", "problem.points=[12,8] problem.length=[2.0,2.0] output.snapshot_every=4");
  ASSERT_EQ(seiche("plot --format png '" + out().string() + "'", "PATH=/nonexistent"), 0) << said();
  EXPECT_THAT(said(), HasSubstr("ffmpeg was not found on the PATH"));
  for (const char* film : {"film_u.webp", "film_u_dark.webp"}) {
    const std::string bytes = text_of(out() / "figures" / film);
    EXPECT_TRUE(bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP") << film;
    EXPECT_NE(bytes.find("ANMF"), std::string::npos) << "it moves";
    EXPECT_THAT(report(), HasSubstr(fmt::format("src=\"figures/{}\"", film)));
  }
}

// Both kinds, the second where ffmpeg was built without H.264.
TEST_F(PictureChoice, AFilmHasAllItsFramesAndSaysWhichColoursTheyAre) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  if (std::system("ffmpeg -version >/dev/null 2>&1 && ffprobe -version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "ffmpeg is not installed";
  run("klein_gordon", "problem.points=[12,8] problem.length=[2.0,2.0] output.snapshot_every=4");
  fs::create_directory(directory / "bin");
  std::ofstream(directory / "bin/ffmpeg") << "#!/bin/sh\ncase \"$*\" in *libx264*) exit 1;; esac\n"
                                             "PATH=${PATH#*:}\nexec ffmpeg \"$@\"\n";
  fs::permissions(directory / "bin/ffmpeg", fs::perms::owner_all);
  const std::string without_h264 = "PATH='" + (directory / "bin").string() + "':\"$PATH\"";
  for (const auto& [before, file, codec] :
       {std::tuple("", "film_u.mp4", "h264"), {without_h264.c_str(), "film_u_dark.webm", "vp9"}}) {
    ASSERT_EQ(seiche("plot --format png '" + out().string() + "'", before), 0) << said();
    const fs::path film = out() / "figures" / file;
    ASSERT_TRUE(fs::exists(film)) << said();
    const std::string probe =
        "ffprobe -v error -count_frames -show_entries "
        "stream=codec_name,width,height,pix_fmt,color_range,color_space,nb_read_frames -of csv '" +
        film.string() + "' >'" + (directory / "probe.txt").string() + "'";
    ASSERT_EQ(std::system(probe.c_str()), 0);
    EXPECT_THAT(text_of(directory / "probe.txt"), testing::StartsWith(fmt::format("stream,{},720,", codec)));
    EXPECT_THAT(text_of(directory / "probe.txt"), HasSubstr("yuv420p,tv,bt709,5")) << "colours, frames";
  }
}

TEST_F(PictureChoice, DampingInOnePieceIsNotCalledAHalf) {
  run("oscillator", "problem.gamma=0.1 time.end=2 method.name=egc4");
  const EnergyHistory history = read_energy_history(out() / "energy.csv");
  EXPECT_EQ(cause_label(history, "damping_left"), "damping");
  EXPECT_EQ(cause_label(history, "projection"), "projection");
  run("oscillator", "problem.gamma=0.1 time.end=2");
  EXPECT_EQ(cause_label(read_energy_history(out() / "energy.csv"), "damping_left"),
            "damping, half step before the Hamiltonian step");
}

TEST_F(PictureChoice, RunsByToleranceLeaveStatesEnoughForACurve) {
  const auto count = [&](const std::string& output) {
    std::ofstream(directory / "case.toml") << "[problem]\nname = \"oscillator\"\n[method]\nname = \"egc6\"\n"
                                              "tolerance = 1e-6\n[time]\nend = 20\n"
                                           << output;
    EXPECT_EQ(seiche("run '" + (directory / "case.toml").string() + "' --quiet --out '" + out().string() + "'"), 0)
        << said();
    return SolutionReader(out() / "solution.h5").count();
  };
  EXPECT_LT(count("[output]\nsnapshot_every = 64\n"), 20) << "what is asked for is done";
  EXPECT_EQ(count("[output]\nsnapshot_interval = 2\n"), 11);
  EXPECT_EQ(count(""), 1025);
  EXPECT_THAT(text_of(out() / "case.toml"), HasSubstr("snapshot_interval = 0.01953125"));
}

TEST(DefaultSnapshots, AreFewerOfLargeStates) {
  const auto count = [](Index points) {
    RunSpec spec;
    spec.tolerance = 1e-6;
    spec.t_end = 3.3;
    Problem problem;
    problem.grid.axes = {{.intervals = points}};
    problem.fields = {"u", "v"};
    settle_snapshots(spec, problem);
    return spec.t_end / spec.snapshot_interval;
  };
  EXPECT_EQ(count(8), 1024);
  EXPECT_EQ(count(9), 512);
  EXPECT_EQ(count(1 << 14), 512);
  EXPECT_EQ(count(1 << 16), 128);
  EXPECT_EQ(count(1 << 24), 16);
  RunSpec fixed;
  fixed.t_end = 1;
  settle_snapshots(fixed, Problem{});
  EXPECT_EQ(fixed.snapshot_interval, 0) << "steps of one size count";
}

TEST_F(PictureChoice, BarsOfATrussAreInItsFile) {
  run("truss", "time.end=1 problem.amplitude=0.2");
  const SolutionReader solution(out() / "solution.h5");
  const Grid& grid = truss({}).grid;
  EXPECT_EQ(solution.bars(), grid.bars);
  EXPECT_EQ(solution.supports(), grid.supports);
  ASSERT_EQ(grid.bars.size(), 21U) << "6 + 4 of the chords, 5 verticals, 2 ends, 4 diagonals";
  std::set<Index> met;
  for (const auto& bar : grid.bars) met.insert(bar.begin(), bar.end());
  EXPECT_EQ(met.size(), 12U) << "ten nodes and two supports";
}

TEST_F(PictureChoice, FilmsShowTheFieldsThatAreAskedFor) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  run("klein_gordon", "problem.points=[6,6] problem.length=[2.0,2.0] output.snapshot_every=16");
  const auto films = [&] {
    std::set<std::string> stems;
    for (const auto& entry : fs::directory_iterator(out() / "figures"))
      if (entry.path().filename().string().starts_with("film_")) stems.insert(entry.path().stem().string());
    return stems;
  };
  ASSERT_EQ(seiche("plot --format png --film v '" + out().string() + "'"), 0) << said();
  EXPECT_EQ(films(), (std::set<std::string>{"film_v", "film_v_dark"}));
  ASSERT_EQ(seiche("plot --format png --film v,u '" + out().string() + "'"), 0) << said();
  EXPECT_EQ(films().size(), 4U);
  ASSERT_EQ(seiche("plot --format png --no-film '" + out().string() + "'"), 0) << said();
  EXPECT_EQ(films().size(), 0U) << "those of an earlier call are gone";
  EXPECT_EQ(seiche("plot --film w '" + out().string() + "'"), 2);
  EXPECT_THAT(said(), HasSubstr("unknown --film 'w'"));
  run("klein_gordon");
  EXPECT_EQ(seiche("plot --film u '" + out().string() + "'"), 2);
  EXPECT_THAT(said(), HasSubstr("films are of solutions in the plane"));
}

TEST_F(PictureChoice, ColoursAndSizesAreAsAskedFor) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  run("klein_gordon");
  const auto plot = [&](const std::string& options) {
    return seiche("plot --format png " + options + " '" + out().string() + "'");
  };
  ASSERT_EQ(plot("--palette magma --range 0.1,0.2"), 0) << said();
  EXPECT_THAT(report(), HasSubstr("The scale goes from 0.1 to 0.2"));
  ASSERT_EQ(plot("--range u=0.1,0.3 --range v=-0.01,0.02"), 0) << said();
  EXPECT_THAT(report(),
              AllOf(HasSubstr("The scale goes from 0.1 to 0.3"), HasSubstr("The scale goes from −0.01 to 0.02")));
  ASSERT_EQ(plot("--centre 0.3 --size 12"), 0) << said();
  EXPECT_NEAR(read_png(out() / "figures/energy.png").width, 12 / 2.54 * 300, 1);
  ASSERT_EQ(plot("--journal"), 0) << said();
  EXPECT_NEAR(read_png(out() / "figures/energy.png").width, 8.6 / 2.54 * 300, 1);
  for (const auto& [options, words] :
       {std::pair("--palette viridiss", "unknown --palette 'viridiss'; did you mean 'viridis'?"),
        {"--range 2,1", "must be two numbers with a comma"},
        {"--range 1", "must be two numbers with a comma"},
        {"--range 1,2,3", "must be two numbers with a comma"},
        {"--range =1,2", "must be two numbers with a comma"},
        {"--range w=1,2", "there is no field 'w'; the fields are u, v"},
        {"--size 0", "--size 0 must be a width in centimetres from 6 to 60"},
        {"--size 1", "must be a width in centimetres"}}) {
    EXPECT_EQ(plot(options), 2) << options;
    EXPECT_THAT(said(), HasSubstr(words));
  }
}

TEST_F(PictureChoice, AnEnsembleHasItsEnergiesAndWhatEachParameterDoes) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  std::ofstream(directory / "case.toml") << "[problem]\nname = \"oscillator\"\n[method]\nh = \"1/32\"\n[time]\n"
                                            "end = 4.0\n[ensemble]\nmembers = 20\ngamma = { uniform = [0.1, 0.4] }\n";
  ASSERT_EQ(seiche("run '" + (directory / "case.toml").string() + "' --quiet --out '" + out().string() + "'"), 0);
  ASSERT_EQ(seiche("plot --format pdf '" + out().string() + "'"), 0) << said();
  EXPECT_THAT(said(), HasSubstr("2 in "));
  for (const char* file : {"energy.png", "energy_dark.png", "energy.pdf", "members_gamma.png", "members_gamma.pdf"})
    EXPECT_GT(fs::file_size(out() / "figures" / file), 4000U) << file;
  EXPECT_EQ(seiche("plot --range 0,1 '" + out().string() + "'"), 2);
  EXPECT_THAT(said(), HasSubstr("have nothing to colour"));
  EXPECT_EQ(seiche("plot '" + out().string() + "'", "SEICHE_PYTHON=/bin/false"), 1);
  EXPECT_TRUE(fs::exists(out() / "figures/energy.pdf")) << "what cannot be drawn again stays";
}

}  // namespace TEST_FILE
}  // namespace seiche
