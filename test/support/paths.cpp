#include <test/support/paths.hpp>

namespace seiche::test {

std::string source_directory() { return SEICHE_SOURCE_DIR; }
std::string test_data_directory() { return SEICHE_TEST_DATA; }
std::string program_path() { return SEICHE_PROGRAM; }
std::string failing_writes_path() { return SEICHE_FAILING_WRITES; }
std::string jumping_clock_path() { return SEICHE_JUMPING_CLOCK; }
std::string high_water_mark_path() { return SEICHE_HIGH_WATER_MARK; }

}  // namespace seiche::test
