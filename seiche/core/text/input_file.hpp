// Files that a user names, looked at before they are opened: a pipe without a writer would be waited for, and a
// device has no end.
#pragma once

#include <cstddef>
#include <filesystem>
#include <istream>
#include <string>

namespace seiche {

// stream: what the shell has opened for the program, /dev/stdin and <(…); other: pipes with a name, devices, sockets.
enum class InputKind { file, stream, folder, other, missing, unreachable };

struct InputFile {
  InputKind kind = InputKind::missing;
  std::string reason;  // of what is unreachable, in the words of the system
};

InputFile look_at(const std::filesystem::path& file);  // never throws

// Why it cannot be read as a file that stays as it is, "" where it can: "does not exist", "is a folder", "is not a
// file", "cannot be reached: Too many levels of symbolic links".
std::string complaint_about_file(const std::filesystem::path& file);

// All of a file; "" where it is not a file or cannot be read.
std::string text_of_file(const std::filesystem::path& file);

// All there is, or `most` bytes and one more.
std::string text_up_to(std::istream& input, std::size_t most);

}  // namespace seiche
