// seiche fit: parameters of a case from measurements. The search is seiche.fit of the Python package, which takes the
// place of this process.
#include "command_line.hpp"
#include "load_case.hpp"

#include <fmt/ranges.h>
#include <unistd.h>
#include <seiche/core/base/error.hpp>
#include <seiche/figure/drawing.hpp>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <system_error>

namespace seiche::cli {
namespace {

struct FitArguments {
  CaseArgument problem;
  std::string data, observe, sigma, h, method, plot;
  std::vector<std::string> parameters;
  bool json = false, quiet = false;
};

// Its first argument names the interpreters that may have the packages where this one lacks them, joined by colons.
constexpr const char* begin_python = R"(
import sys
sys.path[:] = [folder for folder in sys.path if folder]  # not what lies in the folder of the data
import os
others = sys.argv.pop(1)
try:
    import numpy, scipy
    from seiche.__main__ import main
except ImportError as error:
    other, _, rest = others.partition(":")
    if os.path.exists(other):
        os.execv(other, [other, "-c", sys.orig_argv[2], rest, *sys.argv[1:]])
    sys.exit(f"seiche: fit needs NumPy, SciPy and the Python package seiche ({error}): pip install ., or make python")
sys.exit(main(sys.argv[1:]))
)";

std::vector<std::string> python_command(const FitArguments& a) {
  const std::vector<std::string> interpreters = python_interpreters();
  const std::string others = fmt::format("{}", fmt::join(interpreters.begin() + 1, interpreters.end(), ":"));
  std::vector<std::string> words = {interpreters.front(), "-c", begin_python, others, "fit"};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  for (const std::string& parameter : a.parameters) add("--parameter", parameter);
  for (const std::string& text : a.problem.overrides) add("--set", text);
  add("--observe", a.observe);
  add("--sigma", a.sigma);
  add("--h", a.h);
  add("--method", a.method);
  add("--plot", a.plot);
  if (a.json) words.emplace_back("--json");
  if (a.quiet) words.emplace_back("--quiet");
  words.insert(words.end(), {"--", a.problem.file, a.data});
  return words;
}

// The package beside the program as it is built comes before one that is installed.
void prefer_own_package() {
  namespace fs = std::filesystem;
  std::error_code unknown;
  const fs::path own = fs::read_symlink("/proc/self/exe", unknown).parent_path() / "python";
  if (!fs::exists(own / "seiche/__init__.py", unknown)) return;
  const char* given = std::getenv("PYTHONPATH");  // NOLINT(concurrency-mt-unsafe)
  const std::string path = own.string() + (given != nullptr && *given != '\0' ? fmt::format(":{}", given) : "");
  ::setenv("PYTHONPATH", path.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
}

ExitCode fit(const FitArguments& arguments) {
  if (arguments.problem.file == "-")
    throw Error("seiche fit reads the case from a file: it is run again and again, and standard input is read once");
  if (arguments.parameters.empty())
    throw Error("--parameter is missing: say what is looked for, as in --parameter gamma=0.1:0:1");
  load_case(arguments.problem);  // refuses what cannot be read in the words of the other commands
  prefer_own_package();
  std::vector<std::string> words = python_command(arguments);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execvp(pointers.front(), pointers.data());
  print_failure(errno == ENOENT
                    ? fmt::format("{} was not found; with NumPy and SciPy it fits parameters", words.front())
                    : fmt::format("{} cannot be run: {}", words.front(), std::generic_category().message(errno)));
  return computation_failed;
}

}  // namespace

void add_fit(CLI::App& app, Action& action) {
  auto a = std::make_shared<FitArguments>();
  CLI::App* command = app.add_subcommand("fit", "Find damping and other parameters of a case from measurements");
  add_case(*command, a->problem);
  command->add_option("DATA", a->data, "Columns of the time, the measurement and, if known, its standard deviation")
      ->required()
      ->type_name("");
  command
      ->add_option("--parameter", a->parameters,
                   "What is looked for, a key of [problem], from the value in the case, or from a guess within bounds: "
                   "gamma, gamma=0.1:0:1, initial.q=2; once for each")
      ->type_name("NAME[=GUESS[:LEAST:MOST]]")
      ->expected(1)
      ->take_all();
  command
      ->add_option("--observe", a->observe,
                   "What was measured: a field, or one of its points from 0, as u[5] (the first field)")
      ->type_name("FIELD");
  command->add_option("--sigma", a->sigma, "Standard deviation of all measurements (estimated)")->type_name("S");
  command->add_option("--h", a->h, "Step size (one whose errors are below a tenth of that)")->type_name("H");
  command->add_option("--method", a->method, "Method of the runs (that of the case, else egc4)")->type_name("NAME");
  command->add_option("--plot", a->plot, "Draw the measurements and the solution: PNG, PDF or SVG")->type_name("FILE");
  command->add_flag("--json", a->json, "Print one JSON document on stdout");
  command->add_flag("--quiet", a->quiet, "No progress, and a word only when something went wrong");
  command->callback([a, &action] { action = [a] { return fit(*a); }; });
}

}  // namespace seiche::cli
