// Keeps checkpoints of a run in its folder.
#pragma once

#include <seiche/config/case/run_spec.hpp>
#include <seiche/loop/checkpoints.hpp>
#include <seiche/record/saved_run.hpp>

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace seiche {

class CheckpointKeeper : public Checkpoints {
 public:
  struct Options {
    CheckpointSpec when = {};
    std::atomic<bool>* asked = nullptr;  // set by a signal: one more, and on
    double hours = 0;                    // after which the run is to be saved and to stop; 0: never
    bool stops_at_once = false;
    // After so many steps, at t, with what was recorded so far on the disk.
    std::function<SavedRun(std::int64_t n, double t)> now = {};
    std::function<void(Archive&)> beside = {};  // what else the time loop does not know; may be null
    std::function<void(const std::string&)> warn = {};
    std::string way = {};  // what goes on from a checkpoint; "": `seiche resume` with the folder
  };
  // `from`: of the checkpoint from which the run goes on; null: from the start.
  CheckpointKeeper(Folder folder, Options options, const SavedRun* from);

  // A checkpoint that cannot be written ends no run: that is said once.
  void save(std::int64_t n, double t, FunctionRef<void(Archive&)> run) override { commit(now(n, t), run); }
  // The same in two steps. The first brings the rows so far to the disk: where that fails, the run does.
  SavedRun now(std::int64_t n, double t);
  void commit(SavedRun saved, FunctionRef<void(Archive&)> run);
  // What to say of a run that has not come to its end, but to t: "; `seiche resume out` goes on from there"; "" where
  // no checkpoint was written.
  std::string way_on(double t) const;
  std::string why_stopped() const;  // ", after 2 hours as asked", or ""

 private:
  using Clock = std::chrono::steady_clock;

  Wish look(std::int64_t n) override;
  bool is_time(double now) const;
  void plan_next_look(std::int64_t n, Clock::time_point now);
  void plan_next_save(double began);
  double passed() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  Folder folder_;
  Options options_;
  Clock::time_point begin_, last_look_;
  double next_save_, began_ = 0, spent_ = 0;         // seconds: since the run began, and on checkpoints so far
  std::int64_t last_n_, last_saved_n_, stride_ = 1;  // steps
  std::optional<double> saved_t_;                    // of the newest checkpoint
  bool has_warned_ = false, out_of_time_ = false;
};

}  // namespace seiche
