#include <seiche/core/base/vector.hpp>
#include <seiche/loop/energy_book.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace seiche {
namespace {

void advance(EnergySummary& summary, double increase, double value, bool first_increase) {
  summary.final = value;
  summary.max_increase = first_increase ? increase : std::max(summary.max_increase, increase);
}

constexpr int first_records = 100;  // that may give H a size

// By how much no solution multiplies the terms of an energy in so many steps.
double grossest_growth(double steps) { return std::min(std::pow(1e6, steps), 1e30); }

// Both ends of a difference carry round-off, so the larger counts; but a rise is not excused by terms that came with
// it.
double round_off(double before, double after, double growth) {
  return std::max(before, std::min(after, growth * before));
}

}  // namespace

EnergyBook::EnergyBook(LawPromise promise, bool has_modified_energy)
    : promise_(std::move(promise)), has_modified_energy_(has_modified_energy) {}

void EnergyBook::add(const EnergyReading& reading, double t, std::int64_t n) {
  take_size(reading);
  follow(reading, t);
  if (empty_) {
    energy_ = {.initial = reading.H, .final = reading.H, .max_increase = 0.0};
    modified_ = {.initial = reading.modified, .final = reading.modified, .max_increase = 0.0};
    empty_ = false;
  } else if (reopened_) {
    energy_.final = reading.H;
    modified_.final = reading.modified;
  } else {
    advance(energy_, reading.H - last_.H, reading.H, !has_increase_);
    advance(modified_, reading.modified - last_.modified, reading.modified, !has_increase_);
    has_increase_ = true;

    const double increase = has_modified_energy_ ? reading.modified - last_.modified : reading.H - last_.H;
    if (increase > 0) judge(increase, reading, t, static_cast<double>(n - last_n_));
  }
  reopened_ = false;
  last_ = reading;
  last_n_ = n;
}

// A rise since the last record, so many steps ago.
void EnergyBook::judge(double increase, const EnergyReading& reading, double t, double steps) {
  // What starts near rest finds its size in the first step.
  const bool first = records_ == 2;
  const double growth = first ? std::numeric_limits<double>::infinity() : grossest_growth(steps);
  const double allowed =
      steps * (has_modified_energy_ ? round_off(last_.modified_round_off, reading.modified_round_off, growth)
                                    : round_off(last_.round_off, reading.round_off, growth));
  // The method's shift C may grow by more than any solution, and take the digits of a modified energy with it.
  const double with_shift = steps * reading.modified_round_off;
  if (increase > allowed && has_modified_energy_ && increase <= with_shift && with_shift > size_) {
    if (!violation_.found && !lost_in_round_off_.found) lost_in_round_off_ = {t, with_shift, size_, true};
  } else if (increase > allowed && !violation_.found) {
    violation_ = {t, increase, allowed, true};
  }
  // Round-off explains it, and would explain more than all there was at the start: the law cannot be checked. But in
  // the first step it is that rise itself which takes all there was.
  if (increase > size_ && increase <= allowed) {
    if (first && !violation_.found) violation_ = {t, increase, last_.round_off, true};
    if (!first && !lost_in_round_off_.found) lost_in_round_off_ = {t, allowed, size_, true};
  }
}

void EnergyBook::archive(Archive& a) {
  a(empty_, reopened_, has_increase_, last_n_, records_, size_, rests_, H_at_start_, largest_size_);
  a(rise_, fall_, parting_, violation_, lost_in_round_off_);
  a.numbers(last_);
  a.numbers(energy_);
  a.numbers(modified_);
  a.require(records_ >= 0 && records_ <= first_records);
}

// At rest where V = 0 nothing has a size yet: the largest of the first records then stands for the start. Below the
// squares of what is next to the least number, terms are no more than at rest.
void EnergyBook::take_size(const EnergyReading& reading) {
  constexpr double nothing = 1e-290;
  if (records_ == first_records) return;
  const double size = (has_modified_energy_ ? reading.modified_round_off : reading.round_off) / (50 * epsilon);
  if (++records_ == 1) rests_ = size < nothing;
  if (records_ == 1 || rests_) size_ = std::max(size_, size);
}

void EnergyBook::follow(const EnergyReading& reading, double t) {
  if (empty_ || reopened_) H_at_start_ = reading.H;
  largest_size_ = std::max(largest_size_, reading.size);
  const double change = reading.H - H_at_start_;
  if (change > rise_.to - rise_.from) rise_ = {.from = H_at_start_, .to = reading.H, .t = t};
  if (change < fall_.to - fall_.from) fall_ = {.from = H_at_start_, .to = reading.H, .t = t};
  if (has_modified_energy_ && std::abs(reading.H - reading.modified) > std::abs(parting_.to - parting_.from))
    parting_ = {.from = reading.modified, .to = reading.H, .t = t, .is_damped = false, .is_parting = true};
}

// H near zero may be a difference of ½zᵀMz and V that are large, of which every method misses a little.
std::optional<EnergyDrift> EnergyBook::drift() const {
  if (!promise_.never_grows && !promise_.never_changes) return {};
  if (promise_.promised && (violation_.found || lost_in_round_off_.found)) return {};
  const bool falls_more = fall_.from - fall_.to > rise_.to - rise_.from;
  EnergyDrift largest = promise_.never_changes && falls_more ? fall_ : rise_;
  const auto is_large = [this](const EnergyDrift& d) {
    return std::abs(d.to - d.from) > 0.1 * std::max(std::abs(H_at_start_), largest_size_);
  };
  if (!is_large(largest)) return is_large(parting_) ? std::optional(parting_) : std::nullopt;
  largest.is_damped = !promise_.never_changes;
  return largest;
}

void EnergyBook::write_to(RunReport& report) const {
  report.energy = energy_;
  report.has_modified_energy = has_modified_energy_;
  report.modified = modified_;
  report.law_reason = promise_.reason;
  report.drift = drift();
  if (!promise_.promised) {
    report.law = LawVerdict::not_promised;
    return;
  }
  if (!has_increase_) {
    report.law = LawVerdict::not_tested;
    return;
  }
  const char* const name = has_modified_energy_ ? "modified energy" : "energy H";
  if (violation_.found) {
    report.law = LawVerdict::violated;
    report.law_reason = fmt::format("the {} rose by {:.3g} up to t = {:.6g}, and round-off explains only {:.3g}", name,
                                    violation_.increase, violation_.t, violation_.round_off);
  } else if (lost_in_round_off_.found) {
    // A modified energy loses its digits to its shift C, which is the method's; H to the growth of the solution.
    report.law = has_modified_energy_ ? LawVerdict::violated : LawVerdict::not_promised;
    report.law_reason = fmt::format(
        "the {} can no longer be told from round-off: at t = {:.6g} that is {:.3g} in its terms, and all of them were {:.3g} at the "
        "start",
        name, lost_in_round_off_.t, lost_in_round_off_.round_off, lost_in_round_off_.size);
  } else {
    report.law = LawVerdict::holds;
  }
}

}  // namespace seiche
