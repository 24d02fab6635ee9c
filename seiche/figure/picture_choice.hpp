// Which pictures a finished run gives: its energies, its ledger, and the solution in the manner that its dimension asks
// for.
#pragma once

#include <seiche/figure/plot/map_plot.hpp>
#include <seiche/figure/plot/plot.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/study/energy_history.hpp>
#include <seiche/study/run_files.hpp>

#include <optional>
#include <string>
#include <vector>

namespace seiche {

struct MapPicture {
  std::string caption;
  MapPlot plot;
};

// H(t) with the modified energy where there is one, and the ledger where it was kept.
std::vector<CurvePicture> energy_curves(const RunFiles& run, const EnergyHistory& history);

// A column of the ledger in words. Where a method takes its damping in one piece, as collocation does, the ledger has
// all of it in the first of its two columns, and it is called so.
std::string cause_label(const EnergyHistory& history, const std::string& column);

// What titles call the run: its problem, or its folder where the problem was written down and has no name of its own.
std::string run_name(const RunFiles& run);

// Below every title of a run that is not what was asked for: "failed at t = 3.2", "the energy law is violated"; else
// "".
std::string shortfall(const RunFiles& run);

// "pendulum, SEISAV, h = 2⁻⁶: energy".
std::string title_of(const RunFiles& run, const std::string& what);

// Few points: every field over time, and the phase portrait. Lines and rows of points: profiles at some times.
std::vector<CurvePicture> solution_curves(const RunFiles& run, const SolutionReader& solution);

// Lines and rows of points: every field over x and t. Planes: at four times. Boxes: the middle planes at the first and
// the last time.
std::vector<MapPicture> solution_maps(const RunFiles& run, const SolutionReader& solution);

// The bars of a truss at the first and the last time, where the file holds some, and no more than can be seen.
std::optional<CurvePicture> bars_picture(const RunFiles& run, const SolutionReader& solution);

// Of a plane: a field at time k as one picture of a film; `colours` are those of the whole film.
MapPlot film_frame(const RunFiles& run, const SolutionReader& solution, Index field, Index k,
                   const ColourScale& colours);
// " The scale ends at …", where it ends before the largest value; else "".
std::string scale_remark(const ColourScale& scale);
// The smallest and the largest value of a field at some times, as a scale for all of them.
ColourScale common_scale(const SolutionReader& solution, Index field, const std::vector<Index>& times);

// At most `most` of `count` things, evenly, the first and the last among them.
std::vector<Index> spread(Index count, Index most);

}  // namespace seiche
