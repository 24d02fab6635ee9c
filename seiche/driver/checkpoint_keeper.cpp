#include <seiche/core/error.hpp>
#include <seiche/driver/checkpoint_keeper.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace seiche {

CheckpointKeeper::CheckpointKeeper(Folder folder, Options options, const SavedRun* from)
    : folder_(std::move(folder)),
      options_(std::move(options)),
      begin_(Clock::now()),
      last_save_(begin_),
      last_look_(begin_),
      last_n_(from != nullptr ? from->steps : 0),
      last_saved_n_(last_n_) {
  if (from != nullptr) saved_t_ = from->t;
}

Checkpoints::Wish CheckpointKeeper::look(std::int64_t n) {
  const Clock::time_point now = Clock::now();
  plan_next_look(n, now);
  const auto is_over = [now](Clock::time_point since, double seconds) {
    return seconds > 0 && std::chrono::duration<double>(now - since).count() >= seconds;
  };
  if (is_over(begin_, options_.seconds)) {
    out_of_time_ = true;
    return Wish::save_and_stop;
  }
  const bool is_asked = options_.asked != nullptr && options_.asked->exchange(false, std::memory_order_relaxed);
  const std::int64_t every = options_.when.every_steps;
  const bool is_its_step = every > 0 && n % every == 0 && n != last_saved_n_;
  if (!is_asked && !is_its_step && !is_over(last_save_, options_.when.every_seconds)) return Wish::none;
  last_saved_n_ = n;
  return Wish::save;
}

// In about a hundredth of a second, and no later than at the next step that wants a checkpoint.
void CheckpointKeeper::plan_next_look(std::int64_t n, Clock::time_point now) {
  constexpr double interval = 0.01;
  constexpr std::int64_t longest = std::int64_t{1} << 24;
  const double passed = std::chrono::duration<double>(now - last_look_).count();
  if (n > last_n_) stride_ = passed < interval / 2 ? std::min(2 * stride_, longest) : stride_;
  if (passed > 2 * interval) stride_ = std::max<std::int64_t>(stride_ / 2, 1);
  last_look_ = now;
  last_n_ = n;
  const std::int64_t every = options_.when.every_steps;
  look_again_at(every > 0 ? std::min(n + stride_, (n / every + 1) * every) : n + stride_);
}

void CheckpointKeeper::save(FunctionRef<void(Archive&)> run) {
  SavedRun saved;
  options_.describe(saved);  // brings the rows so far to the disk: where that fails, the run does
  try {
    commit_checkpoint(folder_, options_.when.keep > 1, [&](Archive& archive) {
      archive(saved);
      run(archive);
    });
    saved_t_ = saved.t;
  } catch (const Error& error) {
    if (!std::exchange(has_warned_, true) && options_.warn)
      options_.warn(
          fmt::format("no checkpoint was written at t = {:.9g}, and {}: {}", saved.t,
                      saved_t_ ? fmt::format("the newest is that of t = {:.9g}", *saved_t_) : "there is no earlier one",
                      error.what()));
  }
  last_save_ = Clock::now();
}

}  // namespace seiche
