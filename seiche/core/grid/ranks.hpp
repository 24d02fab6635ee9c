// The processes that hold one state together.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/grid/units.hpp>

#include <span>
#include <string>

namespace seiche {

// Each call is one of all processes, and returns on all of them what is the same for all, but for `exchange`. Where one
// process has failed, the others do not wait for it: calls throw Error then.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual Rank here() const = 0;
  // all ← what each process holds, counts[r] numbers, in the order of ranks.
  virtual void gather(std::span<const double> mine, std::span<const Index> counts, std::span<double> all) const = 0;
  // To each process the next sent[r] numbers of `from`, and from each the next received[r] of `to`; but those of a
  // process to itself stay where they are, and so does what lies in their place.
  virtual void exchange(std::span<const double> from, std::span<const Index> sent, std::span<double> to,
                        std::span<const Index> received) const = 0;

  // Of what each process holds, as many numbers on all of them.
  void sum(std::span<double> numbers) const;  // in the order of ranks
  void max(std::span<double> numbers) const;  // NaN is the largest

  // The numbers of one or more fields, in the order that they have in one process, piece by piece: on the first
  // process. What `take` throws is thrown when all pieces have passed, since the other processes do not know of it.
  void join(const FieldPart& field, std::span<const double> mine,
            FunctionRef<void(std::span<const double> piece)> take) const;

  // All act. Where one throws Error, all throw it, or one of the same sentence: that of the lowest rank.
  void together(FunctionRef<void()> action) const;
  void on_first(FunctionRef<void()> action) const;        // the same where the first process acts alone
  std::string from_first(const std::string& text) const;  // that of the first process
  std::string any(const std::string& text) const;         // that of the first one which has a text, or ""
};

// The same where `ranks` may be null: of a process that is alone.
inline void on_first(const Ranks* ranks, FunctionRef<void()> action) {
  ranks != nullptr ? ranks->on_first(action) : action();
}
inline void together(const Ranks* ranks, FunctionRef<void()> action) {
  ranks != nullptr ? ranks->together(action) : action();
}

// Processes that were started together, and end together.
class Processes {
 public:
  virtual ~Processes() = default;
  virtual const Ranks& ranks() const = 0;    // those of all
  virtual int count_on_machine() const = 0;  // of those that share the memory of this one
  // Waits until all have made this call, but no longer than so many seconds: true where they have.
  virtual bool come_to_end(double patience) = 0;
  [[noreturn]] virtual void end_all(int exit_code) = 0;  // at once, while others may wait for this one
};

}  // namespace seiche
