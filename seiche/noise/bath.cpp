#include <seiche/core/base/error.hpp>
#include <seiche/core/commuting_damping.hpp>
#include <seiche/noise/bath.hpp>

#include <cmath>
#include <string>
#include <utility>

namespace seiche {
namespace {

// Of a system that is left without.
class NoDamping final : public Damping {
 public:
  bool is_zero() const override { return true; }
  bool touches_potential() const override { return false; }
  void flow(double, double, Vector&) const override {}
  void apply(double, const Vector&, Vector& out) const override { out.setZero(); }
  bool is_constant() const override { return true; }
  void apply_rest(double, const Vector&, Vector& out) const override { out.setZero(); }
  void apply_D0(const Vector&, Vector& out) const override { out.setZero(); }
  double largest_rate(const Space&, double, double, const Vector&, const Vector&) const override { return 0; }
};

}  // namespace

Bath::Bath(System& system, const Problem& problem, const Noise& noise)
    : noise_(noise),
      space_(*system.space),
      make_map_(system.make_noise),
      is_damped_(problem.has_damping()),
      by_map_(problem.has_constant_damping() || !is_damped_),
      rates_change_(!has_constant_rates(problem.damping)),
      maps_(cached_step_sizes(system.space->size_of_all())),
      numbers_(system.space->physical_size()),
      kick_(system.space->size()) {
  if (!(noise.temperature >= 0) || !std::isfinite(noise.temperature))
    throw Error("the temperature {} of noise must be ≥ 0", noise.temperature);
  require_balance(system, problem);
  by_map_ ? require_map() : set_variances(problem);
  damping_ = std::exchange(system.damping, std::make_unique<NoDamping>());
  system.make_phi = system.make_undamped_phi;
}

void Bath::require_balance(const System& system, const Problem& problem) const {
  if (problem.friction)
    throw Error("noise balances a damping Dz alone, and {} has the friction {}", problem.name,
                problem.friction->text());
  if (problem.structure)
    throw Error("noise needs one matrix S, and in {} it is {}", problem.name, problem.structure->text());
  if (!is_damped_) {
    if (!is_gradient_flow(system))
      throw Error(
          "noise needs what dissipates, or it would heat {} without end: a damping of momenta, or S = Sᵀ ⪯ 0; write gamma "
          "> 0 in [problem], or temperature = 0",
          problem.name);
  } else {
    if (problem.damping_moves_potential())
      throw Error(
          "noise balances a damping of momenta, Dz = R∇H, and that of {} moves what V depends on; write temperature = 0",
          problem.name);
    if (!is_skew(system)) throw Error("noise beside a damping needs a skew S, and that of {} is not", problem.name);
    if (by_map_ && (rates_change_ || problem.damping.field_rate || !rate_commutes(problem)))
      throw Error("noise balances a constant D, or a rate γ(t) or γ(x, t), and {} has both; leave out one of the two",
                  problem.name);
  }
  if (by_map_ && !make_map_)
    throw Error("noise that couples points, as that of {}, is for the backends modal, dense and sparse", problem.name);
}

// What a map of the length 0 refuses, on every process.
void Bath::require_map() const {
  std::string complaint;
  try {
    make_map_(0);
  } catch (const Error& error) {
    complaint = error.what();
  }
  if (space_.any(!complaint.empty()))
    throw Error("{}", complaint.empty() ? "no noise balances what dissipates on another process" : complaint);
}

// Where γ acts, ∂H/∂p = Mp with a number M of each unknown.
void Bath::set_variances(const Problem& problem) {
  const Index n = problem.grid.unknowns();
  variances_.setZero(problem.size());
  const auto refuse = [&](Index field) {
    throw Error("noise needs Dz = R∇H, and M of {} is not diagonal on the damped field {}", problem.name,
                problem.fields[static_cast<std::size_t>(field)]);
  };
  for (Index f = 0; f < problem.field_count(); ++f) {
    if (!problem.damping.rate_fields[static_cast<std::size_t>(f)]) continue;
    if (problem.matrices) {
      variances_.segment(f * n, n) =
          noise_.temperature * problem.matrices->M.diagonal().segment(f * n, n).cwiseInverse();
      continue;
    }
    const std::optional<double> mass = problem.M(f, f).factor_of_identity();
    if (!mass || !(*mass > 0)) refuse(f);
    for (Index j = 0; j < problem.field_count(); ++j)
      if (j != f && !problem.M(f, j).is_zero()) refuse(f);
    variances_.segment(f * n, n).setConstant(noise_.temperature / *mass);
  }
  if (problem.matrices)
    for_entries(problem.matrices->M, [&](Index i, Index j, double value) {
      if (i != j && value != 0 && variances_[i] != 0) refuse(i / n);
    });
  if (!space_.all((variances_.array() >= 0).all() && variances_.allFinite()))
    throw Error("noise needs M > 0 where the damping acts, and that of {} is not", problem.name);
}

// ξ at the points, the same whoever holds them.
void Bath::draw(const RandomRow& row) {
  const Space::Field field = space_.values();
  for (Index f = 0; f * field.size < numbers_.size(); ++f)
    normal_numbers(row, f * field.of + field.first,
                   {numbers_.data() + f * field.size, static_cast<std::size_t>(field.size)});
}

// 1 − e^{−2γh} by what the flow makes of a state of ones.
const Vector& Bath::deviations(double t, double h) {
  if (deviations_h_ == h && !rates_change_) return deviations_;
  deviations_ = Vector::Ones(numbers_.size());
  mapped_.setZero(kick_.size());
  space_.from_physical(deviations_, mapped_);
  damping_->flow(t, h, mapped_);
  space_.to_physical(mapped_, deviations_);
  deviations_ = (variances_.array() * (1 - deviations_.array().square())).matrix();
  if (!space_.all((deviations_.array() >= -1e-12 * variances_.array()).all()))
    throw Error("the rate of damping is negative between t = {:.6g} and {:.6g}, where no noise balances it", t, t + h);
  deviations_ = deviations_.cwiseMax(0.0).cwiseSqrt();
  deviations_h_ = h;
  return deviations_;
}

void Bath::kick(double t, double h, RandomRow place, Vector& z) {
  place.seed = noise_.seed;
  draw(place);
  if (!by_map_) numbers_.array() *= deviations(t, h).array();
  kick_.setZero();
  space_.from_physical(numbers_, kick_);
  if (!by_map_) {
    z += kick_;
    return;
  }
  mapped_.resize(kick_.size());
  const double length = is_damped_ ? h : 2 * h;  // the kicks of a gradient flow are of a size for the whole step
  maps_.at(length, [&] { return make_map_(length); }).apply(kick_, mapped_);
  z += std::sqrt(noise_.temperature) * mapped_;
}

}  // namespace seiche
