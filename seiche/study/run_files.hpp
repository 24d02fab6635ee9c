// What a run left in its folder, read back: the case, the summary, the certificate.
#pragma once

#include <seiche/config/case/run_spec.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seiche {

struct EnergyNumbers {
  double initial, final, max_increase;  // NaN where the file has none
};

struct HypothesisFound {
  std::string name, grade, statement, witness;
};

struct RunFiles {
  std::filesystem::path directory;
  std::filesystem::path solution;              // solution.h5, or of a run that has not ended a file that shows as much
  std::shared_ptr<const void> temporary = {};  // keeps that file
  bool is_running = false;                     // in a program that holds its folder
  bool has_ended = true;                       // else it has no law, no counts and no certificate yet
  RunSpec spec;
  std::string case_text;
  std::string title, equation, reference, method_reference;  // of the problem and the method

  std::string status, message, problem, method, backend;
  std::int64_t steps = 0;
  double t = 0.0;
  EnergyNumbers energy{};
  std::optional<EnergyNumbers> modified;
  std::string law;                                           // "holds", "violated", "not promised", "not tested"
  std::vector<std::pair<std::string, std::int64_t>> counts;  // in the order of the file
  double wall_seconds = 0.0;
  std::string finished;  // 2026-11-26T12:40:33Z; "" where the file has none
  std::map<std::string, std::string> versions;
  std::vector<HypothesisFound> hypotheses;
  bool promised = false;
  std::string law_reason, theorem;  // why (not); "" if none is promised
};

// What follows from the case alone.
RunFiles run_of_case(const std::filesystem::path& directory, const RunSpec& spec, const std::string& case_text);

// Throws Error where `directory` is not that of a single finished run, saying what is missing.
RunFiles read_run(const std::filesystem::path& directory);

// What titles call the run: the title of its problem, or its folder where the problem was written down and has none.
std::string run_name(const RunFiles& run);
std::string run_name(const std::string& title, const std::string& problem, const std::filesystem::path& directory);

// How a run ended that did not come to its end: "failed at t = 3.2", "still running, up to t = 3.2"; else "".
std::string early_end(const RunFiles& run);
// Below every title of a run that is not what was asked for: its early end, "the energy law is violated"; else "".
std::string shortfall(const RunFiles& run);

}  // namespace seiche
