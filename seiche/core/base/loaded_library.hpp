// Libraries that a program loads when it is asked for what they hold, since few need it.
#pragma once

#include <string>
#include <vector>

namespace seiche {

// A function of a library of Seiche's, "libseiche_mpi.so": null where the library is not there. It is looked for beside
// the program, or the library or module that this is a part of, where it is installed from there, and in `folders` from
// there. `version`: the function that names the sources it was built of. Throws Error where these are others, or it
// cannot be loaded.
void* function_of_library(const std::string& library, const char* version, const char* function,
                          const std::vector<std::string>& folders = {});

}  // namespace seiche
