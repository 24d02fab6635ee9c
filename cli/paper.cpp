// seiche paper: every example, method, figure and claim of the paper.
#include "command_line.hpp"
#include "reference_name.hpp"
#include "stop_signal.hpp"
#include "versions.hpp"

#include <fmt/format.h>
#include <paper/paper.hpp>
#include <paper/pictures.hpp>
#include <paper/report.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/simd/thread_count.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/file/folder_lock.hpp>
#include <seiche/output/progress_bar.hpp>
#include <seiche/record/run_folder.hpp>

#include <memory>

namespace seiche::cli {
namespace {

struct PaperArguments {
  std::string directory;
  bool directory_given = false;
  std::string reference = "odeint";
  int threads = 2;
  bool quick = false;
  bool json = false;
  bool quiet = false;
};

std::string verdicts_text(const PaperResults& results) {
  std::string text;
  for (const Verdict& verdict : results.verdicts) {
    text += fmt::format("{:<14} {}: {}\n{:14} {}\n", to_string(verdict.outcome), verdict.example, verdict.claim, "",
                        verdict.measured);
  }
  return text;
}

// A bar where there is a terminal, else one line per piece of work.
class StudyProgress {
 public:
  explicit StudyProgress(bool quiet) : bar_(stderr), quiet_(quiet), draws_(ProgressBar::is_wanted(quiet)) {}

  void operator()(double done, std::string_view what) {
    if (draws_) {
      bar_.draw(done, fmt::format("{}, {} left", what, bar_.time_left(done)));
    } else if (!quiet_) {
      print_note(fmt::format("{:>3.0f} % {}", 100 * done, what));
    }
  }
  void wipe() { bar_.wipe(); }

 private:
  ProgressBar bar_;
  bool quiet_, draws_;
};

// A quick run must not take the place of a full one.
std::string default_directory(bool quick) { return quick ? "out/paper-quick" : "out/paper"; }

// A study takes long enough for another folder to have come to its path.
void require_same(const Folder& folder) {
  folder.require_lock();
  if (!folder.is_at_its_path())
    throw Error("{} leads to another folder than it did when the study began, and nothing is written into it",
                folder.path().string());
}

ExitCode paper(const PaperArguments& arguments) {
  const std::string directory = arguments.directory_given ? arguments.directory : default_directory(arguments.quick);
  if (directory.empty()) throw Error("--out must not be empty");
  PaperOptions options;
  options.quick = arguments.quick;
  options.reference = find_reference(arguments.reference);
  make_directory(directory);
  const Folder folder(directory);
  const FolderLock lock(folder);
  require_own_report(directory);
  require_no_checkpoint(directory);
  StudyProgress progress(arguments.quiet);
  options.threads = arguments.threads;
  options.progress = [&](double done, std::string_view what) { progress(done, what); };
  const std::atomic<bool>& stop = stop_on_signal();  // until here, a signal simply ends the program
  options.stop = &stop;
  try {
    const PaperResults results = run_paper(options);
    progress.wipe();
    require_same(folder);
    write_results(results, directory);
    std::vector<CurvePicture> pictures = paper_pictures(results);
    std::string no_figures_because = stop ? "the study was interrupted" : "";
    try {
      if (!stop) pictures = draw_paper(results, directory);
    } catch (const Error& error) {  // the numbers and the report are worth having without
      no_figures_because = error.what();
    }
    write_report(results, pictures, directory, versions(), no_figures_because);
    print_data(arguments.json ? paper_json(results) : verdicts_text(results));
    if (!no_figures_because.empty()) print_note(fmt::format("there are no figures: {}", no_figures_because));
    if (!arguments.quiet) print_note(fmt::format("{:.1f} s; see {}/report.html", results.seconds, directory));
    if (stop) return interrupted;
    return no_figures_because.empty() ? success : computation_failed;
  } catch (const Error& error) {
    progress.wipe();
    print_failure(error.what());
    return stop ? interrupted : computation_failed;
  }
}

}  // namespace

void add_paper(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<PaperArguments>();
  CLI::App* command = app.add_subcommand("paper", "The paper: every example, method, figure and claim");
  CLI::Option* out =
      command
          ->add_option("--out", arguments->directory,
                       "Where data, figures and report.html go; default out/paper, with --quick out/paper-quick")
          ->type_name("DIR");
  command->add_option("--reference", arguments->reference, reference_help);
  command->add_option("--threads", arguments->threads, "Threads of the error runs; timed runs are alone")
      ->type_name("N")
      ->check(whole_number(1, most_threads));
  command->add_flag("--quick", arguments->quick, "Shorter runs, the same figures and claims");
  command->add_flag("--json", arguments->json, "One JSON document on stdout");
  command->add_flag("--quiet", arguments->quiet, "No progress");
  command->callback([arguments, out, &action] {
    arguments->directory_given = out->count() > 0;
    action = [arguments] { return paper(*arguments); };
  });
}

}  // namespace seiche::cli
