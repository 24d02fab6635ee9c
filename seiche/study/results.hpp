// What the studies measure, as plain data: everything that figures, reports, CSV files and JSON are made from.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace seiche {

// One method at one step size against the reference.
struct StudyRow {
  std::string method;
  double h = 0.0;
  double error = 0.0;                  // max_n ‖zⁿ − z(tₙ)‖_∞, physical values
  double energy_error = 0.0;           // max_n |H(zⁿ) − H(z(tₙ))|
  double max_energy_increase = 0.0;    // max_n H(zⁿ⁺¹) − H(zⁿ)
  double max_modified_increase = 0.0;  // the same of the method's own energy
  std::optional<double> order;         // against the next larger h of the same method
  long long steps = 0;
  long long scalar_iterations = 0;
  long long fallbacks = 0;
  long long replaced = 0;  // steps that found no solution
  long long unresolved = 0;
  double cpu_seconds = 0.0;      // median of repeated runs after a warm-up, stepping only
  bool energy_law_held = false;  // no recorded step raised the method's energy beyond round-off
  std::string failure;           // "" if the run reached the end
};

// A function of time, thinned for drawing.
struct Curve {
  std::string name;
  std::vector<double> t;
  std::vector<double> value;
};

// One example of the paper.
struct ExampleResult {
  std::string key;         // file-name stem: "klein_gordon", "alpha_fpu_conservative", …
  std::string title;       // "Example 1: damped nonlinear Klein–Gordon equation"
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

std::string to_string(Outcome outcome);  // "holds", "does not hold", "depends"

}  // namespace seiche
