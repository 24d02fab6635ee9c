// Which Seiche computes, and on what: its number and commit, what compiled it with which flags, its libraries, the
// processor, and the instruction set in use.
#pragma once

#include <map>
#include <string>

namespace seiche {

std::map<std::string, std::string> versions_in_use();  // for summary.json

}  // namespace seiche
