#include <seiche/backend/modal/masked_potential.hpp>

namespace seiche {

MaskedPotential::MaskedPotential(std::unique_ptr<Potential> potential, Vector mask)
    : potential_(std::move(potential)), mask_(std::move(mask)) {}

const Vector& MaskedPotential::masked(const Vector& z, Vector& out) const {
  const Support s = support();
  if (out.size() != z.size()) out.setZero(z.size());
  out.segment(s.begin, s.size) = mask_.cwiseProduct(z.segment(s.begin, s.size));
  return out;
}

void MaskedPotential::mask(Vector& gradient) const {
  const Support s = support();
  gradient.segment(s.begin, s.size).array() *= mask_.array();
}

double MaskedPotential::value(const Vector& z) const {
  ++counts_.values;
  return potential_->value(masked(z, a_));
}

double MaskedPotential::magnitude(const Vector& z) const { return potential_->magnitude(masked(z, a_)); }

ValueAndMagnitude MaskedPotential::value_and_magnitude(const Vector& z) const {
  ++counts_.values;
  return potential_->value_and_magnitude(masked(z, a_));
}

double MaskedPotential::value_and_gradient(const Vector& z, Vector& gradient) const {
  ++counts_.gradients;
  const double v = potential_->value_and_gradient(masked(z, a_), gradient);
  mask(gradient);
  return v;
}

void MaskedPotential::mean_gradient(const Vector& a, const Vector& b, Vector& mean) const {
  ++counts_.gradients;
  potential_->mean_gradient(masked(a, a_), masked(b, b_), mean);
  mask(mean);
}

void MaskedPotential::gradient_round_off(const Vector& z, Vector& bounds) const {
  potential_->gradient_round_off(masked(z, a_), bounds);
  mask(bounds);
}

void MaskedPotential::along(const Vector& p, const Vector& q, std::span<double> coefficients) const {
  ++counts_.values;
  potential_->along(masked(p, a_), masked(q, b_), coefficients);
}

void MaskedPotential::along_ray(const Vector& z, std::span<double> coefficients) const {
  ++counts_.values;
  potential_->along_ray(masked(z, a_), coefficients);
}

}  // namespace seiche
