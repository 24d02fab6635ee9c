#include "bars.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>

// What is freed is kept for a while, to see it used. So much of it that memory is still ours to judge.
extern "C" const char* __asan_default_options() { return "quarantine_size_mb=16:detect_stack_use_after_return=0"; }

namespace seiche::fuzz {
namespace {

constexpr double longest = 10;           // seconds: five times what the slowest input takes in sanitized code
constexpr long most_memory = 512;        // MB
constexpr std::size_t most_bytes = 400;  // of a line

[[noreturn]] void miss(const std::string& what) {
  std::fprintf(stderr, "fuzz: %s\n", what.c_str());
  std::abort();
}

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

long megabytes() {  // the most that there were
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

// As cli/main.cpp prints it.
void require_line(std::string_view sentence, std::string_view input) {
  const std::string line = fmt::format("seiche: {}\n", one_line(sentence));
  if (line.size() > most_bytes || std::count(line.begin(), line.end(), '\n') != 1) miss("no line: " + line);
  for (const std::string_view words : {"[json.exception", "filesystem error", "std::", "TOML_"})
    if (line.find(words) != std::string::npos && input.find(words) == std::string_view::npos)
      miss("words of a library: " + line);
}

}  // namespace

void within_bars(const std::function<void()>& execution, std::string_view input) {
  const double begin = seconds();
  const long before = megabytes();
  try {
    execution();
  } catch (const Error& error) {
    require_line(error.what(), input);
  } catch (const std::bad_alloc&) {                     // the program has
  } catch (const std::filesystem::filesystem_error&) {  // its own words for these
  } catch (const std::exception& error) {
    if (!std::string_view(error.what()).starts_with("[json.exception")) require_line(error.what(), input);
  }
  if (const double took = seconds() - begin; took > longest) miss(fmt::format("{:.1f} s of a processor", took));
  if (const long more = megabytes() - before; more > most_memory) miss(fmt::format("{} MB", more));
}

}  // namespace seiche::fuzz
