#include <seiche/core/base/error.hpp>
#include <seiche/output/file/temporary_folder.hpp>

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>

namespace seiche {

namespace {

namespace fs = std::filesystem;
constexpr std::string_view beginning = ".seiche-view-";

// ".seiche-view-4711-a1b2c3" of process 4711.
void remove_those_of_dead_programs(const fs::path& near) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(near, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(beginning)) continue;
    const int process = std::atoi(name.c_str() + beginning.size());
    if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH) fs::remove_all(entry.path(), ignored);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder(const fs::path& near) {
  remove_those_of_dead_programs(near);
  const std::string name = fmt::format("{}{}-XXXXXX", beginning, ::getpid());
  std::string made = near / name;
  if (::mkdtemp(made.data()) == nullptr) {
    std::error_code unknown;
    made = fs::temp_directory_path(unknown) / name;
    if (unknown || ::mkdtemp(made.data()) == nullptr)
      throw Error("cannot make a temporary folder: {}", unknown ? unknown.message() : std::strerror(errno));
  }
  path_ = made;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace seiche
