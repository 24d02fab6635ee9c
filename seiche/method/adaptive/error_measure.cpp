#include <seiche/method/adaptive/error_measure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

constexpr double counted = 4;

}  // namespace

ErrorMeasure::ErrorMeasure(const System& system, const PhiEvaluator* phi)
    : system_(system),
      phi_(phi),
      is_gradient_flow_(is_gradient_flow(system)),
      forgetting_(cached_step_sizes(system.space->size_of_all())),
      physical_(system.space->physical_size()) {
  if (is_gradient_flow_) sum_.setZero(system.space->size());
}

void ErrorMeasure::start(const Vector& before, const Vector& after, double h) {
  if (!is_gradient_flow_) return;
  constexpr double least = 1e-3;  // of a solution that hardly moves
  const Space& space = *system_.space;
  const double share = space.norm(after - before) / std::max(space.norm(before), space.norm(after));
  moved_ = std::isfinite(share) ? std::clamp(share, least, 1.0) : 1.0;
  h_ = h;
  most_ = counted * h * (1 + 1 / moved_);
  round_off_ = 8 * epsilon * space.norm(after);
}

double ErrorMeasure::operator()(const Vector& e) {
  const Space& space = *system_.space;
  if (is_gradient_flow_) {
    // By powers of two, so that few maps are made. A Krylov space would take long over so long a time.
    const double steps = phi_->has_tables() ? std::exp2(std::round(-0.75 * std::log2(moved_))) : 1;
    const double time = h_ * steps;
    const PhiMap& map =
        forgetting_.at(time, [&] { return phi_->map(rows_of_constant_force(PhiRows::Forces::states), time); });
    map.apply(e, {&e, 1}, {&sum_, 1});
    const double size = space.norm(e);
    if (space.norm(sum_) > time * size) sum_ = time * e;  // an L that lets errors grow forgets none
    const double beyond_round_off = size > round_off_ ? 1 - round_off_ / size : 0;
    sum_ = beyond_round_off * counted * h_ * (e + sum_ / (moved_ * time));
    space.to_physical(sum_, physical_);
  } else {
    space.to_physical(e, physical_);
  }
  return space.is_finite(physical_) ? space.max_norm(physical_) : std::numeric_limits<double>::infinity();
}

}  // namespace seiche
