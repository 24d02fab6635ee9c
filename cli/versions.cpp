#include "versions.hpp"

#include <fmt/format.h>
#include <CLI/Version.hpp>
#include <nlohmann/json.hpp>
#include <seiche/backend/backends.hpp>
#include <seiche/config/library_versions.hpp>
#include <seiche/version.hpp>

namespace seiche::cli {
namespace {

// Of the program as compiled. FFTW chooses its own at run time.
std::string instruction_set() {
#if defined(__AVX512F__)
  return "x86-64 AVX-512";
#elif defined(__AVX2__) && defined(__FMA__)
  return "x86-64 AVX2 FMA";
#elif defined(__AVX__)
  return "x86-64 AVX";
#elif defined(__SSE4_2__)
  return "x86-64 SSE4.2";
#elif defined(__SSE2__)
  return "x86-64 SSE2";
#elif defined(__ARM_FEATURE_SVE)
  return "AArch64 SVE";
#elif defined(__ARM_NEON)
  return "AArch64 NEON";
#else
  return "generic";
#endif
}

}  // namespace

std::map<std::string, std::string> versions() {
  std::map<std::string, std::string> all = backend_library_versions();
  all.merge(config_library_versions());
  all["seiche"] = version_number;
  all["git"] = version_commit;
  all["compiler"] = version_compiler;
  all["build_type"] = version_build_type;
  all["instruction_set"] = instruction_set();
  all["fmt"] = fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
  all["cli11"] = CLI11_VERSION;
  all["json"] =
      fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH);
  return all;
}

std::string version_text() {
  std::map<std::string, std::string> rest = versions();
  std::string text = fmt::format("seiche {} ({})\n", rest["seiche"], rest["git"]);
  rest.erase("seiche");
  rest.erase("git");
  for (const auto& [name, version] : rest) text += fmt::format("{:<16} {}\n", name, version);
  return text;
}

}  // namespace seiche::cli
