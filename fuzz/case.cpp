// Whatever stands in a case file, it is read or refused with a sentence; and what is read is written so that it reads
// the same.
#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace {

std::optional<std::string> written(std::string_view text) {
  try {
    return seiche::write_case(seiche::parse_case(text, "case.toml"));
  } catch (const seiche::Error&) {
    return std::nullopt;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::optional<std::string> once = written({reinterpret_cast<const char*>(data), size});
  if (!once) return 0;
  const std::optional<std::string> twice = written(*once);
  if (twice == once) return 0;
  std::fprintf(stderr, "written once:\n%s\nwritten twice:\n%s\n", once->c_str(), twice ? twice->c_str() : "refused");
  std::abort();
}
