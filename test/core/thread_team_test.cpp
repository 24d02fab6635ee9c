// Loops that threads share: every block is done once, and no loop waits for a thread that does not come.
#include <gtest/gtest.h>
#include <seiche/core/simd/parallel.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

TEST(ThreadTeam, DoesEveryBlockOnceWhateverTheNumbers) {
  for (const int threads : {2, 3, 7}) {
    for (Index blocks = 2; blocks < 300; blocks += 1 + blocks / 5) {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(blocks));
      for (int loop = 1; loop <= 20; ++loop) {
        for_blocks_by_thread(blocks, threads, [&](Index block, int thread) {
          ASSERT_LT(thread, threads);
          ++done[static_cast<std::size_t>(block)];
        });
        for (const auto& times : done) ASSERT_EQ(times, loop) << threads << " threads, " << blocks << " blocks";
      }
    }
  }
}

// Buffers belong to a thread of the loop: two blocks at once with the same number would share one.
TEST(ThreadTeam, NoTwoBlocksAtATimeHaveTheSameThread) {
  constexpr int threads = 4;
  std::array<std::atomic<bool>, threads> busy{};
  for (int loop = 0; loop < 200; ++loop)
    for_blocks_by_thread(64, threads, [&](Index, int thread) {
      auto& mine = busy[static_cast<std::size_t>(thread)];
      ASSERT_FALSE(mine.exchange(true));
      for (volatile int i = 0; i < 2000;) i = i + 1;  // some microseconds, in which others are at work
      mine = false;
    });
}

TEST(ThreadTeam, ASlowThreadLeavesItsBlocksToOthers) {
  constexpr Index blocks = 100;
  std::array<std::atomic<int>, 2> done{};
  for_blocks_by_thread(blocks, 2, [&](Index, int thread) {
    // The second thread holds its first block until the other one has done all the rest.
    const int other = 1 - thread;
    ++done[static_cast<std::size_t>(thread)];
    if (thread == 1)
      while (done[static_cast<std::size_t>(other)] < blocks - 1) std::this_thread::yield();
  });
  EXPECT_EQ(done[0] + done[1], blocks);
  EXPECT_LE(done[1], 1) << "half of them were its own";
}

TEST(ThreadTeam, ALoopInsideABlockStaysOnItsThread) {
  for (const int threads_inside : {2, 3}) {
    std::atomic<int> inner = 0;
    for_blocks(8, 2, [&](Index) {
      const std::thread::id here = std::this_thread::get_id();
      for_blocks(5, threads_inside, [&](Index) {
        EXPECT_EQ(std::this_thread::get_id(), here);
        ++inner;
      });
    });
    EXPECT_EQ(inner, 40);
  }
}

// Python forks for its worker processes, and only the thread that forked goes on in the child.
TEST(ThreadTeam, GoesOnInTheChildOfAFork) {
  const auto counted = [] {
    std::atomic<int> done = 0;
    for_blocks(50, 2, [&](Index) { ++done; });
    return done.load();
  };
  EXPECT_EQ(counted(), 50);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) _exit(counted() == 50 ? 0 : 1);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

}  // namespace TEST_FILE
}  // namespace seiche::test
