#include <seiche/core/error.hpp>
#include <seiche/figure/gnuplot.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

namespace seiche {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

// Without a name: nothing to clean up, and no pipe that could fill while both sides wait.
File unnamed_file() {
  File file(std::tmpfile());
  if (!file) throw Error("cannot make a temporary file for gnuplot: {}", std::strerror(errno));
  ::fcntl(::fileno(file.get()), F_SETFD, FD_CLOEXEC);
  return file;
}

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

// A running gnuplot; waited for at the latest when it goes out of scope.
class Gnuplot {
 public:
  Gnuplot(const std::string& script, const std::filesystem::path& directory)
      : input_(unnamed_file()), output_(unnamed_file()) {
    const bool written = std::fwrite(script.data(), 1, script.size(), input_.get()) == script.size();
    if (!written || std::fflush(input_.get()) != 0) {
      throw Error("cannot write a temporary file for gnuplot: {}", std::strerror(errno));
    }
    std::rewind(input_.get());

    SpawnActions actions;
    ::posix_spawn_file_actions_adddup2(actions.get(), ::fileno(input_.get()), STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(actions.get(), ::fileno(output_.get()), STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(actions.get(), ::fileno(output_.get()), STDERR_FILENO);
    // A directory need not be quoted if it is where gnuplot already is.
    ::posix_spawn_file_actions_addchdir_np(actions.get(), directory.c_str());
    char name[] = "gnuplot";
    char no_init_file[] = "--default-settings";  // a user's ~/.gnuplot would change our figures
    char* const arguments[] = {name, no_init_file, nullptr};
    const int failure = ::posix_spawnp(&process_, name, actions.get(), nullptr, arguments, ::environ);
    if (failure == 0) return;
    process_ = -1;
    // ENOENT may also mean the directory.
    if (failure == ENOENT && std::filesystem::is_directory(directory)) {
      throw Error("gnuplot was not found on the PATH; it draws the figures (Debian package gnuplot-nox)");
    }
    throw Error("cannot start gnuplot in {}: {}", directory.string(), std::strerror(failure));
  }

  ~Gnuplot() { wait(); }
  Gnuplot(const Gnuplot&) = delete;
  Gnuplot& operator=(const Gnuplot&) = delete;

  // What went wrong, or "".
  std::string finish() {
    wait();
    if (WIFEXITED(status_) && WEXITSTATUS(status_) == 0) return "";
    std::string said = message();
    if (!said.empty()) return said;
    return WIFSIGNALED(status_) ? "ended by signal " + std::to_string(WTERMSIG(status_))
                                : "exit code " + std::to_string(WEXITSTATUS(status_));
  }

 private:
  void wait() {
    if (process_ < 0) return;
    while (::waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
  }

  // Its last lines: the error ends what gnuplot says, warnings may come before.
  std::string message() {
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

  File input_, output_;
  pid_t process_ = -1;
  int status_ = 0;
};

// In double quotes with everything but letters and blanks by its octal code: gnuplot runs what stands between
// backquotes, and takes a doubled single quote at the start of a string for its end. A digit after such a code would be
// read as part of it, so that digits have theirs too.
std::string literal(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= 0x80 || std::isalpha(byte) != 0 || c == ' ';
    result += plain ? std::string(1, c) : fmt::format("\\{:03o}", byte);
  }
  return result + "\"";
}

}  // namespace

void run_gnuplot(const std::vector<std::string>& scripts, const std::filesystem::path& directory) {
  std::vector<std::unique_ptr<Gnuplot>> running;
  running.reserve(scripts.size());
  for (const std::string& script : scripts) running.push_back(std::make_unique<Gnuplot>(script, directory));
  std::string failure;
  for (const auto& gnuplot : running) {
    const std::string message = gnuplot->finish();
    if (failure.empty()) failure = message;
  }
  if (!failure.empty()) throw Error("gnuplot failed: {}", failure);
}

std::string gnuplot_file(std::string_view name) { return literal(name); }

std::string gnuplot_text(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    // Enhanced text reads these as mark-up; a backslash makes them letters.
    if (std::string_view("_^{}@&~\\").find(c) != std::string_view::npos) escaped += '\\';
    escaped += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return literal(escaped);
}

}  // namespace seiche
