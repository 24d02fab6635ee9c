#include <seiche/config/case/case_reading.hpp>
#include <seiche/config/case/key_readers.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/method/unknown_method.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace seiche {
namespace {

// How many steps of h > 0 the interval > 0 between snapshots takes. Throws Error, with the nearest number of steps,
// where it is no multiple of h: steps of one size come to no other times than theirs.
std::int64_t steps_between_snapshots(const std::string& key, const CaseValue& interval, double h) {
  constexpr double round_off = 1e-9;
  const double time = read_number(key, interval);
  const double every = std::max(1.0, std::round(time / h));
  if (std::abs(time - every * h) > round_off * time)
    throw Error("{} = {} is no multiple of h = {}: write snapshot_every = {}, for one every {}, or another h", key,
                interval.shown(), h, every, every * h);
  return static_cast<std::int64_t>(every);
}

}  // namespace

std::vector<std::string> or_auto(std::vector<std::string> names) {
  std::erase(names, "auto");
  names.emplace(names.begin(), "auto");
  return names;
}

double read_number_within(const KeyRow& row, const std::string& key, const CaseValue& value) {
  const double number = read_number(key, value);
  if (number < row.minimum || (row.minimum_excluded && number == row.minimum))
    throw Error("{} = {} must be {} {}", key, value.shown(), row.minimum_excluded ? ">" : "≥", row.minimum);
  return number;
}

long read_whole_within(const KeyRow& row, const std::string& key, const CaseValue& value) {
  const long number = read_whole(key, value, static_cast<long>(row.minimum));
  if (static_cast<double>(number) > row.maximum) throw Error("{} = {} must be ≤ {}", key, value.shown(), row.maximum);
  return number;
}

void read_option(CaseReading& r, const std::string& key, const CaseValue& value,
                 const std::function<void(MethodOptions&)>& set) {
  MethodOptions alone;
  set(alone);
  if (!r.methods.empty()) {
    std::optional<Error> first;
    const bool is_known = std::any_of(r.methods.begin(), r.methods.end(), [&](const std::string& name) {
      try {
        alone.validate(find_method(name));
        return true;
      } catch (const Error& error) {
        if (!first) first = error;
        return false;
      }
    });
    if (!is_known) throw Error(*first);
  } else if (r.spec.method == "auto" && alone != MethodOptions{}) {
    throw Error(
        "{} = {} belongs to one method, and method.name = \"auto\" is yet to choose it: leave it out, or name a "
        "method",
        key, value.shown());
  } else if (r.spec.method != "auto" && !r.spec.method.empty()) {
    alone.validate(find_method(r.spec.method));
  }
  set(r.spec.method_options);
}

void read_method(CaseReading& r, const KeyRow&, const std::string&, const CaseValue& value) {
  r.spec.method.clear();  // also after a complaint, so that options are not compared with another one
  std::vector<std::string> names = method_names();
  names.emplace_back("auto");
  const std::string name = read_text("method", value);
  if (std::find(names.begin(), names.end(), name) == names.end()) throw unknown_method(name, names);
  r.spec.method = name;
}

void read_step_size(CaseReading& r, const KeyRow& row, const std::string& key, const CaseValue& value) {
  const RunSpec& spec = r.spec;
  const double h = read_number_within(row, key, value);
  if (r.problem == nullptr && spec.duration() == 0) return;
  if (h > spec.duration())
    throw Error("{} = {} must be ≤ {}", key, value.shown(),
                spec.t_start == 0 ? fmt::format("time.end = {}", spec.t_end)
                                  : fmt::format("{}, the time from time.start to time.end", spec.duration()));
  if (spec.duration() / h > 1e15)
    throw Error("{} = {} would take {:.3g} steps", key, value.shown(), spec.duration() / h);
  r.spec.h = h;
}

void read_tolerance(CaseReading& r, const KeyRow& row, const std::string& key, const CaseValue& value) {
  r.spec.tolerance = read_number_within(row, key, value);
}

void read_h_max(CaseReading& r, const KeyRow& row, const std::string& key, const CaseValue& value) {
  const double h = read_number_within(row, key, value);
  if (!r.asks_for_tolerance())
    throw Error("{} = {} needs method.tolerance: it bounds steps of variable size", key, value.shown());
  r.spec.h_max = h;
}

void read_shift(CaseReading& r, const KeyRow&, const std::string& key, const CaseValue& value) {
  if (value.kind == CaseValue::Kind::text && value.text == "auto") return;
  if (value.kind != CaseValue::Kind::number && value.kind != CaseValue::Kind::text)
    throw Error("{} = {} must be a number or \"auto\"", key, value.shown());
  const double C = read_number(key, value);
  read_option(r, key, value, [C](MethodOptions& options) { options.C = C; });
}

void read_start(CaseReading& r, const KeyRow&, const std::string& key, const CaseValue& value) {
  const double start = read_number(key, value);
  // Hypotheses of the energy law are looked at from t = 0 on.
  if (start < 0)
    throw Error("{} = {} must be ≥ 0: rather shift the formulas in t, so that the run begins at 0", key, value.shown());
  r.spec.t_start = start;
}

void read_end(CaseReading& r, const KeyRow&, const std::string& key, const CaseValue& value) {
  const double end = read_number(key, value);
  if (end <= r.spec.t_start)
    throw Error("{} = {} must be > {}", key, value.shown(),
                r.spec.t_start == 0 ? "0" : fmt::format("time.start = {}", r.spec.t_start));
  r.spec.t_end = end;
}

void read_backend(CaseReading& r, const KeyRow&, const std::string&, const CaseValue& value) {
  r.spec.backend = read_name("backend", value, or_auto(backend_names()));
}

void read_directory(CaseReading& r, const KeyRow&, const std::string& key, const CaseValue& value) {
  r.spec.output_directory = read_text(key, value);
  if (r.spec.output_directory.empty()) throw Error("{} must not be empty", key);
}

void read_snapshot_interval(CaseReading& r, const KeyRow& row, const std::string& key, const CaseValue& value) {
  RunSpec& spec = r.spec;
  const double interval = read_number_within(row, key, value);
  if (interval > 0 && spec.duration() / interval > 1e7)
    throw Error("{} = {} would make {:.3g} snapshots", key, value.shown(), spec.duration() / interval);
  if (const CaseValue* every = r.table.value("output", "snapshot_every");
      every != nullptr && interval > 0 && spec.snapshot_every > 0) {
    const auto is_override = [](const CaseValue& one) { return one.place.starts_with("--set"); };
    if (is_override(*every) && !is_override(value)) return;  // of the two, the one that was given for this run
    if (is_override(*every) == is_override(value) && !r.asks_for_tolerance())
      throw Error("{} = {} and snapshot_every = {} are both given: snapshots are taken by the one or by the other", key,
                  value.shown(), spec.snapshot_every);
    if (!is_override(value))
      spec.notes.push_back(fmt::format("snapshots are taken by {}: snapshot_every has no effect", key));
  }
  if (interval == 0 || r.asks_for_tolerance()) {
    spec.snapshot_interval = interval;
  } else if (spec.h > 0) {
    spec.snapshot_every = steps_between_snapshots(key, value, spec.h);
  }
}

void read_join_below(CaseReading& r, const KeyRow& row, const std::string& key, const CaseValue& value) {
  r.spec.join_below = read_number_within(row, key, value);
}

void read_every_seconds(CaseReading& r, const KeyRow& row, const std::string& key, const CaseValue& value) {
  r.spec.checkpoint.every_seconds = read_number_within(row, key, value);
}

}  // namespace seiche
