// Which pictures a run gives, and what stands in them: scales, symbols, titles, curves that hide one another.
#include <test/support/run_folder.hpp>

#include <fmt/format.h>
#include <seiche/config/case/run_spec.hpp>
#include <seiche/figure/bars_picture.hpp>
#include <seiche/figure/plot/symbols.hpp>
#include <seiche/figure/run_curves.hpp>
#include <seiche/figure/run_maps.hpp>
#include <seiche/problem/truss.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <tuple>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using test::have_gnuplot;
using test::text_of;
using testing::HasSubstr;
using testing::Not;

using PictureChoice = test::RunFolder;

TEST_F(PictureChoice, AFilmOfThePlaneHasAFrameForEveryState) {
  if (!have_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  run("klein_gordon", "problem.points=[12,8] problem.length=[2.0,2.0] output.snapshot_every=4");
  ASSERT_EQ(seiche("plot --format png '" + out().string() + "'"), 0) << said();
  const std::size_t frames =
      static_cast<std::size_t>(std::distance(fs::directory_iterator(out() / "figures/film"), fs::directory_iterator()));
  EXPECT_EQ(frames, 10U) << "of light and of dark ground";
  for (const char* frame : {"u_0001", "u_0005"})
    EXPECT_NE(text_of(out() / fmt::format("figures/film/{}.png", frame)),
              text_of(out() / fmt::format("figures/film/{}_dark.png", frame)));
  const bool joined = fs::exists(out() / "figures/film_u.mp4") || fs::exists(out() / "figures/film_u.webm");
  const bool dark = fs::exists(out() / "figures/film_u_dark.mp4") || fs::exists(out() / "figures/film_u_dark.webm");
  EXPECT_EQ(joined, dark);
  if (!joined) {
    EXPECT_THAT(said(), HasSubstr("ffmpeg"));
    EXPECT_THAT(report(), HasSubstr("ffmpeg")) << "why there is no film";
    return;
  }
  for (const char* film : {"class=\"on-light\" src=\"figures/film_u.", "class=\"on-dark\" src=\"figures/film_u_dark."})
    EXPECT_THAT(report(), HasSubstr(film));
}

// Both kinds, the second where ffmpeg was built without H.264.
TEST_F(PictureChoice, AFilmHasAllItsFramesAndSaysWhichColoursTheyAre) {
  if (!have_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
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

TEST_F(PictureChoice, APortraitOfFewStatesPerTurnShowsThem) {
  const auto portrait = [&](const char* every) {
    run("oscillator",
        std::string("problem.alpha=0 problem.gamma=0 time.end=20 method.name=egc4 output.snapshot_every=") + every);
    return solution_curves(read_run(out()), SolutionReader(out() / "solution.h5")).at(1);
  };
  const CurvePicture fine = portrait("1");  // 2π·32 ≈ 201 states to a turn
  EXPECT_EQ(fine.plot.series.front().style.marker, Marker::none);
  EXPECT_EQ(fine.caption, "Phase portrait: p over q.");
  const CurvePicture coarse = portrait("16");  // 12.6
  EXPECT_EQ(coarse.plot.series.front().style.marker, Marker::circle);
  EXPECT_EQ(coarse.plot.series.front().marked.size(), 41U);
  EXPECT_FALSE(coarse.plot.series.front().only_markers);
  EXPECT_THAT(coarse.caption, HasSubstr("41 states that solution.h5 holds, about 13 to a turn"));
  EXPECT_THAT(coarse.caption, HasSubstr("output.snapshot_every"));
  const CurvePicture sparse = portrait("128");  // 1.6: there is no line that one could follow
  EXPECT_TRUE(sparse.plot.series.front().only_markers);
  EXPECT_THAT(sparse.caption, HasSubstr("too far apart to be joined"));
}

TEST_F(PictureChoice, PartsOfTheLedgerThatCoincideAreBothSeen) {
  run("oscillator", "problem.gamma=0.1 time.end=2");
  const std::vector<CurvePicture> curves = energy_curves(read_run(out()), read_energy_history(out() / "energy.csv"));
  const CurvePicture& ledger = curves.at(1);
  EXPECT_THAT(ledger.caption, HasSubstr("coincide"));
  EXPECT_THAT(ledger.caption, HasSubstr("There the first is the wide line"));
  ASSERT_EQ(ledger.plot.series.size(), 3U);
  const Series& before = ledger.plot.series[0];
  const Series& after = ledger.plot.series[1];
  EXPECT_EQ(before.label, "damping, half step before the Hamiltonian step");
  EXPECT_EQ(after.label, "damping, half step after the Hamiltonian step");
  EXPECT_EQ(before.style.dash, Dash::solid);
  EXPECT_NE(after.style.dash, Dash::solid);
  EXPECT_GE(before.style.width, 2 * after.style.width);
  EXPECT_GT(after.layer, before.layer);
}

TEST_F(PictureChoice, DampingInOnePieceIsNotCalledAHalf) {
  run("oscillator", "problem.gamma=0.1 time.end=2 method.name=egc4");
  const EnergyHistory history = read_energy_history(out() / "energy.csv");
  EXPECT_EQ(energy_curves(read_run(out()), history).at(1).plot.series.front().label, "damping");
  EXPECT_EQ(cause_label(history, "projection"), "projection");
}

TEST_F(PictureChoice, PortraitsPairACoordinateWithItsMomentum) {
  run("custom",
      "'problem.fields=[\"a\",\"b\",\"pa\",\"pb\"]' 'problem.H=\"pa^2/2+pb^2/2+a^2+b^4+a^2*b^2\"' "
      "'problem.initial={a=1,b=0,pa=0,pb=0.5}'");
  std::vector<std::string> stems;
  for (const CurvePicture& picture : solution_curves(read_run(out()), SolutionReader(out() / "solution.h5")))
    stems.push_back(picture.plot.stem);
  EXPECT_EQ(stems, (std::vector<std::string>{"fields", "portrait_a_pa", "portrait_b_pb"}));
}

TEST_F(PictureChoice, SlicesOfAFieldThatDiesDownHaveScalesOfTheirOwn) {
  const auto slices = [&](const char* gamma) {
    run("klein_gordon",
        std::string("problem.points=[12,12] problem.length=[4.0,4.0] time.end=12 output.snapshot_every=64 "
                    "problem.gamma=") +
            gamma);
    return solution_maps(read_run(out()), SolutionReader(out() / "solution.h5")).at(0);
  };
  const MapPicture damped = slices("1 problem.alpha=1 problem.omega_squared=4");
  EXPECT_THAT(damped.caption, HasSubstr("scale of colours of its own"));
  for (const MapPanel& panel : damped.plot.panels) {
    const auto [low, high] = std::minmax_element(panel.values.begin(), panel.values.end());
    ASSERT_TRUE(panel.colours);
    EXPECT_GE(panel.colours->high, *high);
    EXPECT_LE(panel.colours->high, std::max(-*low, *high)) << "it reaches no further than the panel needs";
  }
  const MapPicture slow = slices("1");
  EXPECT_THAT(slow.caption, HasSubstr("All have one scale"));
  for (const MapPanel& panel : slow.plot.panels) EXPECT_FALSE(panel.colours);
}

TEST(ColourScales, AreSymmetricWhereValuesLieOnBothSidesOfZero) {
  EXPECT_TRUE(colour_scale(-1, 2).diverging);
  EXPECT_EQ(colour_scale(-1, 2).low, -2);
  EXPECT_FALSE(colour_scale(0, 2).diverging);
  EXPECT_EQ(colour_scale(1, 2).low, 1);
  EXPECT_LT(colour_scale(0, 0).low, colour_scale(0, 0).high) << "a constant still needs a scale";
}

TEST(ColourScales, AreOfEachPanelWhereSizesDifferMuch) {
  const auto panels = [](const std::vector<double>& largest) {
    std::vector<MapPanel> all;
    for (const double value : largest) {
      all.emplace_back();
      all.back().values = {-value, value};
    }
    return all;
  };
  std::vector<MapPanel> alike = panels({1, 0.5, 0.3});
  EXPECT_EQ(choose_scales(alike).high, 1);
  for (const MapPanel& panel : alike) EXPECT_FALSE(panel.colours);
  std::vector<MapPanel> grow = panels({0.0002, 0.5, 1});
  EXPECT_EQ(choose_scales(grow).high, 1) << "of all the panels";
  for (const MapPanel& panel : grow) EXPECT_EQ(panel.colours.value_or(ColourScale{}).high, panel.values[1]);
  MapPlot plot{.stem = "grow", .title = "", .colour_label = "''", .panels = grow, .in_a_row = 3};
  const std::string script = map_script(plot, {});
  for (const char* ticks : {"('−2·10^{−4}' -0.0002", "'0' 0, ", "('−1' -1, '−0.5' -0.5, '0' 0, '0.5' 0.5, '1' 1)"})
    EXPECT_THAT(script, HasSubstr(ticks));
  std::vector<MapPanel> fade(2);
  fade[0].values = {0, 1};
  fade[1].values = {0.1, 0.1 + 1e-12};
  choose_scales(fade);
  EXPECT_EQ(fade[1].colours.value_or(ColourScale{1, 1}).low, 0) << "a difference of round-off is no pattern";
  std::vector<MapPanel> from_rest = panels({0, 1, 0.9});
  choose_scales(from_rest);
  for (const MapPanel& panel : from_rest) EXPECT_FALSE(panel.colours) << "zero is zero on any scale";
  std::vector<MapPanel> round_off = panels({1e-17, 1, 0.1});
  choose_scales(round_off);
  EXPECT_EQ(round_off[0].colours.value_or(ColourScale{0, 0}).high, 1) << "round-off is not blown up";
}

TEST(Symbols, AreSetAsInPrint) {
  EXPECT_THAT(symbol("u"), HasSubstr("Italic"));
  EXPECT_THAT(symbol("l1"), HasSubstr("_{"));
  EXPECT_THAT(symbol("px"), HasSubstr("_{"));
  EXPECT_THAT(symbol("theta"), HasSubstr("θ"));
  EXPECT_THAT(symbol("u_field"), Not(HasSubstr("_{")));
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
  const CurvePicture portrait = solution_curves(read_run(out()), SolutionReader(out() / "solution.h5")).at(1);
  EXPECT_EQ(portrait.caption, "Phase portrait: p over q.") << "no corner is seen";
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

TEST_F(PictureChoice, BarsOfATrussAreInItsFileAndDrawn) {
  run("truss", "time.end=1 problem.amplitude=0.2");
  const SolutionReader solution(out() / "solution.h5");
  const Grid& grid = truss({}).grid;
  EXPECT_EQ(solution.bars(), grid.bars);
  EXPECT_EQ(solution.supports(), grid.supports);
  ASSERT_EQ(grid.bars.size(), 21U) << "6 + 4 of the chords, 5 verticals, 2 ends, 4 diagonals";
  std::set<Index> met;
  for (const auto& bar : grid.bars) met.insert(bar.begin(), bar.end());
  EXPECT_EQ(met.size(), 12U) << "ten nodes and two supports";

  const std::optional<CurvePicture> picture = bars_picture(read_run(out()), solution);
  ASSERT_TRUE(picture);
  const std::vector<Series>& series = picture->plot.series;
  ASSERT_EQ(series.size(), 4U);
  Vector x, y;
  solution.field(0, solution.count() - 1, x);
  solution.field(1, solution.count() - 1, y);
  EXPECT_GT(y.cwiseAbs().maxCoeff(), 1e-3);
  const std::vector<Place> nodes = solution.nodes();
  for (std::size_t b = 0; b < grid.bars.size(); ++b) {
    for (std::size_t end = 0; end < 2; ++end) {
      const Index node = grid.bars[b][end];
      if (node >= solution.points()) continue;
      EXPECT_DOUBLE_EQ(series[2].x[2 * b + end] - x[node], nodes[static_cast<std::size_t>(node)][0]) << "t = 1";
      EXPECT_DOUBLE_EQ(series[2].y[2 * b + end] - y[node], nodes[static_cast<std::size_t>(node)][1]);
      EXPECT_DOUBLE_EQ(series[0].y[2 * b + end], nodes[static_cast<std::size_t>(node)][1]) << "at rest";
    }
  }
  const Plot& plot = picture->plot;
  EXPECT_NEAR((plot.x.high - plot.x.low) / axes_width, (plot.y.high - plot.y.low) / axes_height, 1e-12);
  EXPECT_THAT(plot_script(plot), HasSubstr("$s0l << EOD\n0 0\n1 0\n\n1 0\n2 0\n\n"))
      << "from the first support on, bar by bar";
  EXPECT_FALSE(bars_picture(read_run(out()), SolutionReader(out() / "solution.h5"))->plot.series[3].x.empty());
  run("truss", "time.end=0.125 problem.amplitude=0.001");
  const auto small = bars_picture(read_run(out()), SolutionReader(out() / "solution.h5"));
  EXPECT_THAT(small->caption, HasSubstr("Displacements are drawn 200 times as large"));
  EXPECT_THAT(small->plot.title, HasSubstr("displacements × 200"));
  run("network");
  EXPECT_FALSE(bars_picture(read_run(out()), SolutionReader(out() / "solution.h5")));
}

TEST_F(PictureChoice, EnergiesThatCoincideAreBothSeen) {
  run("klein_gordon");
  const CurvePicture energy = energy_curves(read_run(out()), read_energy_history(out() / "energy.csv")).at(0);
  EXPECT_THAT(energy.caption, HasSubstr("coincide"));
  ASSERT_EQ(energy.plot.series.size(), 2U);
  const LineStyle &under = energy.plot.series[0].style, &over = energy.plot.series[1].style;
  EXPECT_EQ(under.dash, Dash::solid);
  EXPECT_EQ(over.dash, Dash::dashed);
  EXPECT_GE(under.width, 2 * over.width);
  EXPECT_GT(energy.plot.series[1].layer, energy.plot.series[0].layer);
}

TEST_F(PictureChoice, NamesAndTitlesAreTheSameInEveryPicture) {
  std::ofstream(directory / "case.toml")
      << "[problem]\nname = \"custom\"\nfields = [\"theta\", \"p1\"]\nH = \"p1^2/2 - cos(theta)\"\n"
         "initial = { theta = \"1\", p1 = \"0\" }\n[method]\nh = 0.125\n[time]\nend = 2\n";
  ASSERT_EQ(seiche("run '" + (directory / "case.toml").string() + "' --quiet --out '" + out().string() + "'"), 0)
      << said();
  const RunFiles files = read_run(out());
  const std::vector<CurvePicture> curves = solution_curves(files, SolutionReader(out() / "solution.h5"));
  const Plot& fields = curves.at(0).plot;
  ASSERT_EQ(fields.series.size(), 2U);
  for (const char* set : {"{/:Italic θ}", "_{"}) {
    EXPECT_THAT(fields.y_label, HasSubstr(set));
    EXPECT_THAT(fields.series[0].literal + fields.series[1].literal, HasSubstr(set))
        << "in the legend as along the axis";
  }
  EXPECT_THAT(plot_script(fields), Not(HasSubstr("theta")));
  EXPECT_THAT(curves.at(1).caption, HasSubstr("p₁ over θ"));

  run("klein_gordon");
  const RunFiles wave = read_run(out());
  const SolutionReader solution(out() / "solution.h5");
  const std::string begin = "klein_gordon, SEISAV, h = 2⁻⁵: ";
  EXPECT_EQ(solution_maps(wave, solution).at(0).plot.title, begin + "u in space and time");
  EXPECT_EQ(solution_curves(wave, solution).at(0).plot.title, begin + "u at some times");
}

TEST_F(PictureChoice, FilmsShowTheFieldsThatAreAskedFor) {
  if (!have_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  run("klein_gordon", "problem.points=[6,6] problem.length=[2.0,2.0] output.snapshot_every=16");
  const auto frames = [&] {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(out() / "figures/film"))
      names.insert(entry.path().filename().string());
    return names;
  };
  const std::set<std::string> of_v = {"v_0001.png", "v_0001_dark.png", "v_0002.png", "v_0002_dark.png"};
  ASSERT_EQ(seiche("plot --format png --film v '" + out().string() + "'"), 0) << said();
  EXPECT_EQ(frames(), of_v);
  ASSERT_EQ(seiche("plot --format png --film v,u '" + out().string() + "'"), 0) << said();
  EXPECT_EQ(frames().size(), 8U);
  EXPECT_EQ(seiche("plot --film w '" + out().string() + "'"), 2);
  EXPECT_THAT(said(), HasSubstr("unknown --film 'w'"));
  run("klein_gordon");
  EXPECT_EQ(seiche("plot --film u '" + out().string() + "'"), 2);
  EXPECT_THAT(said(), HasSubstr("films are of solutions in the plane"));
}

TEST(ColourScales, ShowWhereTheyEndBeforeTheValues) {
  const auto script = [](double least, double most) {
    std::vector<double> values(400, 0.1);
    values[0] = least;
    values[1] = most;
    for (std::size_t i = 2; i < 200; ++i) values[i] = -0.1;
    CommonScale scale;
    scale.add(values);
    MapPlot plot{.stem = "ends", .title = "", .colour_label = "''", .colours = scale.scale()};
    plot.panels.emplace_back();
    plot.panels[0].columns = plot.panels[0].rows = 20;
    plot.panels[0].values = values;
    return map_script(plot, {});
  };
  EXPECT_THAT(script(-0.1, 0.1), Not(HasSubstr("polygon")));
  const std::string above = script(-0.1, 1.9), both = script(-1.9, 1.9);
  EXPECT_THAT(above, HasSubstr("set object 1 polygon"));
  EXPECT_THAT(above, HasSubstr("#590008")) << "in the last colour of the scale";
  EXPECT_THAT(above, Not(HasSubstr("set object 2 polygon")));
  EXPECT_THAT(both, HasSubstr("set object 2 polygon"));
}

TEST(ColourScales, OfManyPanelsAreOfOneKindAndEachNamed) {
  std::vector<MapPanel> panels(2);
  panels[0].values = {-0.001, 1, 0.5, 0};
  panels[1].values = {-0.001, 0.001, 0, 0};
  EXPECT_FALSE(choose_scales(panels).diverging);
  for (MapPanel& panel : panels) {
    EXPECT_TRUE(panel.colours.value_or(ColourScale{}).diverging) << "one of them is";
    panel.columns = panel.rows = 2;
  }
  MapPlot plot{
      .stem = "two", .title = "", .colour_label = "'words'", .colour_symbol = "'u'", .panels = panels, .in_a_row = 2};
  const std::string script = map_script(plot, {.formats = {"png"}});
  std::size_t named = 0;
  for (std::size_t at = 0; (at = script.find("set label 'u' at screen", at)) != std::string::npos; ++at) ++named;
  EXPECT_EQ(named, 2U) << "above every bar";
  EXPECT_THAT(script, Not(HasSubstr("'words'"))) << "and none that could belong to any";
}

}  // namespace TEST_FILE
}  // namespace seiche
