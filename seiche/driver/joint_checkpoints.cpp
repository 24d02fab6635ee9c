#include <seiche/driver/joint_checkpoints.hpp>

#include <array>
#include <optional>
#include <string_view>

namespace seiche {

void JointCheckpoints::save(std::int64_t n, double t, FunctionRef<void(Archive&)> run) {
  std::optional<SavedRun> saved;
  ranks_.on_first([&] { saved = keeper_->now(n, t); });
  if (keeper_ != nullptr) return keeper_->commit(*saved, run);
  Archive nowhere([](std::string_view) {});
  run(nowhere);
}

Checkpoints::Wish JointCheckpoints::look(std::int64_t n) {
  std::array<double, 3> said{stop_.load(std::memory_order_relaxed) ? 1.0 : 0.0, 0, 0};
  if (asked_ != nullptr && asked_->exchange(false, std::memory_order_relaxed))
    said[1] = static_cast<double>(Wish::save);
  if (keeper_ != nullptr) {
    said[1] = static_cast<double>(keeper_->wish(n));
    said[2] = static_cast<double>(keeper_->next_look());
  }
  ranks_.max(said);
  look_again_at(static_cast<std::int64_t>(said[2]));
  return said[0] != 0 ? Wish::save_and_stop : static_cast<Wish>(static_cast<int>(said[1]));
}

}  // namespace seiche
