// Name and version of each library that only config/ names.
#pragma once

#include <map>
#include <string>

namespace seiche {

std::map<std::string, std::string> config_library_versions();

}  // namespace seiche
