// What all subcommands share: exit codes, the way a subcommand enters the program, stdout and stderr.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace seiche::cli {

enum ExitCode : int { success = 0, computation_failed = 1, wrong_usage = 2, law_violated = 3, interrupted = 130 };

// Set by the subcommand that was called; main runs it after parsing. An Error thrown by it means wrong usage.
using Action = std::function<ExitCode()>;

void add_run(CLI::App& app, Action& action);
void add_converge(CLI::App& app, Action& action);
void add_paper(CLI::App& app, Action& action);
void add_check(CLI::App& app, Action& action);
void add_spectrum(CLI::App& app, Action& action);
void add_audit(CLI::App& app, Action& action);
void add_resume(CLI::App& app, Action& action);
void add_recover(CLI::App& app, Action& action);
void add_plot(CLI::App& app, Action& action);
void add_list(CLI::App& app, Action& action);
void add_new(CLI::App& app, Action& action);
void add_fit(CLI::App& app, Action& action);
void add_cite(CLI::App& app, Action& action);
void add_schema(CLI::App& app, Action& action);

void print_data(std::string_view text);     // to stdout; throws std::runtime_error where it cannot be written
void print_note(std::string_view text);     // one line to stderr, after "seiche: "
void print_failure(std::string_view text);  // why nothing, or not all, was done: the same, in at most 400 bytes
void print_notes(const std::vector<std::string>& notes);  // each on a line of its own
void print_lines(std::string_view text);                  // to stderr as it is; never throws

// A check of an option.
CLI::Validator whole_number(int least, int most);

// To stderr, without memory.
void print_out_of_memory() noexcept;

// Before anything is opened: no file of a run takes the number of a closed standard stream, and limits of the size of
// files are errors.
void prepare_process();

// Every argument after --set that looks like key=value gets a --set of its own, so that one --set may take several
// and never swallows the case file.
std::vector<std::string> with_set_repeated(const std::vector<std::string>& arguments);

}  // namespace seiche::cli
