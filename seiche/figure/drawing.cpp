#include <seiche/core/text/input_file.hpp>
#include <seiche/figure/child_program.hpp>
#include <seiche/figure/drawing.hpp>
#include <seiche/version.hpp>

#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace seiche {
namespace {

namespace fs = std::filesystem;

constexpr int bad_request = 2, packages_missing = 3;  // exit codes of what is run

struct Chosen {
  fs::path programs;
  std::string interpreter;
};

Chosen& chosen() {
  static Chosen given;
  return given;
}

// Beside the program as it is built, as it is installed, or as the wheel has it; for the programs of others where
// Seiche is installed, or where Debian's package has it.
fs::path drawing_programs() {
  if (!chosen().programs.empty()) return chosen().programs;
  std::error_code unknown;
  const fs::path self = fs::read_symlink("/proc/self/exe", unknown);
  const fs::path above = self.parent_path().parent_path();
  for (const fs::path& folder : {self.parent_path() / "share/seiche", above / "share/seiche", above,
                                 fs::path(data_directory), fs::path("/usr/share/seiche")})
    if (fs::exists(folder / "drawing/__main__.py", unknown)) return folder / "drawing";
  throw Error(
      "there is no folder share/seiche/drawing beside {}, above it or in {}, with the programs that draw pictures",
      self.string(), data_directory);
}

struct Drawn {
  int exit_code = 0;
  std::string failure = {};
};

Drawn run(const std::string& interpreter, const fs::path& programs, const std::string& request, const fs::path& into) {
  try {
    // Without -B compiled files would appear where the programs are.
    ChildProgram python({interpreter, "-B", programs.string()}, request, into,
                        fmt::format("{} was not found; with Matplotlib it draws the pictures (Debian packages "
                                    "python3-matplotlib and python3-h5py)",
                                    interpreter));
    const std::string failure = python.finish();
    return {failure.empty() ? 0 : python.exit_code(), failure};
  } catch (const Error& error) {
    return {packages_missing, error.what()};
  }
}

}  // namespace

void draw_with(const fs::path& programs, const std::string& interpreter) { chosen() = {programs, interpreter}; }

std::vector<std::string> python_interpreters() {
  const char* named = std::getenv("SEICHE_PYTHON");  // NOLINT(concurrency-mt-unsafe)
  if (named != nullptr && *named != '\0') return {named};
  if (!chosen().interpreter.empty()) return {chosen().interpreter};
  return {"python3", "/usr/bin/python3"};
}

std::string draw(const std::string& request, const fs::path& into) {
  const fs::path programs = drawing_programs();
  std::string missing;
  for (const std::string& interpreter : python_interpreters()) {
    const Drawn drawn = run(interpreter, programs, request, into);
    if (drawn.failure.empty()) {
      const fs::path answer = into / "reply.json";
      std::string reply = text_of_file(answer);
      fs::remove(answer);
      return reply;
    }
    if (drawn.exit_code == bad_request) throw BadDrawingRequest("{}", drawn.failure);
    if (drawn.exit_code != packages_missing) throw Error("drawing failed: {}", drawn.failure);
    if (missing.empty()) missing = drawn.failure;
  }
  throw Error("{}", missing);
}

}  // namespace seiche
