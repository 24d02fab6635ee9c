#include <seiche/core/grid/ranks.hpp>

#include <algorithm>
#include <vector>

namespace seiche {
namespace {

// numbers ← join of those of all processes, in the order of ranks.
template <class Join>
void reduce(const Ranks& ranks, std::span<double> numbers, const Join& join) {
  thread_local std::vector<Index> counts;  // no step allocates
  thread_local std::vector<double> all;
  const std::size_t k = numbers.size();
  counts.assign(static_cast<std::size_t>(ranks.here().count), static_cast<Index>(k));
  all.resize(counts.size() * k);
  ranks.gather(numbers, counts, all);
  std::copy_n(all.begin(), k, numbers.begin());
  for (std::size_t i = k; i < all.size(); ++i) numbers[i % k] = join(numbers[i % k], all[i]);
}

}  // namespace

void Ranks::sum(std::span<double> numbers) const {
  reduce(*this, numbers, [](double a, double b) { return a + b; });
}

void Ranks::max(std::span<double> numbers) const {
  reduce(*this, numbers, [](double a, double b) { return b <= a ? a : b; });
}

}  // namespace seiche
