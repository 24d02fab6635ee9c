#include <seiche/core/base/error.hpp>
#include <seiche/figure/child_program.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace seiche {
namespace {

class SpawnActions {
 public:
  SpawnActions() { ::posix_spawn_file_actions_init(&actions_); }
  ~SpawnActions() { ::posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

// Without a name: nothing to clean up, and no pipe that could fill while both sides wait.
ChildProgram::File ChildProgram::unnamed_file(const std::string& program) {
  File file(std::tmpfile());
  if (!file) throw Error("cannot make a temporary file for {}: {}", program, std::strerror(errno));
  ::fcntl(::fileno(file.get()), F_SETFD, FD_CLOEXEC);
  return file;
}

ChildProgram::ChildProgram(const std::vector<std::string>& command, const std::string& input,
                           const std::filesystem::path& directory, const std::string& missing)
    : input_(unnamed_file(command.front())), output_(unnamed_file(command.front())) {
  const std::string& program = command.front();
  const bool written = std::fwrite(input.data(), 1, input.size(), input_.get()) == input.size();
  if (!written || std::fflush(input_.get()) != 0)
    throw Error("cannot write a temporary file for {}: {}", program, std::strerror(errno));
  std::rewind(input_.get());

  SpawnActions actions;
  ::posix_spawn_file_actions_adddup2(actions.get(), ::fileno(input_.get()), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(actions.get(), ::fileno(output_.get()), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(actions.get(), ::fileno(output_.get()), STDERR_FILENO);
  ::posix_spawn_file_actions_addchdir_np(actions.get(), directory.c_str());
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int failure = ::posix_spawnp(&process_, program.c_str(), actions.get(), nullptr, arguments.data(), ::environ);
  if (failure == 0) return;
  process_ = -1;
  // ENOENT may also mean the directory.
  if (failure == ENOENT && std::filesystem::is_directory(directory)) throw Error("{}", missing);
  throw Error("cannot start {} in {}: {}", program, directory.string(), std::strerror(failure));
}

std::string ChildProgram::finish() {
  wait();
  if (WIFEXITED(status_) && WEXITSTATUS(status_) == 0) return "";
  std::string said = last_words();
  if (!said.empty()) return said;
  return WIFSIGNALED(status_) ? fmt::format("ended by signal {}", WTERMSIG(status_))
                              : fmt::format("exit code {}", WEXITSTATUS(status_));
}

int ChildProgram::exit_code() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1; }

void ChildProgram::wait() {
  if (process_ < 0) return;
  while (::waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
}

// The error ends what a program says, warnings may come before.
std::string ChildProgram::last_words() {
  std::rewind(output_.get());
  std::string text(8192, '\0');
  if (std::fseek(output_.get(), -static_cast<long>(text.size()), SEEK_END) != 0) std::rewind(output_.get());
  text.resize(std::fread(text.data(), 1, text.size(), output_.get()));
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return "";
  text.resize(end + 1);
  constexpr std::size_t enough = 400;
  return text.size() > enough ? text.substr(text.size() - enough) : text;
}

}  // namespace seiche
