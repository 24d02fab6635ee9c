#include <seiche/config/case/case_keys.hpp>
#include <seiche/config/case/ensemble_case.hpp>
#include <seiche/config/case/method_section.hpp>
#include <seiche/config/custom/custom_case.hpp>
#include <seiche/core/text/shortened.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace seiche {
namespace {

// A key by its meaning.
struct MeantKey {
  std::string section, key;  // both "" for a word that means none
};

// What other programs call the keys of a case file.
struct Synonyms {
  const char* section;
  const char* key;
  std::vector<std::string> words;  // lower case, without "_"
};

const std::vector<Synonyms>& synonyms() {
  static const std::vector<Synonyms> all = {
      {"method", "name", {"method", "solver", "integrator", "scheme"}},
      {"method", "h", {"dt", "h0", "dt0", "deltat", "step", "stepsize", "timestep", "timestepsize", "firststep"}},
      {"method",
       "tolerance",
       {"tol", "rtol", "atol", "reltol", "abstol", "relativetolerance", "absolutetolerance", "accuracy", "precision"}},
      {"method", "h_max", {"hmax", "maxh", "dtmax", "maxdt", "maxstep", "maxstepsize", "maximumstep"}},
      {"time", "start", {"t0", "tstart", "tbegin", "starttime", "initialtime"}},
      {"time", "end", {"t", "tend", "tmax", "tfinal", "finaltime", "endtime", "tstop", "duration"}},
      {"output", "directory", {"dir", "folder", "out", "outdir"}},
      {"output", "snapshot_interval", {"saveat", "dtout", "dtsave", "saveinterval"}},
      {"output", "snapshot_every", {"saveevery", "nsave", "nout"}},
      {"problem", "initial", {"z0", "y0", "u0", "ic", "initialcondition", "initialconditions", "initialstate"}},
      {"problem", "boundary", {"bc", "bcs", "boundaryconditions", "boundarycondition"}},
      {"problem", "points", {"n", "nx", "gridpoints", "resolution"}},
      {"problem", "length", {"l", "lx", "domain"}},
  };
  return all;
}

// { "method", "h" } for "dt", { "method", "tolerance" } for "rtol".
MeantKey meant_key(std::string_view word) {
  std::string plain;
  for (const char c : word)
    if (c != '_' && c != '-') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Synonyms& key : synonyms())
    if (std::find(key.words.begin(), key.words.end(), plain) != key.words.end()) return {key.section, key.key};
  return {};
}

bool has(const std::vector<std::string>& keys, const std::string& key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

// As far as this case knows the key.
MeantKey meant_here(const std::string& word, const ProblemEntry* problem) {
  const MeantKey meant = meant_key(word);
  return has(case_keys(meant.section, problem), meant.key) ? meant : MeantKey{};
}

}  // namespace

std::vector<std::string> case_sections() {
  return {"problem", "method", "backend", "time", "output", "checkpoint", "ensemble"};
}

std::vector<std::string> case_keys(const std::string& section, const ProblemEntry* problem) {
  if (section == "method") {
    std::vector<std::string> keys = {"name", "h", "tolerance", "h_max"};
    for (const MethodOptionKey& option : method_option_keys()) keys.push_back(option.name);
    return keys;
  }
  if (section == "backend") return {"name", "plan", "exponential", "pade_degree", "lanczos_dimension"};
  if (section == "time") return {"start", "end"};
  if (section == "output")
    return {"directory", "energy_every", "ledger", "report", "snapshot_every", "snapshot_interval"};
  if (section == "checkpoint") return {"every_seconds", "every_steps", "keep"};
  if (section == "ensemble") return ensemble_keys(problem);
  std::vector<std::string> keys = {"name", "initial", "friction", "force"};
  if (problem != nullptr && problem->name == custom_name)
    keys.insert(keys.end(), custom_keys().begin(), custom_keys().end());
  if (problem != nullptr)
    for (const Parameter& parameter : problem->parameters) keys.push_back(parameter.name);
  return keys;
}

std::string full_key(const std::string& word) {
  for (const std::string& section : case_sections())
    if (word != "name" && has(case_keys(section, nullptr), word)) return section + "." + word;
  const MeantKey meant = meant_here(word, nullptr);
  return meant.key.empty() ? "" : meant.section + "." + meant.key;
}

std::string key_outside_sections(const std::string& key, const ProblemEntry* problem) {
  const std::vector<std::string> sections = case_sections();
  if (has(sections, key)) return fmt::format("{0} must be a section, [{0}]", key);
  for (const std::string& section : sections)
    if (key != "name" && has(case_keys(section, problem), key))
      return fmt::format("the key '{}' stands outside every section; it belongs into [{}]", shortened(key), section);
  if (const MeantKey meant = meant_here(key, problem); !meant.key.empty())
    return fmt::format("the key '{}' stands outside every section; did you mean '{}' in [{}]?", shortened(key),
                       meant.key, meant.section);
  return fmt::format("the key '{}' stands outside every section ({})", shortened(key), fmt::join(sections, ", "));
}

Error unknown_key(const std::string& section, const std::string& key, const ProblemEntry* problem) {
  const std::string where = section == "problem" && problem != nullptr ? fmt::format("[problem] {}", problem->name)
                                                                       : fmt::format("[{}]", section);
  const std::string kind = "key in " + where;
  const std::vector<std::string> keys = case_keys(section, problem);
  const MeantKey meant = meant_here(key, problem);
  if (meant.key.empty()) return unknown_name(kind, key, keys);
  if (meant.section != section)
    return Error({.sentence = fmt::format("unknown {} '{}'; did you mean '{}' in [{}]?", kind, shortened(key),
                                          meant.key, meant.section),
                  .kind = kind,
                  .name = key,
                  .nearest = meant.section + "." + meant.key});
  return Error({.sentence = fmt::format("unknown {} '{}'; did you mean '{}'? Allowed: {}", kind, shortened(key),
                                        meant.key, fmt::join(keys, ", ")),
                .kind = kind,
                .name = key,
                .nearest = meant.key,
                .allowed = keys});
}

}  // namespace seiche
