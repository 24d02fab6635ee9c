// How a kind of claim is decided from measured rows: thresholds are named here, numbers come back as text.
#pragma once

#include <paper/results.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace seiche {

struct Finding {
  Outcome outcome = Outcome::depends;
  std::string measured;
  std::string remark = {};
};

using Rows = std::span<const StudyRow>;
using Names = std::vector<std::string>;

inline constexpr double order_tolerance = 0.15;  // |slope − 2| of a second-order method
inline constexpr double clear_ratio = 1.1;       // times and errors nearer than this are called equal
inline constexpr double rise_tolerance = 1e-13;  // of H in one step, relative to |H(z₀)|: round-off

std::vector<const StudyRow*> rows_of(Rows rows, const std::string& method);
// Least-squares slope of log error against log h; nothing with fewer than two good runs.
std::optional<double> observed_order(Rows rows, const std::string& method);
// CPU time to reach an error, from the least-squares line of log time against log error.
std::optional<double> seconds_to_reach(Rows rows, const std::string& method, double error);
// Time of `slow` over time of `fast` at one error in the middle of both their errors.
std::optional<double> speed_ratio(Rows rows, const std::string& slow, const std::string& fast);
// Geometric mean over the step sizes of value(a)/value(b), and its extremes.
struct Ratio {
  double mean = 0, smallest = 0, largest = 0;
};
using Value = double (*)(const StudyRow&);
double error_of(const StudyRow& row);
double energy_error_of(const StudyRow& row);
double cpu_of(const StudyRow& row);
std::optional<Ratio> ratio(Rows rows_a, const std::string& a, Rows rows_b, const std::string& b, Value value);

// ---- Claims

Finding all_of_order_two(Rows rows, const Names& methods);
// Every `better` has the smaller error than every `worse` at every step size.
Finding more_accurate(Rows rows, const Names& better, const Names& worse);
// value(a) < value(b) at every step size, by clear_ratio; the mean decides between depends and does_not_hold.
Finding smaller(Rows rows, const std::string& a, const std::string& b, Value value, const char* unit);
// Mean value(big)/value(small) at least `factor`.
Finding larger_by(Rows rows, const std::string& big, const std::string& small, Value value, double factor,
                  const char* unit);
// The largest over the smallest mean value among `methods` is at most `factor`.
Finding comparable(Rows rows, const Names& methods, Value value, double factor, const char* unit);
// At equal h every pair (cheap, dear) costs less by clear_ratio; depends if only some pairs do.
Finding cheaper(Rows rows, const std::vector<std::pair<std::string, std::string>>& cheap_and_dear);
// At equal error every pair (fast, slow) reaches it sooner by `factor`. `every`: one pair that is clearly reversed
// refutes the claim; `most`: it depends as long as half of the pairs hold.
enum class Quantifier { every, most };
Finding more_efficient(Rows rows, const std::vector<std::pair<std::string, std::string>>& fast_and_slow,
                       double factor = clear_ratio, Quantifier quantifier = Quantifier::every);
// H falls at every step of every run, but for rise_tolerance.
Finding monotone(Rows rows, double initial_energy);

// One finding out of several: the worst outcome, all texts.
Finding combined(std::vector<Finding> findings);

std::vector<std::pair<std::string, std::string>> all_pairs(const Names& first, const Names& second);

}  // namespace seiche
