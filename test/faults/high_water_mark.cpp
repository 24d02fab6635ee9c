// To be loaded before a program (LD_PRELOAD): at its end the file named by SEICHE_HIGH_WATER_MARK is given the largest
// part of the program that was in memory at a time, as the system writes it: "VmHWM: 12345 kB".
#include <cstdlib>
#include <fstream>
#include <string>

namespace {

[[gnu::destructor]] void write_high_water_mark() {
  const char* name = std::getenv("SEICHE_HIGH_WATER_MARK");
  if (name == nullptr) return;
  std::ifstream status("/proc/self/status");
  for (std::string entry; std::getline(status, entry);)
    if (entry.starts_with("VmHWM:")) std::ofstream(name) << entry << '\n';
}

}  // namespace
