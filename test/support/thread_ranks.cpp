#include <test/support/thread_ranks.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace seiche::test {
namespace {

struct CallOfRank {
  std::string name;  // with its sizes where they must agree
  std::span<const double> from = {};
  std::span<const Index> sent = {};
};

// Where threads meet: each leaves its call, and all go on when all have come.
class Meeting {
 public:
  explicit Meeting(int count) : calls_(static_cast<std::size_t>(count)) {}

  void enter(int rank, const CallOfRank& call) {
    calls_[static_cast<std::size_t>(rank)] = call;
    wait(call.name);
    if (failed_) throw Error("another rank has failed");
    for (const CallOfRank& other : calls_)
      if (other.name != call.name) throw Error("rank {} calls {}, and another one {}", rank, call.name, other.name);
  }
  void leave(int rank) { wait(calls_[static_cast<std::size_t>(rank)].name); }
  const CallOfRank& of(int rank) const { return calls_[static_cast<std::size_t>(rank)]; }
  int count() const { return static_cast<int>(calls_.size()); }
  void fail() {
    const std::scoped_lock lock(mutex_);
    failed_ = true;
    all_here_.notify_all();
  }
  Traffic traffic;

 private:
  void wait(const std::string& name) {
    std::unique_lock lock(mutex_);
    const std::int64_t turn = turn_;
    if (++here_ == count()) {
      here_ = 0;
      ++turn_;
      all_here_.notify_all();
      return;
    }
    const bool came = all_here_.wait_for(lock, std::chrono::seconds(60), [&] { return turn_ != turn || failed_; });
    if (came) return;
    failed_ = true;
    all_here_.notify_all();
    throw Error("a rank waits in {} for others, which make no call", name);
  }

  std::vector<CallOfRank> calls_;
  std::mutex mutex_;
  std::condition_variable all_here_;
  int here_ = 0;
  std::int64_t turn_ = 0;
  std::atomic<bool> failed_ = false;
};

class ThreadRanks final : public Ranks {
 public:
  ThreadRanks(Meeting& meeting, int rank) : meeting_(meeting), rank_(rank) {}
  Rank here() const override { return {rank_, meeting_.count()}; }

  void gather(std::span<const double> mine, std::span<const Index> counts, std::span<double> all) const override {
    meet({fmt::format("gather of {}", fmt::join(counts, ", ")), mine, {}}, [&] {
      auto to = all.begin();
      for (int r = 0; r < meeting_.count(); ++r) {
        const std::span<const double> theirs = meeting_.of(r).from;
        if (std::ssize(theirs) != counts[static_cast<std::size_t>(r)])
          throw Error("rank {} gives {} numbers, and {} are expected", r, theirs.size(),
                      counts[static_cast<std::size_t>(r)]);
        to = std::copy(theirs.begin(), theirs.end(), to);
      }
      if (rank_ == 0) ++meeting_.traffic.reductions;
    });
  }
  void exchange(std::span<const double> from, std::span<const Index> sent, std::span<double> to,
                std::span<const Index> received) const override {
    meet({"exchange", from, sent}, [&] {
      Index at = 0;
      for (int r = 0; r < meeting_.count(); ++r) {
        const CallOfRank& theirs = meeting_.of(r);
        Index before = 0;
        for (int i = 0; i < rank_; ++i) before += theirs.sent[static_cast<std::size_t>(i)];
        const Index count = theirs.sent[static_cast<std::size_t>(rank_)];
        if (count != received[static_cast<std::size_t>(r)])
          throw Error("rank {} sends {} numbers to rank {}, which expects {}", r, count, rank_,
                      received[static_cast<std::size_t>(r)]);
        if (r != rank_) std::copy_n(theirs.from.begin() + before, count, to.begin() + at);
        at += count;
      }
      if (rank_ != 0) return;
      for (int r = 0; r < meeting_.count(); ++r)
        for (int other = 0; other < meeting_.count(); ++other)
          if (other != r && meeting_.of(r).sent[static_cast<std::size_t>(other)] > 0) {
            ++meeting_.traffic.messages;
            meeting_.traffic.bytes += 8 * meeting_.of(r).sent[static_cast<std::size_t>(other)];
          }
    });
  }

 private:
  // `read` while the numbers of all lie still.
  template <class Read>
  void meet(const CallOfRank& call, const Read& read) const {
    meeting_.enter(rank_, call);
    read();
    meeting_.leave(rank_);
  }

  Meeting& meeting_;
  int rank_;
};

}  // namespace

Traffic traffic_on_ranks(int count, const std::function<void(const Ranks&)>& body) {
  Meeting meeting(count);
  std::mutex mutex;
  std::exception_ptr first;
  std::vector<std::thread> threads;
  for (int rank = 0; rank < count; ++rank) {
    threads.emplace_back([&, rank] {
      try {
        body(ThreadRanks(meeting, rank));
      } catch (...) {
        {
          const std::scoped_lock lock(mutex);
          if (!first) first = std::current_exception();
        }
        meeting.fail();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  if (first) std::rethrow_exception(first);
  return meeting.traffic;
}

void on_ranks(int count, const std::function<void(const Ranks&)>& body) { traffic_on_ranks(count, body); }

}  // namespace seiche::test
