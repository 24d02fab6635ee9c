// The command line of seiche_work_precision.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seiche::bench {

struct Options {
  std::filesystem::path out = "out/work_precision";
  std::vector<std::string> problems;
  std::vector<std::string> peer_names;  // empty: all of them
  std::vector<std::string> methods;     // of Seiche; empty: all that apply
  bool quick = false;
  bool peers = true;  // other integrators beside Seiche's methods
  bool help = false;
  int repeats = 5;
  double cap_seconds = 1.0;        // of one run: what is expected above it is skipped
  double problem_seconds = 100.0;  // of a problem, shared equally among its integrators

  static Options parse(const std::vector<std::string>& arguments);  // throws Error with what is allowed
};

extern const char* const usage;

}  // namespace seiche::bench
