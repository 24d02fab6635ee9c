#include <seiche/core/simd/add_scaled.hpp>
#include <seiche/method/splitting/momentum_form.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace seiche {
namespace {

constexpr double vanishing = 1e-13;  // relative to the vector: what is left of it by round-off

class Probe {
 public:
  Probe(const System& system, Potential::Support positions) : system_(system), support_(positions) {
    const Index size = system.space->size();
    all_.resize(size);
    std::uint64_t bits = 1;
    for (double& x : all_) {  // a linear congruential generator
      bits = bits * 6364136223846793005U + 1442695040888963407U;
      x = 1 + static_cast<double>(bits >> 40U) / static_cast<double>(1U << 24U);
    }
    // Slots of transforms that always hold zero are to hold it here too.
    Vector physical = system.space->physical(all_);
    system.space->from_physical(physical, all_);
  }

  Potential::Support positions() const { return support_; }
  Index size() const { return all_.size(); }

  Vector with_positions() const {
    Vector z = Vector::Zero(size());
    z.segment(support_.begin, support_.size) = all_.segment(support_.begin, support_.size);
    return z;
  }
  Vector with_momenta() const { return all_ - with_positions(); }

  Vector S(const Vector& z) const { return applied(&LinearPart::apply_S, z); }
  Vector M(const Vector& z) const { return applied(&LinearPart::apply_M, z); }
  Vector D(const Vector& z) const {
    Vector out = Vector::Zero(size());
    system_.damping->apply(0, z, out);
    return out;
  }

  bool in_momenta(const Vector& z) const { return part_in_positions(z) <= vanishing * norm(z); }
  bool in_positions(const Vector& z) const { return part_in_momenta(z) <= vanishing * norm(z); }

  template <class Part>
  double norm(const Part& part) const {
    return system_.space->norm(part);
  }

 private:
  Vector applied(void (LinearPart::*apply)(const Vector&, Vector&) const, const Vector& z) const {
    Vector out = Vector::Zero(size());
    ((*system_.linear).*apply)(z, out);
    return out;
  }
  double part_in_positions(const Vector& z) const { return norm(z.segment(support_.begin, support_.size)); }
  double part_in_momenta(const Vector& z) const {
    return std::hypot(norm(z.head(support_.begin)), norm(z.tail(size() - support_.begin - support_.size)));
  }

  const System& system_;
  Potential::Support support_;
  Vector all_;
};

std::optional<double> rate_of(const System& system, const Probe& probe) {
  if (system.damping->is_zero()) return 0.0;
  if (!system.damping->is_constant()) return std::nullopt;
  const Vector v = probe.with_momenta();
  if (probe.norm(probe.D(probe.with_positions())) > 0) return std::nullopt;
  const Vector Dv = probe.D(v);
  const double rate = system.space->dot(Dv, v) / system.space->squared_norm(v);
  if (!(probe.norm(Dv - rate * v) <= vanishing * probe.norm(Dv))) return std::nullopt;
  return rate;
}

MomentumForm form_with(const System& system, Potential::Support positions) {
  const Probe probe(system, positions);
  const Vector u = probe.with_positions();
  const Vector v = probe.with_momenta();
  MomentumForm form{.positions = positions};
  const Vector Su = probe.S(u);
  const Vector Sv = probe.S(v);
  const Vector Mv = probe.M(v);
  form.kicks = probe.in_momenta(Su);
  form.separable = form.kicks && probe.in_positions(Sv) && probe.in_momenta(Mv) && probe.in_positions(probe.M(u));
  form.canonical = form.separable && positions.begin == 0 && 2 * positions.size == probe.size() &&
                   probe.norm(Mv - v) == 0 && probe.norm(Su.tail(positions.size) + u.head(positions.size)) == 0 &&
                   probe.norm(Sv.head(positions.size) - v.tail(positions.size)) == 0;
  form.rate = rate_of(system, probe);
  return form;
}

}  // namespace

MomentumForm momentum_form(const System& system) {
  const Potential::Support asked = system.potential->support();
  const Index half = system.space->size() / 2;
  const Potential::Support first_half{0, half};
  if (asked.size == 0) return form_with(system, first_half);
  MomentumForm form = form_with(system, asked);
  if (form.separable || asked.begin + asked.size > half) return form;
  const MomentumForm wider = form_with(system, first_half);  // V may leave out a position
  return wider.separable ? wider : form;
}

MomentumKick::MomentumKick(const System& system, const MomentumForm& form)
    : system_(system), positions_(form.positions), is_canonical_(form.canonical) {
  if (is_canonical_) return;
  for (Vector* v : {&kick_, &middle_, &product_}) v->setZero(system.space->size());
}

void MomentumKick::apply(double a, const Vector& g, const Vector& before, Vector& after) {
  if (is_canonical_) {
    const Index n = positions_.size;
    if (&before != &after) std::copy_n(before.data(), n, after.data());
    add_scaled(before.data() + n, -a, g.data(), n, after.data() + n);
    return;
  }
  system_.linear->apply_S(g, kick_);
  after = before + a * kick_;
}

//   ½z⁺ᵀMz⁺ − ½zᵀMz = ½(z⁺ − z)ᵀM(z + z⁺), which is −½a gᵀ(p + p⁺) where p⁺ = p − ag are momenta of mass one
double MomentumKick::lift(double a, const Vector& g, Vector& z) {
  if (is_canonical_) {
    const Index n = positions_.size;
    const Space::Field field = system_.space->slots();
    return -a / 2 * system_.space->total(field.units, [&](Index unit) {
      double sum = 0;
      field.for_parts(n, unit, [&](Index begin, Index length) {
        sum += add_scaled_and_weigh(z.data() + n + begin, -a, g.data() + begin, length);
      });
      return sum;
    });
  }
  apply(a, g, z, z);
  middle_ = z - a / 2 * kick_;
  system_.linear->apply_M(middle_, product_);
  return a * system_.space->dot(kick_, product_);
}

double MomentumKick::length(const Vector& g) {
  if (is_canonical_) return system_.space->norm(g.head(positions_.size));
  system_.linear->apply_S(g, kick_);
  return system_.space->norm(kick_);
}

}  // namespace seiche
