// A case on several processes, as those see it that are not the first: they compute with it, and write no file.
#pragma once

#include <seiche/driver/run_case.hpp>

namespace seiche {

// Of the case that the first process runs or resumes, and tells to the others. Throws what is thrown there before the
// first step.
CaseResult follow_case(const RunCaseOptions& options);

}  // namespace seiche
