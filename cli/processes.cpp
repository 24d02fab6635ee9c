#include "processes.hpp"

#include <seiche/core/base/error.hpp>
#include <seiche/driver/processes.hpp>

#include <limits>
#include <memory>

namespace seiche::cli {
namespace {

std::unique_ptr<Processes> processes;

// How long a process that has failed waits for others, which fail at the same place.
constexpr double patience = 2;  // seconds

}  // namespace

const Ranks* join_others() {
  if (started_processes() < 2) return nullptr;
  processes = join_processes();
  return &processes->ranks();
}

void require_one_process(const std::string& command) {
  if (const Ranks* const ranks = join_others(); ranks != nullptr)
    throw Error("seiche {} runs on one process, and {} were started; those that share a work are run and resume",
                command, ranks->here().count);
}

bool is_first(const Ranks* ranks) { return ranks == nullptr || ranks->here().index == 0; }

int leave(ExitCode code, const std::function<void()>& say) {
  const bool failed = say != nullptr;
  const bool all = !processes || processes->come_to_end(failed ? patience : std::numeric_limits<double>::infinity());
  if (failed && (!all || is_first(processes ? &processes->ranks() : nullptr))) say();
  if (!all) processes->end_all(code);
  processes.reset();
  return code;
}

}  // namespace seiche::cli
