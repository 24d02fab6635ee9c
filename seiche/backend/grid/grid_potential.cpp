#include <seiche/backend/grid/grid_potential.hpp>
#include <seiche/backend/grid/segment.hpp>

#include <algorithm>
#include <array>

namespace seiche {

GridPotential::GridPotential(std::shared_ptr<const PointwisePotential> pointwise, Index first_field,
                             std::shared_ptr<const FieldTransform> transform, const Space& space)
    : pointwise_(std::move(pointwise)), transform_(std::move(transform)), space_(space) {
  const Index fields = pointwise_ ? pointwise_->fields() : 0;
  support_ = {first_field * transform_->slots(), fields * transform_->slots()};
  for (Vector* scratch : {&a_, &b_, &slope_}) scratch->setZero(fields * transform_->unknowns());
  const Space::Field field = space_.values();
  takes_values_as_they_are_ =
      fields > 0 && transform_->is_identity() && pointwise_->is_local() && field.units.whole().count() == 1;
  is_gathered_ = fields > 0 && !pointwise_->is_local() && pointwise_->is_pointwise() && field.units.whole().count() > 1;
  for (Index unit = 0; is_gathered_ && unit < field.units.count(); ++unit) {
    auto there = pointwise_->at_points(field.begin(unit), field.end(unit) - field.begin(unit));
    of_units_.push_back(there ? std::move(there) : pointwise_);
  }
}

// The values of all fields at the points of a unit, side by side.
std::span<double> GridPotential::gathered(std::span<const double> u, Index unit, Vector& block) const {
  const Space::Field field = space_.values();
  const Index begin = field.begin(unit), points = field.end(unit) - begin, fields = pointwise_->fields();
  block.resize(fields * points);
  for (Index f = 0; f < fields; ++f)
    std::copy_n(u.begin() + f * field.size + begin, points, block.begin() + f * points);
  return all(block);
}

std::span<const double> GridPotential::values_of(const Vector& z, Vector& values) const {
  const Index n = transform_->unknowns();
  const Index slots = transform_->slots();
  if (transform_->is_identity()) return segment(z, support_.begin, support_.size);
  for (Index f = 0; f < pointwise_->fields(); ++f)
    transform_->inverse(segment(z, support_.begin + f * slots, slots), segment(values, f * n, n));
  return all(values);
}

void GridPotential::set_gradient(const Vector& physical, Vector& gradient) const {
  const Index n = transform_->unknowns();
  const Index slots = transform_->slots();
  for (Index f = 0; f < pointwise_->fields(); ++f)
    transform_->forward(segment(physical, f * n, n), segment(gradient, support_.begin + f * slots, slots));
}

// A V that is a sum over points is added up unit by unit. of_part(V, part, sums): the V to take there, and the values
// to take as part(u) of all values u, of two arrays u at most.
template <class OfPart>
void GridPotential::add(const OfPart& of_part, std::span<double> totals) const {
  const Space::Field field = space_.values();
  if (!pointwise_->is_pointwise() || field.units.whole().count() == 1) {
    of_part(
        *pointwise_, [](std::span<const double> u) { return u; }, totals);
    return space_.sum(totals);
  }
  space_.add(
      field.units,
      [&](Index unit, std::span<double> sums) {
        if (!is_gathered_) {
          const auto begin = static_cast<std::size_t>(field.begin(unit)),
                     end = static_cast<std::size_t>(field.end(unit));
          of_part(
              *pointwise_, [=](std::span<const double> u) { return u.subspan(begin, end - begin); }, sums);
          return;
        }
        std::size_t taken = 0;
        of_part(
            *of_units_[static_cast<std::size_t>(unit)],
            [&](std::span<const double> u) -> std::span<const double> { return gathered(u, unit, blocks_[taken++]); },
            sums);
      },
      totals);
}

double GridPotential::total(std::span<const double> u, Number number) const {
  double total = 0;
  add([&](const auto& V, const auto& part, std::span<double> sum) { sum[0] = (V.*number)(part(u)); }, {&total, 1});
  return total;
}

double GridPotential::value(const Vector& z) const {
  if (!pointwise_) return 0;
  ++counts_.values;
  return total(values_of(z, a_), &PointwisePotential::value);
}

double GridPotential::magnitude(const Vector& z) const {
  return pointwise_ ? total(values_of(z, a_), &PointwisePotential::magnitude) : 0;
}

ValueAndMagnitude GridPotential::value_and_magnitude(const Vector& z) const {
  if (!pointwise_) return {};
  ++counts_.values;
  const std::span<const double> u = values_of(z, a_);
  std::array<double, 2> totals{};
  add(
      [&](const auto& V, const auto& part, std::span<double> sums) {
        const ValueAndMagnitude v = V.value_and_magnitude(part(u));
        sums[0] = v.value;
        sums[1] = v.magnitude;
      },
      totals);
  return {.value = totals[0], .magnitude = totals[1]};
}

// In the vector of the gradient: coordinates become values, these slopes, and those coordinates again.
double GridPotential::value_and_gradient(const Vector& z, Vector& gradient) const {
  if (!pointwise_) return 0;
  ++counts_.gradients;
  const auto slopes = [this](std::span<double> values) {
    return pointwise_->value_and_gradient_in_place(transform_->value_scale(), transform_->slot_scale(), values);
  };
  if (takes_values_as_they_are_) {
    if (&z != &gradient) gradient.segment(support_.begin, support_.size) = z.segment(support_.begin, support_.size);
    return space_.sum(slopes(segment(gradient, support_.begin, support_.size)));
  }
  if (pointwise_->is_local()) {
    double value = 0;
    space_.add_units(transform_->value_field().units,
                     transform_->through_values(segment(z, support_.begin, support_.size),
                                                segment(gradient, support_.begin, support_.size), slopes),
                     {&value, 1});
    return value;
  }
  if (&z != &gradient) gradient.segment(support_.begin, support_.size) = z.segment(support_.begin, support_.size);
  const Index n = transform_->unknowns();
  const Index slots = transform_->slots();
  const auto field = [&](Index f) { return segment(gradient, support_.begin + f * slots, slots); };
  for (Index f = 0; f < pointwise_->fields(); ++f) transform_->to_values(field(f), segment(slope_, f * n, n));
  const double v = is_gathered_ ? value_and_slopes_by_units() : space_.sum(slopes(all(slope_)));
  for (Index f = 0; f < pointwise_->fields(); ++f) transform_->to_slots(segment(slope_, f * n, n), field(f));
  return v;
}

// In slope_, which holds values and then slopes.
double GridPotential::value_and_slopes_by_units() const {
  const Space::Field field = space_.values();
  return space_.total(field.units, [&](Index unit) {
    const std::span<double> block = gathered(all(slope_), unit, blocks_[0]);
    const double v =
        of_units_[static_cast<std::size_t>(unit)]->value_and_gradient_in_place(transform_->value_scale(),
                                                                               transform_->slot_scale(), block);
    const Index begin = field.begin(unit), points = field.end(unit) - begin;
    for (Index f = 0; f < pointwise_->fields(); ++f)
      std::copy_n(block.begin() + f * points, points, slope_.begin() + f * field.size + begin);
    return v;
  });
}

void GridPotential::mean_gradient(const Vector& a, const Vector& b, Vector& mean) const {
  if (!pointwise_) return;
  ++counts_.gradients;
  pointwise_->mean_gradient(values_of(a, a_), values_of(b, b_), all(slope_));
  set_gradient(slope_, mean);
}

void GridPotential::gradient_round_off(const Vector& z, Vector& bounds) const {
  bounds.setZero();
  if (!pointwise_) return;
  pointwise_->gradient_round_off(values_of(z, a_), all(slope_));
  set_gradient(slope_, bounds);
}

void GridPotential::along(const Vector& p, const Vector& q, std::span<double> coefficients) const {
  if (!pointwise_) {
    std::fill(coefficients.begin(), coefficients.end(), 0.0);
    return;
  }
  ++counts_.values;
  const std::span<const double> u = values_of(p, a_), v = values_of(q, b_);
  add(
      [&](const auto& V, const auto& part, std::span<double> sums) {
        const std::span<const double> from = part(u);
        V.along(from, part(v), sums);
      },
      coefficients);
}

void GridPotential::along_ray(const Vector& z, std::span<double> coefficients) const {
  std::fill(coefficients.begin(), coefficients.end(), 0.0);
  if (!pointwise_) return;
  ++counts_.values;
  const std::span<const double> v = values_of(z, b_);
  if (const int d = pointwise_->homogeneity(); d > 0) {
    coefficients[static_cast<std::size_t>(d)] = total(v, &PointwisePotential::value);
    return;
  }
  a_.setZero();
  const std::span<const double> u = all(a_);
  add(
      [&](const auto& V, const auto& part, std::span<double> sums) {
        const std::span<const double> from = part(u);
        V.along(from, part(v), sums);
      },
      coefficients);
}

}  // namespace seiche
