#include <seiche/core/text/input_file.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

namespace seiche {
namespace {

namespace fs = std::filesystem;

bool is_open_already(const fs::path& file) {
  const std::string name = file.lexically_normal().string();
  return name == "/dev/stdin" || name.starts_with("/dev/fd/") || name.starts_with("/proc/self/fd/");
}

}  // namespace

InputFile look_at(const fs::path& file) {
  std::error_code failure;
  const fs::file_status status = fs::status(file, failure);
  switch (status.type()) {
    case fs::file_type::regular: return {InputKind::file, ""};
    case fs::file_type::directory: return {InputKind::folder, ""};
    case fs::file_type::not_found: return {InputKind::missing, ""};
    case fs::file_type::none: return {InputKind::unreachable, failure.message()};
    default: return {is_open_already(file) ? InputKind::stream : InputKind::other, ""};
  }
}

std::string complaint_about_file(const fs::path& file) {
  const InputFile found = look_at(file);
  switch (found.kind) {
    case InputKind::file: return "";
    case InputKind::folder: return "is a folder";
    case InputKind::missing: return "does not exist";
    case InputKind::unreachable: return "cannot be reached: " + found.reason;
    case InputKind::stream:
    case InputKind::other: break;
  }
  return "is not a file";
}

std::string text_of_file(const fs::path& file) {
  if (look_at(file).kind != InputKind::file) return "";
  std::ifstream input(file);
  return {std::istreambuf_iterator<char>(input), {}};
}

std::string text_up_to(std::istream& input, std::size_t most) {
  constexpr std::size_t piece = std::size_t{1} << 16U;
  std::string text;
  while (input && text.size() <= most) {
    const std::size_t before = text.size();
    text.resize(before + std::min(piece, most + 1 - before));
    input.read(text.data() + before, static_cast<std::streamsize>(text.size() - before));
    text.resize(before + static_cast<std::size_t>(input.gcount()));
  }
  return text;
}

}  // namespace seiche
