// A case file, checked: what to run, with which method, and what to record.
#pragma once

#include <seiche/config/case/drive_case.hpp>
#include <seiche/config/case/ensemble_case.hpp>
#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/core/parameter.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/problem/problems.hpp>
#include <seiche/simulation/simulation.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace seiche {

struct PresetData {
  std::string name;
  bool operator==(const PresetData&) const = default;
};
struct FileData {
  std::filesystem::path file;  // absolute: the case file is copied to where the results are
  bool operator==(const FileData&) const = default;
};
struct FormulaData {
  std::map<std::string, std::string> formulas;  // field → formula in x, j and the problem's real parameters
  bool operator==(const FormulaData&) const = default;
};
using InitialData = std::variant<PresetData, FileData, FormulaData>;

// When a run keeps a checkpoint, beside those that signals ask for.
struct CheckpointSpec {
  std::optional<double> every_seconds = {};  // 0: never by the clock; none: as CheckpointKeeper finds right
  std::int64_t every_steps = 0;              // 0: never by steps
  std::int64_t keep = 2;                     // files: the newest, and the one before it
  bool operator==(const CheckpointSpec&) const = default;
};

struct RunSpec {
  std::string source;                         // how errors call the case: its file name
  std::vector<std::string> overrides;         // and what --set gave beside it, "section.key=value"
  std::map<std::string, std::string> places;  // of its keys: "problem.gamma" → "case.toml:3:9"

  std::string problem;
  std::optional<CustomProblem> custom;                 // of the problem "custom"
  std::shared_ptr<const ProblemEntry> entry;           // of that problem; null for those of the list
  ParameterValues parameters;                          // one for every Parameter of the problem
  std::map<std::string, std::string> parameter_texts;  // the same as written: "1/3", "0.1 + 0.05*sin(t)"
  InitialData initial;
  DriveSpec drives;

  std::string method = "seisav";    // or "auto"
  double h = 0.0;                   // the step size; beside a tolerance the first one, or 0
  std::optional<double> tolerance;  // steps of variable size
  bool h_is_default = false;        // the case says nothing about it
  double h_max = 0.0;               // and none longer than this; 0: no bound
  MethodOptions method_options;
  std::string backend = "auto";
  bool measure_plans = false;
  SparseOptions sparse;

  Noise noise;

  double t_start = 0.0, t_end = 0.0;
  std::string output_directory;
  std::int64_t energy_every = 1;     // steps
  std::int64_t snapshot_every = 64;  // steps; 0: the first and the last state only
  bool ledger = false;               // columns in energy.csv: where the change of H comes from
  bool report = true;                // report.html
  double join_below = 8;             // GB: at the end segments of less become one file
  CheckpointSpec checkpoint;
  double snapshot_interval = 0.0;  // time; 0: by steps. With a tolerance only
  bool snapshots_given = false;    // one of the two at least

  std::optional<EnsembleSpec> ensemble;  // none: one run

  std::vector<std::string> notes;  // what the user should know before the run

  double duration() const { return t_end - t_start; }
};

// Of the list, or of the custom problem.
const ProblemEntry& problem_entry(const RunSpec& spec);

// What formulas may name beside the place and the time: parameters that are real or whole (of one per axis, that of the
// first), and on a grid dx, dy, dz.
FormulaConstants formula_constants(const RunSpec& spec);

// What this one of several processes holds of it. Throws Error where the parameters do not fit together, or the initial
// data do not fit the state.
Problem make_problem(const RunSpec& spec, const Rank& here = {});

SimulationOptions simulation_options(const RunSpec& spec);

// Why no energy law is promised with the options of the method or beside noise, or "".
std::string objection_of(const RunSpec& spec);

// Throws Error where there is noise, which `what` could not tell from errors.
void refuse_noise(const RunSpec& spec, std::string_view what);

// Those that the case names: initial states and matrices, each once.
std::vector<std::filesystem::path> input_files(const RunSpec& spec);

// Notes before a run on the case and the problem, and on a step size that was chosen for the case.
std::vector<std::string> case_notes(const RunSpec& spec, const Problem& problem);

// Where the method is "auto": what Simulation chooses for the case takes its place, with the reason among the notes.
void settle_method(RunSpec& spec);

// Where there is a tolerance and no word about snapshots: as many as make a smooth picture, by an interval that divides
// the run. 1024 of up to 16 unknowns, whose pictures are curves; else 512, or fewer, so that all have about 2²⁴
// numbers; 16 at least.
void settle_snapshots(RunSpec& spec, const Problem& problem);

}  // namespace seiche
