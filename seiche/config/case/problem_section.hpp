// [problem] of a case file.
#pragma once

#include <seiche/config/case/case_reading.hpp>

namespace seiche {

// Both fill reading.spec. The name comes first, since all other keys depend on it; it sets reading.problem, which the
// rest of the section needs.
void read_problem_name(CaseReading& reading);
void read_problem_section(CaseReading& reading);

}  // namespace seiche
