#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/output/csv_table.hpp>
#include <seiche/study/energy_history.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace seiche {
namespace {

bool is_constant(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end();
}

// A curve that halves itself: of each stretch of rows its extremes are kept, and stretches double when there are too
// many.
class Extremes {
 public:
  void add(double t, double value) {
    if (count_ == 0) low_ = high_ = {t, value};
    if (value < low_.value) low_ = {t, value};
    if (value > high_.value) high_ = {t, value};
    last_ = {t, value};
    if (++count_ < stretch_) return;
    close();
    constexpr std::size_t most = 4000;
    if (points_.size() >= most) halve();
  }

  Curve curve(std::string name) {
    if (count_ > 0) close();
    Curve curve{std::move(name), {}, {}};
    if (!points_.empty() && points_.back().t != last_.t) points_.push_back(last_);
    for (const Point& point : points_) {
      curve.t.push_back(point.t);
      curve.value.push_back(point.value);
    }
    return curve;
  }

 private:
  struct Point {
    double t = 0, value = 0;
  };

  void close() {
    const bool low_first = low_.t <= high_.t;
    points_.push_back(low_first ? low_ : high_);
    if (low_.t != high_.t) points_.push_back(low_first ? high_ : low_);
    count_ = 0;
  }

  // Of four points the smallest and the largest.
  void halve() {
    std::vector<Point> kept = {points_.front()};  // where the eye compares
    for (std::size_t i = 1; i < points_.size(); i += 4) {
      const auto end = points_.begin() + static_cast<std::ptrdiff_t>(std::min(i + 4, points_.size()));
      const auto [low, high] = std::minmax_element(points_.begin() + static_cast<std::ptrdiff_t>(i), end,
                                                   [](const Point& a, const Point& b) { return a.value < b.value; });
      kept.push_back(low->t <= high->t ? *low : *high);
      if (low != high) kept.push_back(low->t <= high->t ? *high : *low);
    }
    points_ = std::move(kept);
    stretch_ *= 2;
  }

  std::vector<Point> points_;
  Point low_, high_, last_;
  std::size_t stretch_ = 1, count_ = 0;
};

}  // namespace

EnergyHistory read_energy_history(const std::filesystem::path& file, std::uintmax_t bytes) {
  CsvReader reader(file, bytes);
  const std::vector<std::string>& names = reader.names();
  if (names.size() < 2 || names[0] != "t" || names[1] != "H")
    throw Error("{} is no table of energies: it begins with '{}'", file.string(),
                shortened(fmt::format("{}", fmt::join(names, ",")), 40));

  const std::size_t first_cause = names.size() > 2 && names[2] == "H_modified" ? 3 : 2;
  std::vector<Extremes> curves(names.size());
  std::vector<double> row, sums(names.size(), 0.0);
  EnergyHistory history;
  while (reader.next(row)) {
    ++history.rows;
    for (std::size_t i = 1; i < row.size(); ++i) {
      sums[i] = i < first_cause ? row[i] : sums[i] + row[i];
      curves[i].add(row[0], sums[i]);
    }
  }
  history.H = curves[1].curve("H");
  if (first_cause == 3) history.modified = curves[2].curve("H_modified");
  for (std::size_t i = first_cause; i < names.size(); ++i) history.causes.push_back(curves[i].curve(names[i]));
  return history;
}

std::string cause_label(const EnergyHistory& history, const std::string& column) {
  static const std::array<std::pair<std::string, std::string>, 9> labels = {
      {{"work", "work of forces"},
       {"damping_left", "damping, half step before the Hamiltonian step"},
       {"substep", "dissipation of S"},
       {"scalar", "scalar equation"},
       {"auxiliary", "auxiliary variable"},
       {"projection", "projection"},
       {"damping_right", "damping, half step after the Hamiltonian step"},
       {"heat", "noise"},
       {"round_off", "round-off"}}};
  const auto second = std::find_if(history.causes.begin(), history.causes.end(),
                                   [](const Curve& cause) { return cause.name == "damping_right"; });
  if (column == "damping_left" && second != history.causes.end() && is_constant(second->value)) return "damping";
  for (const auto& [name, label] : labels)
    if (name == column) return label;
  return column;
}

}  // namespace seiche
