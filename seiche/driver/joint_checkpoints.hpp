// Checkpoints of a run on several processes: the first one keeps them, and decides when.
#pragma once

#include <seiche/core/grid/ranks.hpp>
#include <seiche/driver/checkpoint_keeper.hpp>
#include <seiche/loop/checkpoints.hpp>

#include <atomic>
#include <cstdint>

namespace seiche {

class JointCheckpoints final : public Checkpoints {
 public:
  // `keeper` is that of the first process, and null on the others, where `asked` (or null) asks for a checkpoint as it
  // does there. All stop where `stop` is set on one of them.
  JointCheckpoints(const Ranks& ranks, CheckpointKeeper* keeper, const std::atomic<bool>& stop,
                   std::atomic<bool>* asked = nullptr)
      : ranks_(ranks), keeper_(keeper), stop_(stop), asked_(asked) {}

  void save(std::int64_t n, double t, FunctionRef<void(Archive&)> run) override;

 private:
  Wish look(std::int64_t n) override;

  const Ranks& ranks_;
  CheckpointKeeper* keeper_;
  const std::atomic<bool>& stop_;
  std::atomic<bool>* asked_;
};

}  // namespace seiche
