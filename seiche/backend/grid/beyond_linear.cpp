#include <seiche/backend/grid/beyond_linear.hpp>
#include <seiche/backend/grid/segment.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/damping.hpp>
#include <seiche/core/external_force.hpp>
#include <seiche/core/momenta.hpp>
#include <seiche/core/numerics/gauss_rule.hpp>
#include <seiche/core/space.hpp>
#include <seiche/core/structure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace seiche {
namespace {

// ---- R: friction

Momenta required_momenta(const Problem& problem) {
  const std::optional<Momenta> found = momenta(problem);
  if (!found)
    throw Error(
        "the friction {} acts on velocities, and {} has none: z = (q, p) with q̇ = wp, S = [[0, I], [−I, 0]] and w times "
        "the identity in M is what it needs",
        problem.friction->text(), problem.name);
  return *found;
}

// Linear damping together with friction. The flow of R stands between two halves of that of D: symmetric, of order two,
// and each factor keeps the law.
class FrictionDamping final : public Damping {
 public:
  // `problem` has friction. Throws Error where it has no momenta for it.
  FrictionDamping(const Problem& problem, std::shared_ptr<const FieldTransform> transform,
                  std::unique_ptr<Damping> linear);

  bool is_zero() const override { return false; }
  bool is_linear() const override { return false; }
  bool touches_potential() const override { return touches_potential_; }
  void flow(double t, double h, Vector& z) const override;
  void apply(double t, const Vector& z, Vector& out) const override;
  bool is_constant() const override { return false; }
  void add_quadrature_error(const Space& space, double t, double h, std::span<const double> c,
                            std::span<const double> w, const Vector& before, const Vector& after,
                            Vector& out) const override;
  void apply_rest(double t, const Vector& z, Vector& out) const override;
  void apply_D0(const Vector& z, Vector& out) const override { linear_->apply_D0(z, out); }
  double largest_rate(const Space& space, double t, double h, const Vector& before, const Vector& after) const override;
  std::int64_t corrections() const override { return friction_->corrections(); }

 private:
  void read_points(const Vector& z) const;                          // q_ and v_
  void add_friction(double t, const Vector& z, Vector& out) const;  // out += R(t, z)
  void add_to_momenta(const Vector& at_points, Vector& out) const;
  double largest_slope(const Space& space, double t) const;  // |∂R/∂v| at q_ and v_, which moves a little

  FrictionPointer friction_;
  Momenta momenta_;
  std::shared_ptr<const FieldTransform> transform_;
  std::unique_ptr<Damping> linear_;
  bool touches_potential_;
  mutable Vector q_, v_, r_;                      // at the points
  mutable Vector q_before_, v_before_, r_moved_;  // there too, once rates or errors are asked for
  mutable Vector q_after_, v_after_, missed_;
  mutable Vector slots_;  // of one field
};

FrictionDamping::FrictionDamping(const Problem& problem, std::shared_ptr<const FieldTransform> transform,
                                 std::unique_ptr<Damping> linear)
    : friction_(problem.friction),
      momenta_(required_momenta(problem)),
      transform_(std::move(transform)),
      linear_(std::move(linear)),
      touches_potential_(problem.damping_moves_potential()),
      slots_(transform_->slots()) {
  for (Vector* v : {&q_, &v_, &r_}) v->setZero(momenta_.count * transform_->unknowns());
}

void FrictionDamping::read_points(const Vector& z) const {
  const Index slots = transform_->slots(), points = transform_->unknowns();
  for (Index f = 0; f < momenta_.count; ++f) {
    transform_->inverse(segment(z, (momenta_.first + f) * slots, slots), segment(v_, f * points, points));
    if (friction_->uses_coordinates())
      transform_->inverse(segment(z, f * slots, slots), segment(q_, f * points, points));
  }
  v_ *= momenta_.inverse_mass;
}

void FrictionDamping::flow(double t, double h, Vector& z) const {
  const Index slots = transform_->slots(), points = transform_->unknowns();
  if (!linear_->is_zero()) linear_->flow(t, h / 2, z);
  read_points(z);
  friction_->flow(t, h, momenta_.inverse_mass, all(q_), all(v_));
  v_ /= momenta_.inverse_mass;
  for (Index f = 0; f < momenta_.count; ++f)
    transform_->forward(segment(v_, f * points, points), segment(z, (momenta_.first + f) * slots, slots));
  if (!linear_->is_zero()) linear_->flow(t + h / 2, h / 2, z);
}

void FrictionDamping::add_friction(double t, const Vector& z, Vector& out) const {
  read_points(z);
  friction_->force(t, all(q_), all(v_), all(r_));
  add_to_momenta(r_, out);
}

void FrictionDamping::add_to_momenta(const Vector& at_points, Vector& out) const {
  const Index slots = transform_->slots(), points = transform_->unknowns();
  for (Index f = 0; f < momenta_.count; ++f) {
    transform_->forward(segment(at_points, f * points, points), all(slots_));
    out.segment((momenta_.first + f) * slots, slots) += slots_;
  }
}

// Along the line Gauss' rule of a few nodes more than a step has; of many where a velocity turns or leaves rest, since
// what friction does next to v = 0 may be done in a small part of the step.
void FrictionDamping::add_quadrature_error(const Space& space, double t, double h, std::span<const double> c,
                                           std::span<const double> w, const Vector& before, const Vector& after,
                                           Vector& out) const {
  static const std::vector<GaussNode> few = gauss_rule(10), many = gauss_rule(40);
  linear_->add_quadrature_error(space, t, h, c, w, before, after, out);
  read_points(before);
  q_before_ = q_;
  v_before_ = v_;
  read_points(after);
  q_after_ = q_;
  v_after_ = v_;
  missed_.setZero(r_.size());
  const auto add = [&](double place, double weight) {
    q_ = (1 - place) * q_before_ + place * q_after_;
    v_ = (1 - place) * v_before_ + place * v_after_;
    friction_->force(t + place * h, all(q_), all(v_), all(r_));
    missed_ += h * weight * r_;
  };
  const bool turns =
      space.any((v_before_.array() * v_after_.array() <= 0 && v_before_.array() != v_after_.array()).any());
  for (const auto& [place, weight] : turns ? many : few) add(place, weight);
  for (std::size_t i = 0; i < c.size(); ++i) add(c[i], -w[i]);
  add_to_momenta(missed_, out);
}

// By difference quotients that move every velocity away from rest, so that directions in which a drag of the whole
// vector rises most are among those looked at.
double FrictionDamping::largest_slope(const Space& space, double t) const {
  constexpr double relative = 1e-6;
  const double scale = space.max_norm(v_) + std::numeric_limits<double>::min() / epsilon;
  friction_->force(t, all(q_), all(v_), all(r_));
  for (double& v : v_) v += std::copysign(relative * (std::abs(v) + scale), v);
  friction_->force(t, all(q_), all(v_), all(r_moved_));
  // The quotients: r_moved_ − r_ over relative·(|v| + scale), with |v| as it is now to first order.
  const auto moved = relative / (1 + relative) * (v_.array().abs() + scale);
  return space.max(v_.size() > 0 ? ((r_moved_ - r_).array().abs() / moved).maxCoeff() : 0.0);
}

double FrictionDamping::largest_rate(const Space& space, double t, double h, const Vector& before,
                                     const Vector& after) const {
  if (r_moved_.size() == 0)
    for (Vector* v : {&v_before_, &r_moved_}) v->setZero(v_.size());
  read_points(before);
  v_before_ = v_;
  double slope = largest_slope(space, t);
  read_points(after);
  const bool turns = space.any((v_.array() * v_before_.array() < 0).any());
  if (turns) v_before_.array() = (v_.array() * v_before_.array() < 0).select(0.0, (v_ + v_before_).array() / 2);
  slope = std::max(slope, largest_slope(space, t + h));
  if (turns) {
    v_.swap(v_before_);
    slope = std::max(slope, largest_slope(space, t + h / 2));
  }
  return linear_->largest_rate(space, t, h, before, after) + momenta_.inverse_mass * slope;
}

void FrictionDamping::apply(double t, const Vector& z, Vector& out) const {
  linear_->apply(t, z, out);
  add_friction(t, z, out);
}

void FrictionDamping::apply_rest(double t, const Vector& z, Vector& out) const {
  linear_->apply_rest(t, z, out);
  add_friction(t, z, out);
}

// ---- f: external forces

class GridForce final : public ExternalForce {
 public:
  GridForce(const Problem& problem, std::shared_ptr<const FieldTransform> transform);
  void add(double t, double factor, Vector& out) const override;
  void impulse(double t, double h, Vector& z) const override;
  bool touches_potential() const override { return touches_potential_; }

 private:
  void add_slots(std::size_t field, double factor, Vector& out) const;  // of what stands in points_

  std::vector<FieldRatePointer> forces_;
  std::shared_ptr<const FieldTransform> transform_;
  bool touches_potential_ = false;
  mutable Vector points_, slots_;  // of one field
};

GridForce::GridForce(const Problem& problem, std::shared_ptr<const FieldTransform> transform)
    : forces_(problem.forces),
      transform_(std::move(transform)),
      points_(transform_->unknowns()),
      slots_(transform_->slots()) {
  for (std::size_t f = 0; f < forces_.size(); ++f)
    if (forces_[f] && problem.potential_depends_on(static_cast<Index>(f))) touches_potential_ = true;
}

void GridForce::add_slots(std::size_t field, double factor, Vector& out) const {
  transform_->forward(all(points_), all(slots_));
  out.segment(static_cast<Index>(field) * slots_.size(), slots_.size()) += factor * slots_;
}

void GridForce::add(double t, double factor, Vector& out) const {
  for (std::size_t f = 0; f < forces_.size(); ++f) {
    if (!forces_[f]) continue;
    forces_[f]->values(t, all(points_));
    add_slots(f, factor, out);
  }
}

void GridForce::impulse(double t, double h, Vector& z) const {
  for (std::size_t f = 0; f < forces_.size(); ++f) {
    if (!forces_[f]) continue;
    forces_[f]->integrals(t, h, all(points_));
    add_slots(f, 1, z);
  }
}

// ---- S(z) − S: the part of a structure matrix that changes with the state

class GridStructure final : public Structure {
 public:
  using Derivatives = std::vector<std::unique_ptr<LinearMap>>;  // of the coordinates of one field
  GridStructure(const Problem& problem, std::shared_ptr<const FieldTransform> transform, const Space& space,
                Derivatives derivatives);
  void apply(const Vector& z, const Vector& w, Vector& out) const override;
  bool without_means(const Vector& z, Vector& d) const override;
  bool dissipates() const override { return structure_->dissipates(); }

 private:
  void differentiate(std::span<const double> u, Index axis, std::span<double> out) const;

  Index fields_;
  StructurePointer structure_;
  std::shared_ptr<const FieldTransform> transform_;
  const Space& space_;
  Derivatives derivatives_;
  mutable Vector z_, w_, out_;               // at the points, all fields
  mutable Vector slots_, derivative_slots_;  // of one field
};

GridStructure::GridStructure(const Problem& problem, std::shared_ptr<const FieldTransform> transform,
                             const Space& space, Derivatives derivatives)
    : fields_(problem.field_count()),
      structure_(problem.structure),
      transform_(std::move(transform)),
      space_(space),
      derivatives_(std::move(derivatives)),
      slots_(transform_->slots()),
      derivative_slots_(transform_->slots()) {
  for (Vector* v : {&z_, &w_, &out_}) v->setZero(space.physical_size());
}

void GridStructure::differentiate(std::span<const double> u, Index axis, std::span<double> out) const {
  transform_->forward(u, all(slots_));
  derivatives_[static_cast<std::size_t>(axis)]->apply(slots_, derivative_slots_);
  transform_->inverse(all(derivative_slots_), out);
}

void GridStructure::apply(const Vector& z, const Vector& w, Vector& out) const {
  space_.to_physical(z, z_);
  space_.to_physical(w, w_);
  const auto derivative = [this](std::span<const double> u, Index axis, std::span<double> du) {
    differentiate(u, axis, du);
  };
  if (z_.size() > 0 || !derivatives_.empty())  // a derivative is a work of all processes
    structure_->apply(all(z_), all(w_), derivative, all(out_));
  space_.from_physical(out_, out);
}

bool GridStructure::without_means(const Vector& z, Vector& d) const {
  if (!structure_->keeps_means()) return false;
  space_.to_physical(z, z_);
  const Space::Field field = space_.values();
  for (Index f = 0; f < fields_; ++f) {
    auto values = z_.segment(f * field.size, field.size);
    const double sum = space_.total(field.units, [&](Index unit) {
      return values.segment(field.begin(unit), field.end(unit) - field.begin(unit)).sum();
    });
    values.array() -= sum / static_cast<double>(field.of);
  }
  space_.from_physical(z_, d);
  return true;
}

}  // namespace

void add_beyond_linear(System& system, const Problem& problem, const std::shared_ptr<const FieldTransform>& transform,
                       FunctionRef<std::unique_ptr<LinearMap>(const Stencil&)> make_derivative) {
  if (problem.friction)
    system.damping = std::make_unique<FrictionDamping>(problem, transform, std::move(system.damping));
  if (problem.has_forces()) system.force = std::make_unique<GridForce>(problem, transform);
  if (!problem.structure) return;
  GridStructure::Derivatives derivatives;
  for (const Stencil& along_axis : problem.derivatives) derivatives.push_back(make_derivative(along_axis));
  system.structure = std::make_unique<GridStructure>(problem, transform, *system.space, std::move(derivatives));
}

}  // namespace seiche
