#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/problem/problems.hpp>
#include <seiche/study/run_files.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <iterator>

namespace seiche {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream input(file);
  if (!input) throw Error("{} cannot be read", file.string());
  return {std::istreambuf_iterator<char>(input), {}};
}

double number(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : std::nan("");
}

std::int64_t whole(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number_integer() ? found->get<std::int64_t>() : 0;
}

std::string text(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

Json member(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_structured() ? *found : Json::object();
}

EnergyNumbers numbers(const Json& energy) {
  return {number(energy, "initial"), number(energy, "final"), number(energy, "max_increase")};
}

void read_certificate(const Json& certificate, RunFiles& run) {
  for (const Json& item : member(certificate, "hypotheses"))
    run.hypotheses.push_back(
        {text(item, "hypothesis"), text(item, "grade"), text(item, "statement"), text(item, "witness")});
  const Json law = member(certificate, "law");
  run.promised = law.contains("promised") && law["promised"] == true;
  run.law_reason = text(law, "reason");
  run.theorem = text(law, "theorem");
}

}  // namespace

RunFiles run_of_case(const std::filesystem::path& directory, const RunSpec& spec, const std::string& case_text) {
  RunFiles run;
  run.directory = directory;
  run.solution = directory / "solution.h5";
  run.spec = spec;
  run.case_text = case_text;
  const ProblemEntry& problem = problem_entry(spec);
  run.title = problem.title;
  run.equation = problem.equation;
  run.reference = problem.reference;
  run.method_reference = find_method(spec.method).reference;
  return run;
}

RunFiles read_run(const std::filesystem::path& directory) {
  if (look_at(directory).kind != InputKind::folder) throw Error("{} is no directory of a run", directory.string());
  for (const char* name : {"case.toml", "summary.json", "energy.csv"})
    if (look_at(directory / name).kind != InputKind::file)
      throw Error("{} is no directory of a finished run: it has no {}", directory.string(), name);
  const Json summary = Json::parse(text_of(directory / "summary.json"), nullptr, false);
  if (!summary.is_object() || !summary.contains("energy") || !summary.contains("status"))
    throw Error("{} is no summary of a run", (directory / "summary.json").string());
  RunFiles run = run_of_case(directory, read_case(directory / "case.toml"), text_of(directory / "case.toml"));
  if (run.spec.ensemble)
    throw Error("{} holds an ensemble, which leaves statistics and no solution", directory.string());
  run.status = text(summary, "status");
  run.message = text(summary, "message");
  run.problem = text(summary, "problem");
  run.method = text(summary, "method");
  run.backend = text(summary, "backend");
  run.steps = whole(summary, "steps");
  run.t = number(summary, "t");
  const Json energy = member(summary, "energy");
  run.energy = numbers(energy);
  if (energy.contains("modified") && energy["modified"].is_object()) run.modified = numbers(energy["modified"]);
  run.law = text(energy, "law");
  const Json counts = member(summary, "counts");
  for (const auto& [name, count] : counts.items())
    if (count.is_number_integer()) run.counts.emplace_back(name, count.get<std::int64_t>());
  run.wall_seconds = number(summary, "wall_seconds");
  run.finished = text(summary, "finished");
  const Json versions = member(summary, "versions");
  for (const auto& [name, version] : versions.items())
    if (version.is_string()) run.versions[name] = version;
  read_certificate(member(summary, "certificate"), run);
  return run;
}

std::string run_name(const RunFiles& run) { return run_name(run.title, run.problem, run.directory); }

std::string run_name(const std::string& title, const std::string& problem, const std::filesystem::path& directory) {
  if (!title.empty()) return title;
  const std::filesystem::path folder = std::filesystem::absolute(directory / "").lexically_normal().parent_path();
  return folder.filename().empty() ? problem : folder.filename().string();
}

std::string early_end(const RunFiles& run) {
  if (!run.has_ended) return run.status;
  return run.status == "success" ? "" : fmt::format("{} at t = {:.6g}", run.status, run.t);
}

std::string shortfall(const RunFiles& run) {
  std::string text = early_end(run);
  if (run.law == "violated") text += text.empty() ? "the energy law is violated" : ", the energy law is violated";
  return text;
}

}  // namespace seiche
