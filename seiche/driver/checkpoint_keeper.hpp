// Keeps checkpoints of a run in its folder.
#pragma once

#include <seiche/config/case/run_spec.hpp>
#include <seiche/driver/saved_run.hpp>
#include <seiche/run/checkpoints.hpp>

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
    double seconds = 0;                  // after which the run is to be saved and to stop; 0: never
    // Fills in what the loop does not know.
    std::function<void(SavedRun&)> describe = {};
    std::function<void(const std::string&)> warn = {};
  };
  // `from`: of the checkpoint from which the run goes on; null: from the start.
  CheckpointKeeper(Folder folder, Options options, const SavedRun* from);

  // A checkpoint that cannot be written ends no run: that is said once.
  void save(FunctionRef<void(Archive&)> run) override;
  std::optional<double> saved_t() const { return saved_t_; }  // of the newest checkpoint, if there is one
  bool is_out_of_time() const { return out_of_time_; }

 private:
  using Clock = std::chrono::steady_clock;

  Wish look(std::int64_t n) override;
  void plan_next_look(std::int64_t n, Clock::time_point now);

  Folder folder_;
  Options options_;
  Clock::time_point begin_, last_save_, last_look_;
  std::int64_t last_n_, last_saved_n_, stride_ = 1;  // steps
  std::optional<double> saved_t_;
  bool has_warned_ = false, out_of_time_ = false;
};

}  // namespace seiche
