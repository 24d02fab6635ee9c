// Threads that share the blocks of loops by work stealing, and sleep where there is nothing to do.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/base/vector.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

namespace seiche {

// The caller is the first of the team. Each thread begins with a share of the blocks that lie together, the same in
// every loop of as many, so that data stays in the caches where it is; whoever is done takes blocks from the end of
// another's.
// So a loop waits for a thread that has no core to run on only until the one block is done that it may be in.
class ThreadTeam {
 public:
  // Where the system has no more threads to give, the team is smaller.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  // True if the calling thread is in the middle of a block: loops inside it are its own, and need no team.
  static bool is_in_a_block();
  // The calling thread's own, made when it is first asked for and kept while the same number is.
  static ThreadTeam& of_caller(int threads);

  // body(block, thread) for each of at most most_blocks, thread = 0 … threads − 1; an exception out of it ends the
  // program.
  static constexpr Index most_blocks = 0x7fffffff;
  void run(Index blocks, FunctionRef<void(Index, int)> body);

 private:
  // Blocks begin … end − 1 in one word: the owner takes the first, another the last.
  struct alignas(64) Share {
    std::atomic<std::uint64_t> range = 0;
  };

  void wait_for_loops(int thread);
  void work(int thread) noexcept;
  bool take(Share& share, bool from_the_end, Index& block);

  const bool spins_;           // before it sleeps: not where threads take turns on a core
  const std::uint64_t forks_;  // of this process, when the team was made
  std::vector<Share> shares_;
  const FunctionRef<void(Index, int)>* body_ = nullptr;  // of who has taken a block
  alignas(64) std::atomic<int> loops_ = 0;               // so far
  alignas(64) std::atomic<int> left_ = 0;                // blocks of this loop that are not done
  std::atomic<bool> ends_ = false;
  std::unique_ptr<std::vector<std::thread>> others_;
};

}  // namespace seiche
