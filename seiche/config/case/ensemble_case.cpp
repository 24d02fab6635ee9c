#include <seiche/config/case/case_parameters.hpp>
#include <seiche/config/case/ensemble_case.hpp>
#include <seiche/core/base/error.hpp>

#include <fmt/ranges.h>

#include <algorithm>

namespace seiche {
namespace {

constexpr std::int64_t most_members = 10'000'000;

const CaseValue& entry_of(const std::string& key, const CaseValue& table, const std::string& name) {
  for (const auto& [entry, value] : table.entries)
    if (entry == name) return value;
  throw Error("{} has no entry {}", key, name);
}

// Two numbers in a list.
std::pair<double, double> read_two(const std::string& key, const CaseValue& value) {
  if (value.kind != CaseValue::Kind::list || value.entries.size() != 2)
    throw Error("{} = {} must be a list of two numbers", key, value.shown());
  return {read_number(key, value.entries[0].second), read_number(key, value.entries[1].second)};
}

ParameterSamples read_samples(const std::string& key, const CaseValue& value) {
  using enum ParameterSamples::Kind;
  const std::string allowed =
      "{ from = …, to = … } (evenly spaced), { uniform = [lowest, highest] } or { normal = [mean, deviation] } (random)";
  if (value.kind != CaseValue::Kind::table) throw Error("{} = {} must be {}", key, value.shown(), allowed);
  const std::vector<std::string> names = {"from", "to", "uniform", "normal"};
  for (const auto& [name, entry] : value.entries)
    if (std::find(names.begin(), names.end(), name) == names.end()) throw unknown_name("key in " + key, name, names);
  const bool is_range = value.entries.size() == 2 && value.entries[0].first != value.entries[1].first &&
                        std::all_of(value.entries.begin(), value.entries.end(),
                                    [](const auto& e) { return e.first == "from" || e.first == "to"; });
  if (is_range) {
    const double from = read_number(key + ".from", entry_of(key, value, "from"));
    const double to = read_number(key + ".to", entry_of(key, value, "to"));
    if (from == to)
      throw Error("{} = {{ from = {}, to = {} }} is one value and no range; write it in [problem]", key, from, to);
    return {range, from, to};
  }
  if (value.entries.size() != 1 || value.entries[0].first == "from" || value.entries[0].first == "to")
    throw Error("{} must be {}", key, allowed);
  const auto& [name, entry] = value.entries[0];
  const auto [a, b] = read_two(key + "." + name, entry);
  if (name == "uniform" && a > b) throw Error("{}.uniform = [{}, {}]: the first must be ≤ the second", key, a, b);
  if (name == "normal" && b < 0) throw Error("{}.normal = [{}, {}]: the deviation must be ≥ 0", key, a, b);
  return {name == "uniform" ? uniform : normal, a, b};
}

void require_bounds(const std::string& key, const Parameter& parameter, const ParameterSamples& samples) {
  if (samples.kind == ParameterSamples::Kind::normal) return;  // each sample is checked
  for (const double end : {samples.a, samples.b}) {
    const std::string complaint = out_of_bounds(parameter, end);
    if (!complaint.empty()) throw Error("{}: {}", key, complaint);
  }
}

std::vector<std::filesystem::path> read_files(const std::string& key, const CaseValue& value,
                                              const std::filesystem::path& folder) {
  const bool has_files = value.kind == CaseValue::Kind::table && value.entries.size() == 1 &&
                         value.entries[0].first == "files" && value.entries[0].second.kind == CaseValue::Kind::list &&
                         !value.entries[0].second.entries.empty();
  if (!has_files) throw Error("{} = {} must be {{ files = [\"a.txt\", \"b.txt\", …] }}", key, value.shown());
  std::vector<std::filesystem::path> files;
  for (const auto& [name, file] : value.entries[0].second.entries)
    files.push_back(read_initial_file_name(key + ".file", file, folder).file);
  return files;
}

}  // namespace

bool may_vary(const Parameter& p) {
  using enum ParameterKind;
  return (p.kind == real || p.kind == rate || p.kind == function) && !p.per_axis;
}

void read_ensemble_key(EnsembleSpec& ensemble, const std::string& name, const CaseValue& value,
                       const ProblemEntry& problem, const std::filesystem::path& folder) {
  const std::string key = "ensemble." + name;
  if (name == "members") {
    ensemble.members = read_whole(key, value, 1);
    if (ensemble.members > most_members) throw Error("{} = {} must be ≤ {}", key, value.shown(), most_members);
  } else if (name == "seed") {
    ensemble.seed = static_cast<std::uint64_t>(read_whole(key, value, 0));
  } else if (name == "initial") {
    ensemble.files = read_files(key, value, folder);
  } else if (name == "perturb_initial") {
    ensemble.perturb_initial = read_number(key, value);
    if (ensemble.perturb_initial < 0) throw Error("{} = {} must be ≥ 0", key, value.shown());
  } else {
    const auto parameter = std::find_if(problem.parameters.begin(), problem.parameters.end(),
                                        [&](const Parameter& p) { return p.name == name && may_vary(p); });
    if (parameter == problem.parameters.end()) return;  // refused as an unknown key
    const ParameterSamples samples = read_samples(key, value);
    require_bounds(key, *parameter, samples);
    ensemble.parameters.emplace_back(name, samples);
  }
}

std::string ensemble_complaint(const EnsembleSpec& ensemble, bool noisy) {
  const auto files = static_cast<std::int64_t>(ensemble.files.size());
  if (ensemble.count() == 0) return "[ensemble] has no members; write members = 64, or initial = { files = […] }";
  if (files > 0 && ensemble.members > 0 && ensemble.members != files)
    return fmt::format("ensemble.members = {} but ensemble.initial has {} files; leave members out, or make them agree",
                       ensemble.members, files);
  if (!noisy && ensemble.count() > 1 && files == 0 && ensemble.parameters.empty() && ensemble.perturb_initial == 0)
    return fmt::format(
        "[ensemble] has {} members and nothing in which they differ; write perturb_initial = 1e-3, a parameter of the problem as "
        "{{ from = 0.1, to = 0.2 }}, or initial = {{ files = […] }}",
        ensemble.count());
  return "";
}

std::string write_ensemble(const EnsembleSpec& ensemble) {
  using enum ParameterSamples::Kind;
  std::string text = fmt::format("\n[ensemble]\nmembers = {}\nseed = {}\n", ensemble.count(), ensemble.seed);
  if (!ensemble.files.empty()) {
    std::vector<std::string> names;
    for (const std::filesystem::path& file : ensemble.files) names.push_back(toml_string(file.string()));
    text += fmt::format("initial = {{ files = [{}] }}\n", fmt::join(names, ", "));
  }
  text += fmt::format("perturb_initial = {}\n", toml_real(ensemble.perturb_initial));
  for (const auto& [name, samples] : ensemble.parameters) {
    const std::string a = toml_real(samples.a);
    const std::string b = toml_real(samples.b);
    text += samples.kind == range
                ? fmt::format("{} = {{ from = {}, to = {} }}\n", name, a, b)
                : fmt::format("{} = {{ {} = [{}, {}] }}\n", name, samples.kind == uniform ? "uniform" : "normal", a, b);
  }
  return text;
}

}  // namespace seiche
