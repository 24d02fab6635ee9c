#include "command_line.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <seiche/core/base/shortened.hpp>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>

namespace seiche::cli {
namespace {

bool is_assignment(std::string_view text) {
  const std::size_t equals = text.find('=');
  const auto in_key = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '.'; };
  return equals != std::string_view::npos && equals > 0 &&
         std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(equals), in_key);
}

}  // namespace

void print_data(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw std::runtime_error(fmt::format("cannot write to standard output: {}", std::strerror(errno)));
  }
}

void print_note(std::string_view text) { print_lines(fmt::format("seiche: {}\n", text)); }

void print_failure(std::string_view text) { print_note(one_line(text)); }

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) print_note(note);
}

// Whoever closed stderr, or let its disk fill up, wants the result all the same.
void print_lines(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

void print_out_of_memory() noexcept {
  constexpr std::string_view text = "seiche: there is not enough memory for this\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

CLI::Validator whole_number(int least, int most) {
  return {[=](const std::string& text) {
            int value = 0;
            const bool is_one = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return is_one ? std::string()
                          : fmt::format("'{}' is no whole number from {} to {}", shortened(text), least, most);
          },
          ""};
}

void prepare_process() {
  // Memory may end where nothing may be thrown, as in destructors, or while another sentence is put together.
  static const std::terminate_handler usual = std::get_terminate();
  std::set_terminate([] {
    try {
      if (const std::exception_ptr current = std::current_exception()) std::rethrow_exception(current);
    } catch (const std::bad_alloc&) {
      print_out_of_memory();
      ::_exit(computation_failed);
    } catch (...) {
      usual();
    }
    usual();
  });
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of writing, which is told
  // The lowest number that is free is given to the next file that is opened. Opened the wrong way round, reading and
  // writing fail as they do with a closed one.
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(number, F_GETFD) < 0 && errno == EBADF)
      ::open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

std::vector<std::string> with_set_repeated(const std::vector<std::string>& arguments) {
  std::vector<std::string> out;
  bool after_set = false;
  bool first = false;  // the value of --set itself, whatever it looks like
  for (const std::string& argument : arguments) {
    if (after_set && !first && is_assignment(argument)) out.emplace_back("--set");
    after_set = argument == "--set" || (after_set && (first || is_assignment(argument)));
    first = argument == "--set";
    out.push_back(argument);
  }
  return out;
}

}  // namespace seiche::cli
