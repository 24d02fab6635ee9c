#include <seiche/backend/backends.hpp>
#include <seiche/config/library_versions.hpp>
#include <seiche/core/simd/multiversion.hpp>
#include <seiche/core/simd/vector_functions.hpp>
#include <seiche/output/hdf5/hdf5.hpp>
#include <seiche/study/versions.hpp>
#include <seiche/version.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace seiche {
namespace {

// As the system calls it; "unknown" where it does not.
std::string processor() {
  std::ifstream about("/proc/cpuinfo");
  for (std::string line; std::getline(about, line);) {
    const std::size_t value = line.find(": ");
    if (line.starts_with("model name") && value != std::string::npos) return line.substr(value + 2);
  }
  return "unknown";
}

}  // namespace

std::map<std::string, std::string> versions_in_use() {
  std::map<std::string, std::string> all = backend_library_versions();
  all.merge(config_library_versions());
  all["hdf5"] = hdf5_version();
  all["seiche"] = version_number;
  all["git"] = version_commit;
  all["compiler"] = version_compiler;
  all["compiler_flags"] = version_flags;
  all["processor"] = processor();
  all["build_type"] = version_build_type;
  all["instruction_set"] = instruction_set();  // of the hot loops; FFTW chooses its own
  all["sleef"] = fmt::format("{} ({})", sleef_version(), vector_functions().instructions);
  all["fmt"] = fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
  all["json"] =
      fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH);
  return all;
}

}  // namespace seiche
