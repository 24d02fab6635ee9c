// seiche spectrum: the damping and the frequency that a method gives each mode, against those of the equation.
#include "command_line.hpp"
#include "load_case.hpp"

#include <seiche/core/base/error.hpp>
#include <seiche/core/simd/thread_count.hpp>
#include <seiche/figure/spectrum_pictures.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/file/folder_lock.hpp>
#include <seiche/record/run_folder.hpp>
#include <seiche/study/spectrum.hpp>

#include <memory>
#include <optional>

namespace seiche::cli {
namespace {

struct SpectrumArguments {
  CaseArgument case_argument;
  std::string directory;
  bool directory_given = false;
  int threads = 1;
  bool json = false;
};

ExitCode spectrum_of_case(const SpectrumArguments& arguments) {
  const RunSpec spec = load_case(arguments.case_argument);
  refuse_noise(spec, "spectrum");
  if (arguments.directory_given && arguments.directory.empty()) throw Error("--out must not be empty");
  if (spec.h == 0)
    throw Error(
        "{} has a tolerance and no h, and spectrum looks at one step: give --set method.h=…, a number or a fraction such as "
        "1/64; the report of `seiche run` tells the sizes that the tolerance takes",
        spec.source);
  const Problem problem = make_problem(spec);
  SimulationOptions options = simulation_options(spec);
  options.backend_options.threads = arguments.threads;
  print_notes(case_notes(spec, problem));
  if (const std::string note = note_on_threads(arguments.threads); !note.empty()) print_note(note);
  const std::filesystem::path directory = arguments.directory;
  std::optional<FolderLock> lock;
  if (arguments.directory_given) {
    make_directory(directory);
    lock.emplace(Folder(directory));
    require_no_checkpoint(directory);
  }
  const Spectrum result = spectrum(problem, options, spec.h);
  print_data(arguments.json ? spectrum_json(result) : spectrum_table(result));
  if (!arguments.directory_given) return success;
  try {
    write_file(directory / "spectrum.csv", spectrum_csv(result));
    draw_spectrum(result, directory);
  } catch (const Error& error) {  // what was computed is said, and no mistake of the user's
    print_failure(error.what());
    return computation_failed;
  }
  return success;
}

}  // namespace

void add_spectrum(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<SpectrumArguments>();
  CLI::App* command =
      app.add_subcommand("spectrum", "Is the damping physical? Decay and frequency of each mode, numerical and exact");
  add_case(*command, arguments->case_argument);
  CLI::Option* out =
      command->add_option("--out", arguments->directory, "Where spectrum.csv and the figures go")->type_name("DIR");
  command->add_option("--threads", arguments->threads, "Threads, over a large grid; results do not depend on it")
      ->type_name("N")
      ->check(whole_number(1, most_threads));
  command->add_flag("--json", arguments->json, "Print one JSON document on stdout");
  command->callback([arguments, out, &action] {
    arguments->directory_given = out->count() > 0;
    action = [arguments] { return spectrum_of_case(*arguments); };
  });
}

}  // namespace seiche::cli
