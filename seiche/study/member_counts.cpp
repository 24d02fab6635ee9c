#include <seiche/study/member_counts.hpp>

namespace seiche {

MemberCounts count_members(const TextTable& members) {
  MemberCounts counts;
  for (std::size_t m = 0; m < members.rows(); ++m) {
    const std::string& status = members.text(m, "status");
    const std::string& law = members.text(m, "law");
    ++counts.statuses[status];
    if (law != "holds" || status != "failed") ++counts.laws[law];  // kept up to a failure is not kept
    counts.steps += static_cast<std::int64_t>(members.number(m, "steps"));
  }
  return counts;
}

}  // namespace seiche
