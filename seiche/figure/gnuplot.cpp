#include <seiche/core/error.hpp>
#include <seiche/figure/child_program.hpp>
#include <seiche/figure/gnuplot.hpp>

#include <fmt/format.h>

#include <cctype>
#include <memory>

namespace seiche {
namespace {

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
  std::vector<std::unique_ptr<ChildProgram>> running;
  running.reserve(scripts.size());
  for (const std::string& script : scripts) {
    // A user's ~/.gnuplot would change our figures.
    running.push_back(std::make_unique<ChildProgram>(
        std::vector<std::string>{"gnuplot", "--default-settings"}, script, directory,
        "gnuplot was not found on the PATH; it draws the figures (Debian package gnuplot-nox)"));
  }
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
