#include <seiche/core/base/error.hpp>
#include <seiche/driver/checkpoint_keeper.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace seiche {
namespace {

constexpr double first_interval = 5, longest_interval = 60;  // seconds, where the case asks for none
constexpr double largest_part = 0.01;                        // of the time of a run, spent on checkpoints
constexpr double seconds_per_hour = 3600;

}  // namespace

CheckpointKeeper::CheckpointKeeper(Folder folder, Options options, const SavedRun* from)
    : folder_(std::move(folder)),
      options_(std::move(options)),
      begin_(Clock::now()),
      last_look_(begin_),
      next_save_(options_.when.every_seconds.value_or(first_interval)),
      last_n_(from != nullptr ? from->steps : 0),
      last_saved_n_(last_n_) {
  if (from != nullptr) saved_t_ = from->t;
}

Checkpoints::Wish CheckpointKeeper::look(std::int64_t n) {
  plan_next_look(n, Clock::now());
  if (options_.stops_at_once) return Wish::save_and_stop;
  const double now = passed();
  if (options_.hours > 0 && now >= seconds_per_hour * options_.hours) {
    out_of_time_ = true;
    return Wish::save_and_stop;
  }
  const bool is_asked = options_.asked != nullptr && options_.asked->exchange(false, std::memory_order_relaxed);
  const std::int64_t every = options_.when.every_steps;
  const bool is_its_step = every > 0 && n / every > last_saved_n_ / every;
  if (!is_asked && !is_its_step && !is_time(now)) return Wish::none;
  last_saved_n_ = n;
  return Wish::save;
}

bool CheckpointKeeper::is_time(double now) const { return options_.when.every_seconds != 0.0 && now >= next_save_; }

// In about a hundredth of a second, and no later than at the next step that wants a checkpoint. After so few steps at
// most that later ones may take much longer, as exponentials of longer steps do.
void CheckpointKeeper::plan_next_look(std::int64_t n, Clock::time_point now) {
  constexpr double interval = 0.01;
  constexpr std::int64_t longest = 64;
  const double since = std::chrono::duration<double>(now - last_look_).count();
  if (n > last_n_) stride_ = since < interval / 2 ? std::min(2 * stride_, longest) : stride_;
  if (since > 2 * interval) stride_ = std::max<std::int64_t>(stride_ / 2, 1);
  last_look_ = now;
  last_n_ = n;
  const std::int64_t every = options_.when.every_steps;
  look_again_at(every > 0 ? std::min(n + stride_, (n / every + 1) * every) : n + stride_);
}

// As the case asks; else after 5, 10, 20, 40 seconds and so on, up to a minute apart, and later where they would take
// more than their part of the time.
void CheckpointKeeper::plan_next_save(double began) {
  const double now = passed(), took = now - began;
  spent_ += took;
  if (options_.when.every_seconds) {
    next_save_ = now + *options_.when.every_seconds;
  } else {
    next_save_ = std::max(now + std::clamp(began, first_interval, longest_interval), (spent_ + took) / largest_part);
  }
}

SavedRun CheckpointKeeper::now(std::int64_t n, double t) {
  began_ = passed();
  return options_.now(n, t);
}

void CheckpointKeeper::commit(SavedRun saved, FunctionRef<void(Archive&)> run) {
  try {
    commit_checkpoint(folder_, options_.when.keep > 1, [&](Archive& archive) {
      archive(saved);
      if (options_.beside) options_.beside(archive);
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
  plan_next_save(began_);
}

std::string CheckpointKeeper::way_on(double t) const {
  if (!saved_t_) return "";
  const std::string way =
      options_.way.empty() ? fmt::format("`seiche resume {}`", folder_.path().string()) : options_.way;
  return fmt::format("{} goes on from {}", way,
                     *saved_t_ == t ? "there" : fmt::format("a checkpoint at t = {:.9g}", *saved_t_));
}

std::string CheckpointKeeper::why_stopped() const {
  return out_of_time_ ? fmt::format(", after {:.3g} hours as asked", options_.hours) : "";
}

}  // namespace seiche
