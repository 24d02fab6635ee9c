#include <seiche/config/case/case_keys.hpp>
#include <seiche/config/case/ensemble_case.hpp>
#include <seiche/config/case/key_rows.hpp>
#include <seiche/config/custom/custom_case.hpp>
#include <seiche/core/base/shortened.hpp>

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

const char* const of_problem = "problem";

// What other programs call keys of [problem], which depend on the problem.
struct Synonyms {
  const char* key;
  std::vector<std::string> words;
};

const std::vector<Synonyms>& synonyms_in_problem() {
  static const std::vector<Synonyms> all = {
      {"initial", {"z0", "y0", "u0", "ic", "initialcondition", "initialconditions", "initialstate"}},
      {"boundary", {"bc", "bcs", "boundaryconditions", "boundarycondition"}},
      {"points", {"n", "nx", "gridpoints", "resolution"}},
      {"length", {"l", "lx", "domain"}},
      {"gamma", {"damping", "dampingrate", "drag"}},
      {"H", {"hamiltonian", "energy"}},
      {"V", {"potential"}},
      {"S", {"structure", "poisson"}},
      {"D", {"damping", "dampingrate", "drag", "gamma"}},
  };
  return all;
}

bool has(const std::vector<std::string>& keys, const std::string& key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

std::string plain_word(std::string_view word) {
  std::string plain;
  for (const char c : word)
    if (c != '_' && c != '-') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return plain;
}

// Of what is no key, but may be asked for otherwise. "" where there is nothing to say.
std::string where_it_stands(const std::string& section, const std::string& key, const ProblemEntry* problem) {
  const std::string plain = plain_word(key);
  if (has({"threads", "nthreads", "cores", "jobs"}, plain))
    return "the number of threads changes no result, and stands on the command line: --threads 2";
  if (section == of_problem && problem != nullptr && has(problem->fields, key))
    return fmt::format("{0} is a field, whose values at the start stand in initial = {{ {0} = … }}", key);
  const bool is_listed = section == of_problem && problem != nullptr && problem->name != custom_name;
  if (is_listed && (key == "H" || key == "V" || has({"hamiltonian", "energy", "potential"}, plain)))
    return fmt::format("the energy of {} is given; one of your own is written with name = \"{}\"", problem->name,
                       custom_name);
  return "";
}

// { "method", "h" } for "h" and "dt", { "method", "tolerance" } for "rtol".
MeantKey meant_key(const std::string& word, const ProblemEntry* problem) {
  for (const std::string& section : case_sections())
    if (word != "name" && has(case_keys(section, nullptr), word)) return {section, word};
  const std::string plain = plain_word(word);
  for (const KeyRow& row : key_rows())
    if (has(row.synonyms, plain)) return {row.section, row.name};
  for (const Synonyms& key : synonyms_in_problem())
    if (has(key.words, plain) && has(case_keys(of_problem, problem), key.key)) return {of_problem, key.key};
  return {};
}

}  // namespace

std::vector<std::string> case_keys(const std::string& section, const ProblemEntry* problem) {
  std::vector<std::string> keys;
  for (const KeyRow& row : key_rows())
    if (row.section == section) keys.push_back(row.name);
  if (section == "ensemble") keys.emplace_back("initial");
  if (section == of_problem) keys = {"name", "initial", "friction", "force"};
  if (problem == nullptr) return keys;
  if (section == of_problem && problem->name == custom_name)
    keys.insert(keys.end(), custom_keys().begin(), custom_keys().end());
  for (const Parameter& parameter : problem->parameters)
    if (section == of_problem || (section == "ensemble" && may_vary(parameter))) keys.push_back(parameter.name);
  return keys;
}

std::string full_key(const std::string& word) {
  const MeantKey meant = meant_key(word, nullptr);
  return meant.key.empty() ? "" : meant.section + "." + meant.key;
}

std::string key_outside_sections(const std::string& key, const ProblemEntry* problem) {
  const std::vector<std::string>& sections = case_sections();
  if (has(sections, key)) return fmt::format("{0} must be a section, [{0}]", key);
  for (const std::string& section : sections)
    if (key != "name" && has(case_keys(section, problem), key))
      return fmt::format("the key '{}' stands outside every section; it belongs into [{}]", shortened(key), section);
  if (const MeantKey meant = meant_key(key, problem); !meant.key.empty())
    return fmt::format("the key '{}' stands outside every section; did you mean '{}' in [{}]?", shortened(key),
                       meant.key, meant.section);
  return fmt::format("the key '{}' stands outside every section ({})", shortened(key), fmt::join(sections, ", "));
}

Error unknown_key(const std::string& section, const std::string& key, const ProblemEntry* problem) {
  const std::string where = section == "problem" && problem != nullptr ? fmt::format("[problem] {}", problem->name)
                                                                       : fmt::format("[{}]", section);
  const std::string kind = "key in " + where;
  const std::vector<std::string> keys = case_keys(section, problem);
  const MeantKey meant = meant_key(key, problem);
  if (const std::string elsewhere = where_it_stands(section, key, problem); !elsewhere.empty())
    return Error({.sentence = fmt::format("unknown {} '{}': {}. Allowed: {}", kind, shortened(key), elsewhere,
                                          fmt::join(keys, ", ")),
                  .kind = kind,
                  .name = key,
                  .allowed = keys});
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
