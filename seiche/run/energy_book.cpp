#include <seiche/core/vector.hpp>
#include <seiche/run/energy_book.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace seiche {
namespace {

void advance(EnergySummary& summary, double increase, double value, bool first_increase) {
  summary.final = value;
  summary.max_increase = first_increase ? increase : std::max(summary.max_increase, increase);
}

}  // namespace

EnergyBook::EnergyBook(LawPromise promise, bool has_modified_energy)
    : promise_(std::move(promise)), has_modified_energy_(has_modified_energy) {}

void EnergyBook::add(const EnergyReading& reading, double t, std::int64_t n) {
  if (empty_) {
    energy_ = {.initial = reading.H, .final = reading.H, .max_increase = 0.0};
    modified_ = {.initial = reading.modified, .final = reading.modified, .max_increase = 0.0};
    size_at_start_ = (has_modified_energy_ ? reading.modified_round_off : reading.round_off) / (50 * epsilon);
    empty_ = false;
  } else if (reopened_) {
    energy_.final = reading.H;
    modified_.final = reading.modified;
  } else {
    advance(energy_, reading.H - last_.H, reading.H, !has_increase_);
    advance(modified_, reading.modified - last_.modified, reading.modified, !has_increase_);
    has_increase_ = true;

    const double increase = has_modified_energy_ ? reading.modified - last_.modified : reading.H - last_.H;
    // Both ends of the difference carry round-off, so the larger counts.
    const double round_off = has_modified_energy_ ? std::max(reading.modified_round_off, last_.modified_round_off)
                                                  : std::max(reading.round_off, last_.round_off);
    const double allowed = round_off * static_cast<double>(n - last_n_);
    // Round-off that explains more than all there was at the start says that the numbers mean nothing any more, and no law holds.
    const double explained = std::min(allowed, size_at_start_);
    if (increase > explained && !first_violation_.found) first_violation_ = {t, increase, explained, true};
  }
  reopened_ = false;
  last_ = reading;
  last_n_ = n;
}

void EnergyBook::write_to(RunReport& report) const {
  report.energy = energy_;
  report.has_modified_energy = has_modified_energy_;
  report.modified = modified_;
  report.law_reason = promise_.reason;
  if (!promise_.promised) {
    report.law = LawVerdict::not_promised;
  } else if (!first_violation_.found) {
    report.law = LawVerdict::holds;
  } else {
    report.law = LawVerdict::violated;
    report.law_reason = fmt::format("the {} rose by {:.3g} up to t = {:.6g}, and round-off explains only {:.3g}",
                                    has_modified_energy_ ? "modified energy" : "energy H", first_violation_.increase,
                                    first_violation_.t, first_violation_.allowed);
  }
}

}  // namespace seiche
