// The curves that a finished run gives: its energies, its ledger, and the solution over time or along a line.
#pragma once

#include <seiche/figure/plot/plot.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/study/energy_history.hpp>
#include <seiche/study/run_files.hpp>

#include <string>
#include <vector>

namespace seiche {

// H(t) with the modified energy where there is one, and the ledger where it was kept.
std::vector<CurvePicture> energy_curves(const RunFiles& run, const EnergyHistory& history);

// Few points: every field over time, and the phase portrait. Lines and rows of points: profiles at some times.
std::vector<CurvePicture> solution_curves(const RunFiles& run, const SolutionReader& solution);

// A column of the ledger in words. Where a method takes its damping in one piece, as collocation does, the ledger has
// all of it in the first of its two columns, and it is called so.
std::string cause_label(const EnergyHistory& history, const std::string& column);

// "pendulum, SEISAV, h = 2⁻⁶: energy".
std::string title_of(const RunFiles& run, const std::string& what);

}  // namespace seiche
