// Of members.csv: how many members ended how, and what became of their laws.
#pragma once

#include <seiche/output/text_table.hpp>

#include <cstdint>
#include <map>
#include <string>

namespace seiche {

struct MemberCounts {
  std::map<std::string, std::int64_t> statuses, laws;
  std::int64_t steps = 0;
};
MemberCounts count_members(const TextTable& members);

}  // namespace seiche
