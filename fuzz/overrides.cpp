// A case file with what --set puts over it is read or refused with a sentence, as `seiche run` reads it; and what is
// read is written so that it reads the same without --set. Lines of the input that begin with "--set " are overrides.
#include "bars.hpp"

#include <seiche/config/case/case_file.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace {

void read(std::string_view input) {
  constexpr std::string_view set = "--set ";
  std::string text;
  std::vector<std::string> overrides;
  while (!input.empty()) {
    const std::string_view line = input.substr(0, input.find('\n'));
    input.remove_prefix(std::min(line.size() + 1, input.size()));
    if (line.starts_with(set)) {
      overrides.emplace_back(line.substr(set.size()));
    } else {
      text.append(line).append("\n");
    }
  }
  const std::string once = seiche::write_case(seiche::parse_case(text, "case.toml", overrides));
  std::string twice;
  try {
    twice = seiche::write_case(seiche::parse_case(once, "case.toml"));
  } catch (const std::exception& refused) {
    twice = refused.what();
  }
  if (twice == once) return;
  std::fprintf(stderr, "written once:\n%s\nwritten twice:\n%s\n", once.c_str(), twice.c_str());
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  seiche::fuzz::within_bars([&] { read(text); }, text);
  return 0;
}
