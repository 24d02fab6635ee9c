// Which Seiche this is: its version, its libraries, and the instruction set in use.
#pragma once

#include <map>
#include <string>

namespace seiche::cli {

std::map<std::string, std::string> versions();  // for summary.json
std::string version_text();                     // for --version

}  // namespace seiche::cli
