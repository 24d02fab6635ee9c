// The processes that hold one state together.
#pragma once

#include <seiche/core/grid/units.hpp>

#include <span>

namespace seiche {

// Each call is one of all processes, and returns on all of them what is the same for all, but for `exchange`. Where one
// process has failed, the others do not wait for it: calls throw Error then.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual Rank here() const = 0;
  // all ← what each process holds, counts[r] numbers, in the order of ranks.
  virtual void gather(std::span<const double> mine, std::span<const Index> counts, std::span<double> all) const = 0;
  // To each process the next sent[r] numbers of `from`, and from each the next received[r] of `to`.
  virtual void exchange(std::span<const double> from, std::span<const Index> sent, std::span<double> to,
                        std::span<const Index> received) const = 0;

  // Of what each process holds, as many numbers on all of them.
  void sum(std::span<double> numbers) const;  // in the order of ranks
  void max(std::span<double> numbers) const;  // NaN is the largest
};

}  // namespace seiche
