// Case files: TOML in, a checked RunSpec out, and back by case_writer.hpp. Mistakes are reported in the order of the
// source, with file, line and column.
#pragma once

#include <seiche/config/case/case_writer.hpp>
#include <seiche/config/case/run_spec.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

// What a case file holds: a regular file, or what the shell has opened (/dev/stdin, <(…)). Throws Error where it cannot
// be read, or would be waited for or read without end.
std::string case_text(const std::filesystem::path& file);

// `overrides` are those of --set: "method.h=1/64". They replace what the file says and are checked the same way. Where
// `methods` will take the place of the one in the case, each option of [method] must suit one of them, and need not
// suit that one.
RunSpec read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                  const std::vector<std::string>& methods = {});

// `name` is how errors call the text; file names in it start at `folder`, or else at the current one.
RunSpec parse_case(std::string_view text, std::string_view name, const std::vector<std::string>& overrides = {},
                   const std::filesystem::path& folder = {}, const std::vector<std::string>& methods = {});

}  // namespace seiche
