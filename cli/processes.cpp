#include "processes.hpp"

#include "stop_signal.hpp"

#include <seiche/core/base/error.hpp>
#include <seiche/core/base/memory_limit.hpp>
#include <seiche/driver/processes.hpp>

#include <limits>
#include <memory>

namespace seiche::cli {
namespace {

std::unique_ptr<Processes> joined;

// How long a process that has failed waits for others, which fail at the same place.
constexpr double patience = 2;  // seconds

void require_same(const Ranks& ranks, const std::vector<std::string>& arguments) {
  std::string text;
  for (const std::string& argument : arguments) text += argument + '\0';
  const bool differs = ranks.from_first(text) != text;
  if (ranks.any(differs ? "differs" : "").empty()) return;
  throw Error(
      "the processes were given different commands, and share one run; SEICHE_ALONE=1 lets each process run alone");
}

}  // namespace

void join_others(const std::vector<std::string>& arguments) {
  const int started = started_processes();
  if (started < 2) return;
  joined = join_processes();
  processes_on_machine() = joined->count_on_machine();
  if (const int found = processes()->here().count; found != started)
    throw Error(
        "{} processes were started, and MPI knows of {}: this mpiexec is not that of the MPI that Seiche was built with; "
        "SEICHE_ALONE=1 lets each process run alone",
        started, found);
  require_same(*processes(), arguments);
}

const Ranks* processes() { return joined ? &joined->ranks() : nullptr; }
bool is_first() { return !joined || joined->ranks().here().index == 0; }

int leave(ExitCode code, const std::function<void()>& say) {
  const bool failed = say != nullptr;
  if (joined) keep_signals_waiting();  // mpiexec sends one to those that are left, who have nothing to say any more
  const bool all = !joined || joined->come_to_end(failed ? patience : std::numeric_limits<double>::infinity());
  if (failed && (!all || is_first())) say();
  if (!all) joined->end_all(code);
  joined.reset();
  return code;
}

}  // namespace seiche::cli
