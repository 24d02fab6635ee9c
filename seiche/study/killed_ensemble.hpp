// What the files of an ensemble say that was killed before it could sum them up.
#pragma once

#include <seiche/config/case/run_spec.hpp>
#include <seiche/output/text_table.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace seiche {

// Of members.csv: how many members ended how, and what became of their laws.
struct MemberCounts {
  std::map<std::string, std::int64_t> statuses, laws;
  std::int64_t steps = 0;
};
MemberCounts count_members(const TextTable& members);

// summary.json with the status "unfinished", from energy.csv and, where it is there, members.csv. Throws Error where
// one of them cannot be read, or energy.csv has no row.
std::string summary_of_killed_ensemble(const std::filesystem::path& directory, const RunSpec& spec);

}  // namespace seiche
