// What the paper's experiments give, as plain data: figures, the report, CSV files and JSON are made from it.
#pragma once

#include <seiche/study/results.hpp>

#include <string>
#include <vector>

namespace seiche {

// One example of the paper.
struct ExampleResult {
  std::string key;         // file-name stem: "klein_gordon", "alpha_fpu_conservative", …
  std::string title;       // "Example 1: damped nonlinear Klein–Gordon equation"
  std::string equation;    // "u_tt + γu_t − κΔu + ω²u + αu³ = 0"
  std::string parameters;  // one line
  double t_end = 0.0;
  std::vector<std::string> methods;  // in the order of legends
  std::vector<double> step_sizes;    // large to small
  std::vector<StudyRow> rows;
  double curve_h = 0.0;              // step size of the energy curves
  std::vector<Curve> energy;         // H(zⁿ) per method, and "reference" last
  std::vector<Curve> energy_errors;  // |H(zⁿ) − H(z(tₙ))| per method
  std::string reference;             // what the errors are measured against
  double reference_error = 0.0;      // how far two such references lie apart
};

// A study of its own: curves of something against something, for one figure.
struct SideStudy {
  std::string key;
  std::string title;
  std::string explanation;  // two or three sentences for the report
  std::string x_label, y_label;
  bool log_x = true, log_y = true;
  std::vector<Curve> curves;  // t holds the abscissae
};

enum class Outcome { holds, does_not_hold, depends };

// One claim of the paper about its experiments, and what was measured here.
struct Verdict {
  std::string example;   // "Example 1", …, "all"
  std::string claim;     // in our own words
  std::string source;    // where the paper says so: section, figure
  std::string measured;  // the numbers
  Outcome outcome = Outcome::depends;
  std::string remark;  // when it holds and when not; may be empty
};

struct PaperResults {
  bool quick = false;
  std::vector<ExampleResult> examples;
  std::vector<SideStudy> side_studies;
  std::vector<Verdict> verdicts;
  double seconds = 0.0;
};

inline std::string to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::holds: return "holds";
    case Outcome::does_not_hold: return "does not hold";
    case Outcome::depends: return "depends";
  }
  return "unknown";
}

}  // namespace seiche
