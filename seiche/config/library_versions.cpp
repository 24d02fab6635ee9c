#include <seiche/config/library_versions.hpp>

#include <fmt/format.h>
#include <ginac/version.h>
#include <toml++/toml.h>

namespace seiche {

std::map<std::string, std::string> config_library_versions() {
  return {{"ginac", fmt::format("{}.{}.{}", GINACLIB_MAJOR_VERSION, GINACLIB_MINOR_VERSION, GINACLIB_MICRO_VERSION)},
          {"toml++", fmt::format("{}.{}.{}", TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)}};
}

}  // namespace seiche
