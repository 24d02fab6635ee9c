#include <paper/examples.hpp>
#include <paper/law_checks.hpp>
#include <paper/paper.hpp>
#include <paper/side_studies.hpp>
#include <paper/verdicts.hpp>
#include <seiche/core/error.hpp>

#include <chrono>

namespace seiche {

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
  example_options.timing.repeats = 5;
  if (options.quick) {
    example_options.timing = {.repeats = 3, .seconds = 0.004, .warm_up_seconds = 0.001};
    example_options.seavf_end = 0.125;
  }
  example_options.timing.stop = options.stop;

  try {
    const std::vector<PaperExample> examples = paper_examples(options.quick);
    for (std::size_t i = 0; i < examples.size() && !stopped(); ++i) {
      tell(0.85 * static_cast<double>(i) / static_cast<double>(examples.size()), examples[i].title);
      ExampleStudy study = study_example(examples[i], example_options);
      if (stopped()) break;  // its runs were cut short
      results.examples.push_back(std::move(study.result));
      evidence.examples.push_back(std::move(study.evidence));
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

}  // namespace seiche
