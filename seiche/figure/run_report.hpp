// report.html of one run: the case, how it ended, its certificate and ledger, its pictures, and how to repeat it, in
// one page that needs nothing beside it.
#pragma once

#include <seiche/figure/run_pictures.hpp>
#include <seiche/study/energy_history.hpp>
#include <seiche/study/run_files.hpp>

#include <string>

namespace seiche {

// Into `run.directory`. Pictures that are missing on the disk are named; with none at all the page says how to draw
// them, or why they could not be, if `no_pictures_because` tells.
void write_run_report(const RunFiles& run, const EnergyHistory& history, const RunPictures& pictures,
                      const std::string& no_pictures_because = {});

}  // namespace seiche
