// The program beside the test, to be sent signals.
#pragma once

#include <test/support/paths.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace seiche::test {

class Background {
 public:
  // Seconds: however slow the machine, what takes longer than this will never come.
  static constexpr int hangs = 200;

  // In `directory`; what it says goes to stdout.txt and stderr.txt there, and `input`, if any, is its standard input.
  Background(const std::filesystem::path& directory, const std::vector<std::string>& arguments, int input = -1) {
    const std::string home = directory.string();
    std::vector<std::string> words = {"seiche"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> values;
    for (std::string& word : words) values.push_back(word.data());
    values.push_back(nullptr);
    const std::string program = program_path();
    child_ = fork();
    if (child_ != 0) return;
    if (chdir(home.c_str()) != 0 || !freopen("stdout.txt", "w", stdout) || !freopen("stderr.txt", "w", stderr) ||
        (input >= 0 && dup2(input, STDIN_FILENO) < 0))
      _exit(9);
    execv(program.c_str(), values.data());
    _exit(9);
  }
  ~Background() {
    if (child_ > 0) end(SIGKILL);
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  static bool wait_until(const std::function<bool()>& condition, int seconds = hangs) {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
    bool is_met = condition();
    while (!is_met && std::chrono::steady_clock::now() < give_up) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      is_met = condition();
    }
    return is_met;
  }

  void send(int signal) const { kill(child_, signal); }

  // Its exit code, or the signal that ended it with a minus; −1000 where it did not end for seconds, and was killed.
  int end(int signal) {
    kill(child_, signal);
    int status = 0;
    bool ended = false;
    wait_until([&] { return ended = ended || waitpid(child_, &status, WNOHANG) == child_; });
    if (!ended) {
      kill(child_, SIGKILL);
      waitpid(child_, &status, 0);
    }
    child_ = -1;
    if (!ended) return -1000;
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  }

 private:
  pid_t child_ = -1;
};

}  // namespace seiche::test
