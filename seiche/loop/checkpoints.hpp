// When a run hands over everything that evolves in it to a keeper of checkpoints, so that it can go on from there.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/control/archive.hpp>

#include <cstdint>

namespace seiche {

// Asked between two steps. A run that reads what was saved goes on from there to the same bits.
class Checkpoints {
 public:
  enum class Wish { none, save, save_and_stop };

  virtual ~Checkpoints() = default;
  // After n steps; costs a comparison as long as none can be due. Keepers that follow a clock, or wait for a
  // signal, look at it a hundred times a second at most.
  Wish wish(std::int64_t n) { return n < next_look_ ? Wish::none : look(n); }
  // After n steps, at t: run(archive) writes the run, behind whatever is in the archive.
  virtual void save(std::int64_t n, double t, FunctionRef<void(Archive&)> run) = 0;
  std::int64_t next_look() const { return next_look_; }  // no wish comes before so many steps

 protected:
  virtual Wish look(std::int64_t n) = 0;
  void look_again_at(std::int64_t n) { next_look_ = n; }

 private:
  std::int64_t next_look_ = 0;
};

// Of a run: who keeps checkpoints of it, and where it goes on from. Both may be null. With events, what their actions
// have done beside the state is not saved: those that were met before the checkpoint are not met again.
struct Resumption {
  Checkpoints* checkpoints = nullptr;
  Archive* from = nullptr;  // read up to where the run begins
};

}  // namespace seiche
