#include <seiche/core/simd/thread_team.hpp>

#include <pthread.h>

#include <chrono>
#include <exception>

namespace seiche {
namespace {

// Longer than what lies between two loops of a step, and a small part of what a scheduler gives to a thread at a time.
// A thread that sleeps at once comes back too late for most loops wherever its core has another thread to run.
constexpr std::chrono::microseconds longest_spin(60);

thread_local bool in_a_block = false;

// In the child of a fork there are no threads but the one that has forked.
std::uint64_t forks() {
  static std::atomic<std::uint64_t> count = 0;
  [[maybe_unused]] static const int counted = ::pthread_atfork(nullptr, nullptr, [] { ++count; });
  return count.load(std::memory_order_relaxed);
}

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

// Until `number` is not `old` any more.
void wait_while(const std::atomic<int>& number, int old, bool spins) {
  using Clock = std::chrono::steady_clock;
  constexpr int pauses = 64;  // between two looks at the clock
  const Clock::time_point begin = Clock::now();
  while (spins && Clock::now() - begin < longest_spin) {
    for (int i = 0; i < pauses; ++i) {
      if (number.load(std::memory_order_acquire) != old) return;
      pause();
    }
  }
  number.wait(old, std::memory_order_acquire);
}

std::uint64_t range(Index begin, Index end) {
  return static_cast<std::uint64_t>(begin) << 32U | static_cast<std::uint64_t>(end);
}

}  // namespace

ThreadTeam::ThreadTeam(int threads)
    : spins_(threads <= static_cast<int>(std::thread::hardware_concurrency())),
      forks_(forks()),
      shares_(static_cast<std::size_t>(threads)),
      others_(std::make_unique<std::vector<std::thread>>()) {
  others_->reserve(shares_.size());
  try {
    for (int thread = 1; thread < threads; ++thread) others_->emplace_back([this, thread] { wait_for_loops(thread); });
  } catch (const std::exception&) {  // their shares are taken by those that are there
  }
}

ThreadTeam::~ThreadTeam() {
  if (forks_ != forks()) {
    static_cast<void>(others_.release());  // there is no thread to join
    return;
  }
  ends_ = true;
  ++loops_;
  loops_.notify_all();
  for (std::thread& other : *others_) other.join();
}

bool ThreadTeam::is_in_a_block() { return in_a_block; }

ThreadTeam& ThreadTeam::of_caller(int threads) {
  thread_local std::unique_ptr<ThreadTeam> team;
  if (!team || team->shares_.size() != static_cast<std::size_t>(threads) || team->forks_ != forks()) {
    team.reset();
    team = std::make_unique<ThreadTeam>(threads);
  }
  return *team;
}

void ThreadTeam::run(Index blocks, FunctionRef<void(Index, int)> body) {
  const auto threads = static_cast<Index>(shares_.size());
  body_ = &body;
  left_.store(static_cast<int>(blocks), std::memory_order_relaxed);
  for (Index thread = 0; thread < threads; ++thread)
    shares_[static_cast<std::size_t>(thread)].range.store(range(blocks * thread / threads,
                                                                blocks * (thread + 1) / threads),
                                                          std::memory_order_release);
  loops_.fetch_add(1, std::memory_order_release);
  loops_.notify_all();
  work(0);
  for (int left = left_.load(std::memory_order_acquire); left > 0; left = left_.load(std::memory_order_acquire))
    wait_while(left_, left, spins_);
}

void ThreadTeam::wait_for_loops(int thread) {
  for (int seen = 0;;) {
    wait_while(loops_, seen, spins_);
    if (ends_) return;
    seen = loops_.load(std::memory_order_acquire);
    work(thread);
  }
}

void ThreadTeam::work(int thread) noexcept {
  in_a_block = true;
  int done = 0;
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    Share& share = shares_[(static_cast<std::size_t>(thread) + i) % shares_.size()];
    for (Index block = 0; take(share, i > 0, block); ++done) (*body_)(block, thread);
  }
  // What was taken is of the present loop, which does not end before all of it is counted here.
  if (done > 0 && left_.fetch_sub(done, std::memory_order_acq_rel) == done) left_.notify_one();
  in_a_block = false;
}

bool ThreadTeam::take(Share& share, bool from_the_end, Index& block) {
  std::uint64_t found = share.range.load(std::memory_order_relaxed);
  for (;;) {
    const auto begin = static_cast<Index>(found >> 32U), end = static_cast<Index>(found & 0xffffffffU);
    if (begin >= end) return false;
    block = from_the_end ? end - 1 : begin;
    const std::uint64_t rest = from_the_end ? range(begin, end - 1) : range(begin + 1, end);
    if (share.range.compare_exchange_weak(found, rest, std::memory_order_acq_rel, std::memory_order_relaxed))
      return true;
  }
}

}  // namespace seiche
