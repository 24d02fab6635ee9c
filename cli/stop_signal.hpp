// Ctrl-C ends a run after its current step, with whole files; a second Ctrl-C ends the program at once.
#pragma once

#include <atomic>

namespace seiche::cli {

// Installs the handler of SIGINT and SIGTERM. The flag lives as long as the program.
const std::atomic<bool>& stop_on_signal();

}  // namespace seiche::cli
