#include <seiche/loop/run_pace.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

constexpr double two_to(int exponent) { return exponent == 0 ? 1.0 : 2 * two_to(exponent - 1); }

constexpr double least_attempts = two_to(16);
constexpr std::int64_t beginning = 1 << 6;  // attempts
constexpr double outgrown = 1e3;            // times |z| in the beginning: with shrinking steps a sign of a blow-up
constexpr double falling = 0.6;             // how far three doublings lead beside the three before; 1: h ∝ 1/e^t
// Attempts of a small system that have been made, and that are left at the present pace.
constexpr double left_of_runaway = two_to(21);
constexpr double done_of_collapse = two_to(23), left_of_collapse = two_to(26);
constexpr double done_of_endless = two_to(23), left_of_endless = 1e11;  // most of a day, at a microsecond each
constexpr double patience = 16;    // times that for solutions that fade, since at rest steps are long
constexpr double recovered = 1.2;  // the last doubling beside the one before
constexpr double nowhere = 1e-2;   // of the way that the first quarter led
constexpr double steady = 8.2;  // three doublings beside the three before; 8 at a constant pace, more where steps grow

constexpr const char* remedies =
    "take a larger tolerance, or another method (egc6 and crkn6 take longer steps than methods of order two); where none goes on, "
    "the solution blows up";

}  // namespace

RunPace::RunPace(double t_start, double t_end, Index unknowns)
    : t_end_(t_end), weight_(1 + static_cast<double>(unknowns) / 64), marks_{{t_start, 0}} {
  marks_.reserve(64);
}

std::string RunPace::objection(double t, double h, FunctionRef<double()> size) {
  if (++attempts_ < next_) return "";
  next_ *= 2;
  marks_.push_back({t, size()});
  if (attempts_ <= beginning) usual_size_ = std::max(usual_size_, marks_.back().size);
  return static_cast<double>(attempts_) < least_attempts ? "" : judge(h);
}

void RunPace::archive(Archive& a) {
  a(attempts_, next_, marks_, usual_size_);
  const std::size_t doublings = marks_.size();  // and one mark at 0
  a.require(doublings >= 1 && doublings < 62 && next_ == std::int64_t{1} << (doublings - 1) && attempts_ < next_);
}

double RunPace::way(std::size_t ago, std::size_t doublings) const {
  const std::size_t last = marks_.size() - 1 - ago;
  return marks_[last].t - marks_[last - doublings].t;
}

// The sum of a geometric series with the ratio of the last three doublings to the three before.
bool RunPace::shrinks(double& limit) const {
  const double ratio = way(0, 3) / way(3, 3);
  if (!(ratio < falling) || way(0, 1) > recovered * way(1, 1)) return false;
  limit = marks_.back().t + way(0, 3) * ratio / (1 - ratio);
  return limit < t_end_;
}

std::string RunPace::judge(double h) const {
  const auto done = static_cast<double>(attempts_);
  const Mark& now = marks_.back();
  const Mark& half = marks_[marks_.size() - 2];
  const Mark& quarter = marks_[marks_.size() - 3];
  const double pace = (now.t - half.t) / (done / 2);
  const double left = pace > 0 ? (t_end_ - now.t) / pace : std::numeric_limits<double>::infinity();
  const double work_done = done * weight_, work_left = left * weight_;

  double limit = 0;
  const bool has_outgrown = now.size > outgrown * usual_size_ && work_left >= left_of_runaway;
  const bool is_long = work_done >= done_of_collapse && work_left >= left_of_collapse;
  if ((has_outgrown || is_long) && shrinks(limit))
    return fmt::format(
        "the steps shrink without end: the last has h = {:.3g}, every doubling of the {:.3g} attempts so far led less far than the one "
        "before, and all to come would not pass t = {:.6g}; {}",
        h, done, limit, remedies);
  if (is_long && now.t - quarter.t < nowhere * (quarter.t - marks_.front().t))
    return fmt::format(
        "the steps have collapsed: three quarters of {:.3g} attempts led from t = {:.9g} to t = {:.9g}, the last with h = {:.3g}, and t = "
        "{:.9g} would take {:.3g} more; {}",
        done, quarter.t, now.t, h, t_end_, left, remedies);
  const bool fades = now.size < 0.9 * half.size;
  const bool is_steady = way(0, 3) <= steady * way(3, 3);
  if (is_steady && work_done >= done_of_endless * (fades ? patience : 1) && work_left > left_of_endless)
    return fmt::format(
        "the run would not end: with steps as the last, of h = {:.3g}, t = {:.9g} is {:.3g} attempts away; take an earlier end, a "
        "larger tolerance, or another method (egc6 and crkn6 take longer steps than methods of order two)",
        h, t_end_, left);
  return "";
}

}  // namespace seiche
