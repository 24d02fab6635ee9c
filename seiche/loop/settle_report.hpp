// What a report takes back at the end of its run.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/run_report.hpp>
#include <seiche/core/system.hpp>

#include <string>

namespace seiche {

// Takes back a drift that round-off of the final physical values explains, and what was said of the law where there is
// an objection to it, "" for none. Both are asked for only where there is something to take back.
void settle_report(RunReport& report, const System& system, FunctionRef<Vector()> values,
                   FunctionRef<std::string()> objection);

}  // namespace seiche
