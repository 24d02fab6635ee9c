#include "versions.hpp"

#include <fmt/format.h>
#include <CLI/Version.hpp>
#include <seiche/study/versions.hpp>

namespace seiche::cli {

std::map<std::string, std::string> versions() {
  std::map<std::string, std::string> all = versions_in_use();
  all["cli11"] = CLI11_VERSION;
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
