#pragma once

#include <string>

namespace seiche::test {

// Where this build finds what it tests. Only paths.cpp is compiled with these paths inside, so that a compiler cache
// serves the other tests to a clone in any folder.
std::string source_directory();
std::string test_data_directory();
std::string program_path();
std::string failing_writes_path();  // libraries to be loaded before it (test/faults)
std::string jumping_clock_path();
std::string high_water_mark_path();

}  // namespace seiche::test
