#include <paper/examples.hpp>
#include <paper/law_checks.hpp>
#include <paper/paper.hpp>
#include <paper/side_studies.hpp>
#include <paper/verdicts.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/output/csv_text.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/study/converge.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <iterator>
#include <thread>
#include <utility>

namespace seiche {
namespace {

using Json = nlohmann::ordered_json;

std::string errors_as_csv(const ExampleResult& example) {
  std::string text =
      "method,h,error,energy_error,max_energy_increase,max_modified_increase,order,steps,scalar_iterations,"
      "fallbacks,unresolved,cpu_seconds,energy_law_held,failure\n";
  for (const StudyRow& row : example.rows) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},{:.6g},{},{}\n", csv_field(row.method),
                   row.h, row.error, row.energy_error, row.max_energy_increase, row.max_modified_increase,
                   row.order ? fmt::format("{:.6g}", *row.order) : "", row.steps, row.scalar_iterations, row.fallbacks,
                   row.unresolved, row.cpu_seconds, row.energy_law_held, csv_field(row.failure));
  }
  return text;
}

// Long form, since curves need not share their abscissae.
std::string curve_table(const std::vector<Curve>& curves, const char* x, const char* y) {
  std::string text = fmt::format("curve,{},{}\n", x, y);
  for (const Curve& curve : curves) {
    for (std::size_t i = 0; i < curve.t.size(); ++i) {
      fmt::format_to(std::back_inserter(text), "{},{},{}\n", csv_field(curve.name), curve.t[i], curve.value[i]);
    }
  }
  return text;
}

std::string verdict_table(const PaperResults& results) {
  std::string text = "example,claim,source,outcome,measured,remark,quick\n";
  for (const Verdict& v : results.verdicts) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{}\n", csv_field(v.example), csv_field(v.claim),
                   csv_field(v.source), to_string(v.outcome), csv_field(v.measured), csv_field(v.remark),
                   results.quick);
  }
  return text;
}

Json json_of(const StudyRow& row) {
  Json json = {{"method", row.method},
               {"h", row.h},
               {"error", row.error},
               {"energy_error", row.energy_error},
               {"max_energy_increase", row.max_energy_increase},
               {"max_modified_increase", row.max_modified_increase},
               {"order", row.order ? Json(*row.order) : Json(nullptr)},
               {"steps", row.steps},
               {"scalar_iterations", row.scalar_iterations},
               {"fallbacks", row.fallbacks},
               {"unresolved", row.unresolved},
               {"cpu_seconds", row.cpu_seconds},
               {"energy_law_held", row.energy_law_held}};
  if (!row.failure.empty()) json["failure"] = row.failure;
  return json;
}

Json json_of(const ExampleResult& example) {
  Json rows = Json::array();
  for (const StudyRow& row : example.rows) rows.push_back(json_of(row));
  return {{"key", example.key},     {"title", example.title},         {"parameters", example.parameters},
          {"t_end", example.t_end}, {"reference", example.reference}, {"reference_error", example.reference_error},
          {"rows", std::move(rows)}};
}

Json json_of(const SideStudy& study) {
  Json curves = Json::array();
  for (const Curve& curve : study.curves) {
    curves.push_back({{"name", curve.name}, {"x", curve.t}, {"y", curve.value}});
  }
  return {{"key", study.key},         {"title", study.title},     {"explanation", study.explanation},
          {"x_label", study.x_label}, {"y_label", study.y_label}, {"curves", std::move(curves)}};
}

Json json_of(const Verdict& verdict) {
  return {{"example", verdict.example},   {"claim", verdict.claim},
          {"source", verdict.source},     {"outcome", to_string(verdict.outcome)},
          {"measured", verdict.measured}, {"remark", verdict.remark}};
}

// The errors of all examples, several at once, each on one thread.
std::vector<ExampleStudy> all_errors(const std::vector<PaperExample>& examples, ExampleOptions options,
                                     const std::function<void(std::size_t)>& tell) {
  std::vector<ExampleStudy> studies(examples.size());
  const std::thread::id teller = std::this_thread::get_id();
  in_threads(examples.size(), std::exchange(options.threads, 1), [&](std::size_t i) {
    if (options.stop && options.stop->load()) return;
    if (std::this_thread::get_id() == teller) tell(i);
    studies[i] = study_errors(examples[i], options);
  });
  return studies;
}

}  // namespace

PaperResults run_paper(const PaperOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const auto stopped = [&] { return options.stop && options.stop->load(); };
  const auto tell = [&](double done, std::string_view what) {
    if (options.progress) options.progress(done, what);
  };
  PaperResults results;
  results.quick = options.quick;
  Evidence evidence;

  ExampleOptions example_options{.reference = {.kind = options.reference, .stop = options.stop},
                                 .threads = options.threads,
                                 .stop = options.stop};
  example_options.timing = {.repeats = 3, .seconds = 0.03, .warm_up_seconds = 0.005};
  if (options.quick) {
    example_options.timing = {.repeats = 3, .seconds = 0.004, .warm_up_seconds = 0.001};
    example_options.seavf_end = 0.125;
  }
  example_options.timing.stop = options.stop;

  try {
    const std::vector<PaperExample> examples = paper_examples(options.quick);
    const auto share = [&](std::size_t i) { return static_cast<double>(i) / static_cast<double>(examples.size()); };
    std::vector<ExampleStudy> studies =
        all_errors(examples, example_options, [&](std::size_t i) { tell(0.4 * share(i), examples[i].title); });
    for (std::size_t i = 0; i < examples.size() && !stopped(); ++i) {
      tell(0.4 + 0.45 * share(i), examples[i].title + ": times");
      add_times(studies[i], examples[i], example_options.timing);
      if (stopped()) break;  // its runs were cut short
      results.examples.push_back(std::move(studies[i].result));
      evidence.examples.push_back(std::move(studies[i].evidence));
    }
    if (!stopped()) {
      tell(0.85, "side studies");
      results.side_studies = side_studies({.quick = options.quick,
                                           .reference = {.stop = options.stop},
                                           .threads = options.threads,
                                           .stop = options.stop});
    }
    if (!stopped()) {
      tell(0.95, "energy laws and verdicts");
      check_laws(evidence, examples, options.quick);
      results.verdicts = judge(results, evidence);
    }
  } catch (const Error&) {
    if (!stopped()) throw;  // else a reference was given up
  }
  tell(1.0, stopped() ? "stopped" : "done");
  results.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return results;
}

void write_results(const PaperResults& results, const std::filesystem::path& directory) {
  const std::filesystem::path data = directory / "data";
  make_directory(data);
  for (const ExampleResult& example : results.examples) {
    write_file(data / (example.key + "_errors.csv"), errors_as_csv(example));
    write_file(data / (example.key + "_energy.csv"), curve_table(example.energy, "t", "H"));
    write_file(data / (example.key + "_energy_errors.csv"), curve_table(example.energy_errors, "t", "energy_error"));
  }
  for (const SideStudy& study : results.side_studies) {
    write_file(data / (study.key + ".csv"), curve_table(study.curves, "x", "y"));
  }
  write_file(directory / "verdicts.csv", verdict_table(results));
}

std::string paper_json(const PaperResults& results) {
  Json examples = Json::array(), side_studies = Json::array(), verdicts = Json::array();
  for (const ExampleResult& example : results.examples) examples.push_back(json_of(example));
  for (const SideStudy& study : results.side_studies) side_studies.push_back(json_of(study));
  for (const Verdict& verdict : results.verdicts) verdicts.push_back(json_of(verdict));
  const Json document = {{"quick", results.quick},
                         {"seconds", results.seconds},
                         {"examples", std::move(examples)},
                         {"side_studies", std::move(side_studies)},
                         {"verdicts", std::move(verdicts)}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace seiche
