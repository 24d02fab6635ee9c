#include <seiche/core/text/number_text.hpp>
#include <seiche/simulation/end_of_potential.hpp>

#include <fmt/format.h>

#include <cmath>
#include <exception>

namespace seiche {
namespace {

std::string place_text(const Grid& grid, Index point) {
  if (grid.unknowns() == 1) return "";
  if (grid.only_numbers) return fmt::format(" (point {})", point + 1);
  std::string text;
  for (Index a = 0; a < grid.dimension(); ++a)
    text += fmt::format("{}{} = {:.6g}", a == 0 ? " (" : ", ", "xyz"[a], grid.coordinate(point, a));
  return text + ")";
}

// The values that V depends on, on the line u + s du.
class Line {
 public:
  Line(const Problem& problem, const System& system, const State& s)
      : problem_(problem), space_(*system.space), begin_(problem.potential_field * problem.grid.unknowns()) {
    const Index size = problem.potential->fields() * problem.grid.unknowns();
    Vector dz(s.z.size());
    system.right_hand_side(s.t, s.z, dz);
    u_ = system.space->physical(s.z).segment(begin_, size);
    du_ = system.space->physical(dz).segment(begin_, size);
    if (!space_.is_finite(du_)) du_.setZero();  // V ends here already
    values_ = slopes_ = u_;
  }

  double tenth() const {
    const double speed = space_.norm(du_);
    return speed > 0 ? 0.1 * space_.norm(u_) / speed : 0;
  }

  // Whether V and ∇V are finite at s, as far as the values there are moderate.
  bool is_inside(double s) {
    constexpr double moderate = 1e50;  // beyond it the solution blows up, and V with it
    values_ = u_ + s * du_;
    return !(space_.max_norm(values_) < moderate) || is_finite();
  }

  // "V is not a finite number at q = -1.0003": of what is finite at `inside` and not at `outside`.
  std::string complaint(double inside, double outside) {
    is_inside(outside);
    const char* what = std::isfinite(V_) ? "∇V" : "V";
    const Vector there = values_;
    // Of those values that have to go back to where they were inside for V to be finite, the last.
    Index low = 0, high = there.size();
    while (high - low > 1) {
      const Index middle = low + (high - low) / 2;
      values_ = there;
      values_.head(middle) = u_.head(middle) + inside * du_.head(middle);
      (is_finite() ? high : low) = middle;
    }
    const Index points = problem_.grid.unknowns(), field = (begin_ + low) / points;
    return fmt::format("{} is not a finite number at {} = {}{}", what, problem_.fields[static_cast<std::size_t>(field)],
                       number_text(there[low], 6), place_text(problem_.grid, low % points));
  }

 private:
  bool is_finite() {
    const auto span = [](Vector& v) { return std::span(v.data(), static_cast<std::size_t>(v.size())); };
    V_ = problem_.potential->value_and_gradient(span(values_), span(slopes_));
    return std::isfinite(V_) && space_.is_finite(slopes_);
  }

  const Problem& problem_;
  const Space& space_;
  Index begin_;
  double V_ = 0;
  Vector u_, du_, values_, slopes_;
};

std::string on_line(const Problem& problem, const System& system, const State& s, double h) {
  Line line(problem, system, s);
  if (!line.is_inside(0)) return fmt::format("V or ∇V is not a finite number at t = {:.6g}", s.t);
  constexpr int parts = 64, halvings = 40;
  const double reach = h > 0 ? 2 * h : line.tenth();
  double inside = 0, outside = 0;
  for (int k = 1; k <= parts && outside == inside; ++k) {
    outside = reach * k / parts;
    if (line.is_inside(outside)) inside = outside;
  }
  if (outside == inside) return "";
  for (int k = 0; k < halvings; ++k) {
    const double middle = inside + (outside - inside) / 2;
    (line.is_inside(middle) ? inside : outside) = middle;
  }
  return fmt::format("{}, straight ahead of t = {:.6g} at t ≈ {:.6g}", line.complaint(inside, outside), s.t,
                     s.t + outside);
}

}  // namespace

std::string end_of_potential(const Problem& problem, const System& system, const State& s, double h) {
  if (!problem.potential || !system.space->is_finite(s.z)) return "";
  try {
    return on_line(problem, system, s, h);
  } catch (const std::exception&) {  // of a function of the user's own, which has said it in the step
    return "";
  }
}

}  // namespace seiche
