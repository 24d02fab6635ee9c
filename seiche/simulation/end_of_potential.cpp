#include <seiche/core/text/axis_names.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/simulation/end_of_potential.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>
#include <vector>

namespace seiche {
namespace {

constexpr int halvings = 40;  // of the way to where V ends

// The values that V depends on, on the line u + s du.
class Line {
 public:
  Line(const Problem& problem, const System& system, const Vector& initial, const State& s)
      : problem_(problem),
        space_(*system.space),
        begin_(problem.potential_field * problem.grid.unknowns()),
        start_(initial.segment(begin_, problem.potential->fields() * problem.grid.unknowns())) {
    Vector dz(s.z.size());
    system.right_hand_side(s.t, s.z, dz);
    u_ = space_.physical(s.z).segment(begin_, start_.size());
    du_ = space_.physical(dz).segment(begin_, start_.size());
    is_endless_ = !space_.is_finite(du_);
    if (is_endless_) du_.setZero();  // V ends here already
    values_ = slopes_ = u_;
  }

  double tenth() const {
    const double speed = space_.norm_of_values(du_);
    return speed > 0 ? 0.1 * space_.norm_of_values(u_) / speed : 0;
  }
  // Further than a tenth of itself in the time s?
  bool runs_away(double s) const {
    return is_endless_ || s * space_.norm_of_values(du_) > 0.1 * space_.norm_of_values(u_);
  }
  Vector at(double s) const { return u_ + s * du_; }
  const Vector& start() const { return start_; }  // of the run

  // Whether V and ∇V are finite at s, as far as the values there are moderate.
  bool is_inside(double s) {
    constexpr double moderate = 1e50;  // beyond it the solution blows up, and V with it
    const Vector u = at(s);
    return !(space_.max_norm(u) < moderate) || is_finite(u);
  }

  // "V is not a finite number at q = -1.0003": of what is finite at `inside`, if anything is, and not at `outside`.
  std::string complaint(const Vector& inside, const Vector& outside) {
    const bool has_place = is_finite(inside);
    is_finite(outside);
    const char* what = std::isfinite(V_) ? "∇V" : "V";
    if (!has_place) return fmt::format("{} is not a finite number", what);
    // Next to where V ends between the two: of those values that have to go back for V to be finite, the last.
    Vector near = inside, far = outside;
    for (int k = 0; k < halvings; ++k) {
      Vector middle = near + (far - near) / 2;
      (is_finite(middle) ? near : far).swap(middle);
    }
    Index low = 0, high = outside.size();
    while (high - low > 1) {
      const Index middle = low + (high - low) / 2;
      Vector mixed = far;
      mixed.head(middle) = near.head(middle);
      (is_finite(mixed) ? high : low) = middle;
    }
    return fmt::format("{} is not a finite number at {}", what, named(outside, low));
  }

  // "… q = 3e+19 is 3e+19 times the largest value at the start: a blow-up …", or "" if it is no such thing.
  std::string blow_up() const {
    constexpr double grown = 1e6;
    const double size = space_.max_norm(u_), before = space_.max_norm(start_);
    if (!(before > 0 && size > grown * before)) return "";
    return fmt::format(
        "no end of V lies straight ahead, but {} is {:.2g} times the largest value at the start: a blow-up, of the "
        "solution or of the method",
        named(u_, largest(u_)), size / before);
  }

 private:
  bool is_finite(const Vector& u) {
    const auto span = [](Vector& v) { return std::span(v.data(), static_cast<std::size_t>(v.size())); };
    values_ = u;
    V_ = problem_.potential->value_and_gradient(span(values_), span(slopes_));
    return std::isfinite(V_) && space_.is_finite(slopes_);
  }

  static Index largest(const Vector& u) {
    return std::max_element(u.begin(), u.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) -
           u.begin();
  }

  // "q = -1 (x = 3, where s = 0)": a value, its point, and what else V depends on there.
  std::string named(const Vector& u, Index i) const {
    const Index points = problem_.grid.unknowns(), point = i % points;
    const auto value = [&](Index j) {
      return fmt::format("{} = {}", problem_.fields[static_cast<std::size_t>((begin_ + j) / points)],
                         number_text(u[j], 6));
    };
    std::vector<std::string> notes;
    if (problem_.grid.only_numbers && points > 1) notes.push_back(fmt::format("point {}", point + 1));
    for (Index a = 0; a < problem_.grid.dimension() && !problem_.grid.only_numbers && points > 1; ++a)
      notes.push_back(
          fmt::format("{} = {:.6g}", axis_names[static_cast<std::size_t>(a)], problem_.grid.coordinate(point, a)));
    const char* where = "where ";
    for (Index j = point; j < u.size(); j += points)
      if (j != i) notes.push_back(std::exchange(where, "") + value(j));
    return notes.empty() ? value(i) : fmt::format("{} ({})", value(i), fmt::join(notes, ", "));
  }

  const Problem& problem_;
  const Space& space_;
  Index begin_;
  double V_ = 0;
  bool is_endless_ = false;  // ż is not finite
  Vector start_, u_, du_, values_, slopes_;
};

std::string on_line(const Problem& problem, const System& system, const Vector& initial, const State& s, double h) {
  Line line(problem, system, initial, s);
  if (!line.is_inside(0)) return fmt::format("{} at t = {:.6g}", line.complaint(line.start(), line.at(0)), s.t);
  constexpr int parts = 64;
  const double reach = h > 0 ? 2 * h : line.tenth();
  double inside = 0, outside = 0;
  for (int k = 1; k <= parts && outside == inside; ++k) {
    outside = reach * k / parts;
    if (line.is_inside(outside)) inside = outside;
  }
  if (outside == inside) return line.runs_away(reach) ? line.blow_up() : "";
  for (int k = 0; k < halvings; ++k) {
    const double middle = inside + (outside - inside) / 2;
    (line.is_inside(middle) ? inside : outside) = middle;
  }
  return fmt::format("{}, straight ahead of t = {:.6g} at t ≈ {:.6g}",
                     line.complaint(line.at(inside), line.at(outside)), s.t, s.t + outside);
}

}  // namespace

std::string end_of_potential(const Problem& problem, const System& system, const Vector& initial, const State& s,
                             double h) {
  if (problem.grid.here.count > 1) return "";  // the line ahead is followed on one process alone
  if (!problem.potential || initial.size() != problem.size() || system.space->physical_size() != problem.size() ||
      !system.space->is_finite(s.z))
    return "";
  try {
    return on_line(problem, system, initial, s, h);
  } catch (const std::exception&) {  // of a function of the user's own, which has said it in the step
    return "";
  }
}

}  // namespace seiche
