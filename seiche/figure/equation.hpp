// What a run solves, as typeset formulas.
#pragma once

#include <seiche/config/case/run_spec.hpp>

#include <string>

namespace seiche {

// The equation of a problem of the list; of one written down z, H (or M and V), S and D as the user wrote them, each on
// a line. Friction and forces of the case below. HTML with MathML; formulas of some thousand characters are left to the
// case file.
std::string equation_html(const RunSpec& spec);

// Name, value as written and meaning of every parameter, as rows of a table.
std::string parameter_rows(const RunSpec& spec);

}  // namespace seiche
