#include <paper/findings.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace seiche {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

bool good(const StudyRow& row) { return row.failure.empty() && row.error > 0 && std::isfinite(row.error); }

struct Line {
  double intercept, slope;
  double at(double x) const { return intercept + slope * x; }
};

std::optional<Line> least_squares(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i];
    sy += y[i];
    sxx += x[i] * x[i];
    sxy += x[i] * y[i];
  }
  const double determinant = n * sxx - sx * sx;
  if (x.size() < 2 || determinant <= 1e-12 * n * sxx) return {};
  const double slope = (n * sxy - sx * sy) / determinant;
  return Line{(sy - slope * sx) / n, slope};
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += std::log(v);
  return std::exp(sum / static_cast<double>(values.size()));
}

std::vector<double> good_errors(Rows rows, const std::string& method) {
  std::vector<double> errors;
  for (const StudyRow* row : rows_of(rows, method))
    if (good(*row) && row->cpu_seconds > 0) errors.push_back(row->error);
  return errors;
}

Finding not_measured(const std::string& what) { return {Outcome::depends, what + " was not measured", ""}; }

std::string joined(const std::vector<std::string>& parts, const char* separator) {
  std::string text;
  for (const std::string& part : parts) {
    if (part.empty()) continue;
    if (!text.empty()) text += separator;
    text += part;
  }
  return text;
}

// The pairs' ratios slow/fast as text: the nearest, and those on the wrong side.
struct Judged {
  std::string first, second;
  double ratio;
};

Finding judge_pairs(std::vector<Judged> judged, double factor, Quantifier quantifier, const char* what) {
  if (judged.empty()) return not_measured(what);
  std::sort(judged.begin(), judged.end(), [](const Judged& a, const Judged& b) { return a.ratio < b.ratio; });
  const auto right = std::count_if(judged.begin(), judged.end(), [&](const Judged& j) { return j.ratio >= factor; });
  const Judged& nearest = judged.front();
  Finding finding;
  finding.measured = fmt::format("{}: {} of {} pairs by ≥ {:g}; nearest {}/{} = {:.2f}", what, right, judged.size(),
                                 factor, nearest.second, nearest.first, nearest.ratio);
  if (judged.size() > 1) {
    finding.measured +=
        fmt::format(", farthest {}/{} = {:.3g}", judged.back().second, judged.back().first, judged.back().ratio);
  }
  if (nearest.ratio >= factor) {
    finding.outcome = Outcome::holds;
  } else if (quantifier == Quantifier::every ? nearest.ratio > 1 / clear_ratio : 2 * right >= std::ssize(judged)) {
    finding.outcome = Outcome::depends;
  } else {
    finding.outcome = Outcome::does_not_hold;
  }
  std::vector<std::string> against;
  for (const Judged& j : judged) {
    if (j.ratio < factor) against.push_back(fmt::format("{} against {} ({:.2f})", j.first, j.second, j.ratio));
  }
  if (against.size() > 4) {
    const std::size_t more = against.size() - 4;
    against.resize(4);
    against.push_back(fmt::format("and {} more", more));
  }
  if (!against.empty()) finding.remark = "Not for " + joined(against, ", ") + ".";
  return finding;
}

}  // namespace

std::vector<const StudyRow*> rows_of(Rows rows, const std::string& method) {
  std::vector<const StudyRow*> own;
  for (const StudyRow& row : rows)
    if (row.method == method) own.push_back(&row);
  return own;
}

std::optional<double> observed_order(Rows rows, const std::string& method) {
  std::vector<double> x, y;
  for (const StudyRow* row : rows_of(rows, method)) {
    if (!good(*row)) continue;
    x.push_back(std::log(row->h));
    y.push_back(std::log(row->error));
  }
  const std::optional<Line> line = least_squares(x, y);
  return line ? std::optional(line->slope) : std::nullopt;
}

std::optional<double> seconds_to_reach(Rows rows, const std::string& method, double error) {
  std::vector<double> x, y;
  for (const StudyRow* row : rows_of(rows, method)) {
    if (!good(*row) || row->cpu_seconds <= 0) continue;
    x.push_back(std::log(row->error));
    y.push_back(std::log(row->cpu_seconds));
  }
  const std::optional<Line> line = least_squares(x, y);
  if (!line || line->slope >= 0) return {};  // smaller errors must cost more, else the line tells nothing
  return std::exp(line->at(std::log(error)));
}

std::optional<double> speed_ratio(Rows rows, const std::string& slow, const std::string& fast) {
  const std::vector<double> a = good_errors(rows, slow);
  const std::vector<double> b = good_errors(rows, fast);
  if (a.empty() || b.empty()) return {};
  const double error = std::sqrt(geometric_mean(a) * geometric_mean(b));
  const std::optional<double> time_slow = seconds_to_reach(rows, slow, error);
  const std::optional<double> time_fast = seconds_to_reach(rows, fast, error);
  if (!time_slow || !time_fast) return {};
  return *time_slow / *time_fast;
}

double error_of(const StudyRow& row) { return row.error; }
double energy_error_of(const StudyRow& row) { return row.energy_error; }
double cpu_of(const StudyRow& row) { return row.cpu_seconds; }

std::optional<Ratio> ratio(Rows rows_a, const std::string& a, Rows rows_b, const std::string& b, Value value) {
  std::vector<double> ratios;
  for (const StudyRow* row_a : rows_of(rows_a, a)) {
    for (const StudyRow* row_b : rows_of(rows_b, b)) {
      if (row_a->h != row_b->h || !good(*row_a) || !good(*row_b)) continue;
      if (value(*row_a) > 0 && value(*row_b) > 0) ratios.push_back(value(*row_a) / value(*row_b));
    }
  }
  if (ratios.empty()) return {};
  return Ratio{geometric_mean(ratios), *std::min_element(ratios.begin(), ratios.end()),
               *std::max_element(ratios.begin(), ratios.end())};
}

Finding all_of_order_two(Rows rows, const Names& methods) {
  std::vector<std::string> texts, off;
  for (const std::string& method : methods) {
    const std::optional<double> order = observed_order(rows, method);
    texts.push_back(order ? fmt::format("{} {:.2f}", method, *order) : fmt::format("{} –", method));
    const bool reached_end = std::all_of(rows.begin(), rows.end(), [&](const StudyRow& row) {
      return row.method != method || row.failure.empty();
    });
    if (!order || !reached_end || std::abs(*order - 2) > order_tolerance) off.push_back(method);
  }
  Finding finding{Outcome::holds, "slopes " + joined(texts, ", "), ""};
  if (!off.empty()) {
    finding.outcome = 2 * off.size() <= methods.size() ? Outcome::depends : Outcome::does_not_hold;
    finding.remark = fmt::format("Not within 2 ± {:g}: {}.", order_tolerance, joined(off, ", "));
  }
  return finding;
}

Finding more_accurate(Rows rows, const Names& better, const Names& worse) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  std::vector<std::string> against;
  for (const std::string& a : better) {
    for (const std::string& b : worse) {
      const std::optional<Ratio> r = ratio(rows, b, rows, a, error_of);
      if (!r) return not_measured(fmt::format("{} against {}", a, b));
      smallest = std::min(smallest, r->smallest);
      largest = std::max(largest, r->largest);
      if (r->smallest <= 1) against.push_back(fmt::format("{} against {}", a, b));
    }
  }
  Finding finding{Outcome::holds,
                  fmt::format("errors of {} are {:.3g} to {:.3g} times smaller", joined(better, ", "), smallest,
                              largest),
                  ""};
  if (!against.empty()) {
    finding.outcome = against.size() < better.size() * worse.size() ? Outcome::depends : Outcome::does_not_hold;
    finding.remark = "Not at every h for " + joined(against, ", ") + ".";
  }
  return finding;
}

Finding smaller(Rows rows, const std::string& a, const std::string& b, Value value, const char* unit) {
  const std::optional<Ratio> r = ratio(rows, a, rows, b, value);
  if (!r) return not_measured(unit);
  Finding finding{Outcome::does_not_hold,
                  fmt::format("{} {}/{} = {:.3g} ({:.3g} … {:.3g} over the step sizes)", unit, a, b, r->mean,
                              r->smallest, r->largest),
                  ""};
  if (r->largest <= 1 / clear_ratio) {
    finding.outcome = Outcome::holds;
  } else if (r->mean < clear_ratio) {
    finding.outcome = Outcome::depends;
    finding.remark = fmt::format("Nearer than {:g}, or not at every h.", clear_ratio);
  }
  return finding;
}

Finding larger_by(Rows rows, const std::string& big, const std::string& small, Value value, double factor,
                  const char* unit) {
  const std::optional<Ratio> r = ratio(rows, big, rows, small, value);
  if (!r) return not_measured(unit);
  Finding finding{Outcome::does_not_hold, fmt::format("{} {}/{} = {:.3g}", unit, big, small, r->mean), ""};
  if (r->mean >= factor) {
    finding.outcome = Outcome::holds;
  } else if (r->mean > 1 / clear_ratio) {
    finding.outcome = Outcome::depends;
    finding.remark = fmt::format("Less than the factor {:g} that is asked for.", factor);
  }
  return finding;
}

Finding comparable(Rows rows, const Names& methods, Value value, double factor, const char* unit) {
  double largest = 1;
  std::vector<std::string> texts;
  for (const std::string& method : methods) {
    const std::optional<Ratio> r = ratio(rows, method, rows, methods.front(), value);
    if (!r) return not_measured(unit);
    texts.push_back(fmt::format("{} {:.3g}", method, r->mean));
    for (const std::string& other : methods) {
      if (const std::optional<Ratio> pair = ratio(rows, method, rows, other, value)) {
        largest = std::max(largest, pair->mean);
      }
    }
  }
  return {largest <= factor       ? Outcome::holds
          : largest <= 2 * factor ? Outcome::depends
                                  : Outcome::does_not_hold,
          fmt::format("{} relative to {}: {}", unit, methods.front(), joined(texts, ", ")),
          largest <= factor ? "" : fmt::format("Farther apart than a factor {:g}.", factor)};
}

// A pair that could not be compared leaves the claim open at best.
Finding with_missing(Finding finding, const std::vector<std::string>& missing) {
  if (missing.empty()) return finding;
  if (finding.outcome == Outcome::holds) finding.outcome = Outcome::depends;
  finding.remark += fmt::format("{}Not measured: {}.", finding.remark.empty() ? "" : " ", joined(missing, ", "));
  return finding;
}

Finding cheaper(Rows rows, const Pairs& cheap_and_dear) {
  std::vector<std::string> missing;
  std::vector<Judged> judged;
  for (const auto& [cheap, dear] : cheap_and_dear) {
    const std::optional<Ratio> r = ratio(rows, dear, rows, cheap, cpu_of);
    r ? judged.push_back({cheap, dear, r->mean}) : missing.push_back(fmt::format("{}/{}", cheap, dear));
  }
  return with_missing(judge_pairs(std::move(judged), clear_ratio, Quantifier::most, "CPU time at equal h"), missing);
}

Finding more_efficient(Rows rows, const Pairs& fast_and_slow, double factor, Quantifier quantifier) {
  std::vector<std::string> missing;
  std::vector<Judged> judged;
  for (const auto& [fast, slow] : fast_and_slow) {
    const std::optional<double> r = speed_ratio(rows, slow, fast);
    r ? judged.push_back({fast, slow, *r}) : missing.push_back(fmt::format("{}/{}", fast, slow));
  }
  return with_missing(judge_pairs(std::move(judged), factor, quantifier, "CPU time to equal error"), missing);
}

Finding monotone(Rows rows, double initial_energy) {
  const double allowed = rise_tolerance * std::abs(initial_energy);
  double largest = -std::numeric_limits<double>::infinity();
  std::vector<std::string> rising, failed;
  for (const StudyRow& row : rows) {
    largest = std::max(largest, row.max_energy_increase);
    if (row.max_energy_increase > allowed) rising.push_back(fmt::format("{} at h = {:g}", row.method, row.h));
    if (!row.failure.empty()) failed.push_back(row.method);
  }
  if (rows.empty()) return not_measured("the energy");
  Finding finding{Outcome::holds,
                  fmt::format("largest change of H in a step, over {} runs: {:.2e}", rows.size(), largest), ""};
  if (rising.empty() && failed.empty()) return finding;
  finding.outcome = 2 * (rising.size() + failed.size()) <= rows.size() ? Outcome::depends : Outcome::does_not_hold;
  if (!rising.empty()) finding.remark = "H rises: " + joined(rising, ", ") + ".";
  if (!failed.empty()) finding.remark += "Stopped early: " + joined(failed, ", ") + ".";
  return finding;
}

Finding combined(std::vector<Finding> findings) {
  Finding result{Outcome::holds, "", ""};
  std::vector<std::string> measured, remarks;
  for (Finding& finding : findings) {
    if (finding.outcome == Outcome::does_not_hold) result.outcome = Outcome::does_not_hold;
    if (finding.outcome == Outcome::depends && result.outcome == Outcome::holds) result.outcome = Outcome::depends;
    measured.push_back(std::move(finding.measured));
    remarks.push_back(std::move(finding.remark));
  }
  result.measured = joined(measured, "; ");
  result.remark = joined(remarks, " ");
  return result;
}

Pairs all_pairs(const Names& first, const Names& second) {
  Pairs pairs;
  for (const std::string& a : first) {
    for (const std::string& b : second) {
      if (a != b) pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

}  // namespace seiche
