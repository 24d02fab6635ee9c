// The program: subcommands, and one place that turns what went wrong into a sentence and an exit code.
#include "command_line.hpp"
#include "processes.hpp"
#include "stop_signal.hpp"
#include "versions.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <seiche/config/case/case_keys.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iterator>
#include <new>
#include <system_error>

namespace seiche::cli {
namespace {

std::vector<std::string> subcommand_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

// CLI11 only says that something was unexpected; the nearest name, and what may have been meant, is ours to find.
Error unexpected(const CLI::App& app, const std::vector<std::string>& arguments) {
  const std::vector<CLI::App*> called = app.get_subcommands();
  const CLI::App& command = called.empty() ? app : *called.front();
  const std::string extra = app.remaining(true).front();
  if (extra.starts_with("-")) {
    const std::string name = extra.substr(0, extra.find('='));
    const std::string key = full_key(name.substr(std::min(name.find_first_not_of('-'), name.size())));
    if (!key.empty() && command.get_option_no_throw("--set") != nullptr)
      return Error("unknown option '{}'; a key of the case is set by --set {}=…", shortened(name), key);
    return unknown_name("option", name, option_names(command));
  }
  const auto at = std::find(arguments.begin(), arguments.end(), extra);
  const auto option = std::find_if(std::make_reverse_iterator(at), arguments.rend(),
                                   [](const std::string& argument) { return argument.starts_with("--"); });
  if (option != arguments.rend() && *option == "--set")
    return Error("unexpected argument '{}'; key and value are one argument without blanks: --set method.h=1/64",
                 shortened(extra));
  if (option != arguments.rend() && (*option == "--methods" || *option == "--h"))
    return Error("unexpected argument '{}'; the values of {} are joined by commas", shortened(extra), *option);
  return Error("unexpected argument '{}'", shortened(extra));
}

// seiche help run is seiche run --help.
std::vector<std::string> without_help_command(std::vector<std::string> arguments) {
  if (arguments.empty() || arguments[0] != "help") return arguments;
  arguments.erase(arguments.begin());
  arguments.emplace_back("--help");
  return arguments;
}

// Is the name itself at fault that the user gave, and not the disk?
bool leads_nowhere(const std::error_code& code) {
  for (const std::errc name : {std::errc::too_many_symbolic_link_levels, std::errc::filename_too_long,
                               std::errc::not_a_directory, std::errc::no_such_file_or_directory})
    if (code == name) return true;
  return false;
}

ExitCode run_program(const std::vector<std::string>& given) {
  const std::vector<std::string> arguments = without_help_command(given);
  CLI::App app("Seiche: energy-stable integrators for damped Hamiltonian systems", "seiche");
  app.set_version_flag("-V,--version", version_text, "Versions of Seiche and its libraries, and the instruction set");
  app.require_subcommand(1);
  app.get_formatter()->column_width(36);
  Action action;
  add_run(app, action);
  add_resume(app, action);
  add_converge(app, action);
  add_paper(app, action);
  add_check(app, action);
  add_spectrum(app, action);
  add_audit(app, action);
  add_recover(app, action);
  add_plot(app, action);
  add_fit(app, action);
  add_list(app, action);
  add_cite(app, action);
  add_new(app, action);
  add_schema(app, action);

  if (arguments.empty()) {
    print_lines(app.help());
    throw Error("a command is missing, as in seiche run case.toml");
  }
  // Before parsing, since CLI11 would complain about what is missing instead of what is misspelt.
  const std::vector<std::string> names = subcommand_names(app);
  if (!arguments[0].starts_with("-") && std::find(names.begin(), names.end(), arguments[0]) == names.end()) {
    throw unknown_name("command", arguments[0], names);
  }
  if (arguments[0] == "run" || arguments[0] == "resume") join_others(arguments);
  std::vector<std::string> reversed = with_set_repeated(arguments);
  std::reverse(reversed.begin(), reversed.end());  // the order in which CLI11 wants them
  try {
    app.parse(reversed);
  } catch (const CLI::Success& asked) {  // --help, --version
    app.exit(asked);
    return success;
  } catch (const CLI::ExtrasError&) {
    throw unexpected(app, arguments);
  } catch (const CLI::ParseError& error) {
    const bool is_of_command = std::find(names.begin(), names.end(), arguments[0]) != names.end();
    throw Error("{} (seiche {}--help lists what there is)", shortened(error.what(), 300),
                is_of_command ? arguments[0] + " " : "");
  }
  const bool answers = app.got_subcommand("run") || app.got_subcommand("resume");  // as soon as they know how
  if (!answers) let_signals_through();
  return action();
}

}  // namespace
}  // namespace seiche::cli

int main(int count, char** values) {
  using namespace seiche::cli;
  keep_signals_waiting();
  prepare_process();
  try {
    return leave(run_program({values + std::min(count, 1), values + count}));
  } catch (const seiche::Error& error) {
    return leave(wrong_usage, [&] { print_failure(error.what()); });
  } catch (const std::bad_alloc&) {
    return leave(computation_failed, print_out_of_memory);
  } catch (const std::filesystem::filesystem_error& error) {
    return leave(leads_nowhere(error.code()) ? wrong_usage : computation_failed, [&] {
      print_failure(fmt::format("{}: {}", seiche::shortened_path(error.path1().string()), error.code().message()));
    });
  } catch (const nlohmann::json::exception&) {
    return leave(wrong_usage,
                 [] { print_note("a file in JSON, such as summary.json, does not hold what Seiche writes to it"); });
  } catch (const std::exception& error) {
    return leave(computation_failed, [&] { print_failure(error.what()); });
  }
}
