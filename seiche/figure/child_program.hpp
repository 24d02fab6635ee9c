// Another program, run as a child process: its input from a text, what it prints kept for the error. Never through a
// shell.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace seiche {

// A running one; waited for at the latest when it goes out of scope.
class ChildProgram {
 public:
  // `directory` is its working directory: then no path in its arguments need be quoted. Throws Error where it cannot be
  // started; `missing` is what is said where there is no such program on the PATH.
  ChildProgram(const std::vector<std::string>& command, const std::string& input,
               const std::filesystem::path& directory, const std::string& missing);
  ~ChildProgram() { wait(); }
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  std::string finish();   // waits; what went wrong in the program's own words, or ""
  int exit_code() const;  // behind finish(); −1 where a signal ended it

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  using File = std::unique_ptr<std::FILE, Close>;
  static File unnamed_file(const std::string& program);
  void wait();
  std::string last_words();

  File input_, output_;
  pid_t process_ = -1;
  int status_ = 0;
};

}  // namespace seiche
