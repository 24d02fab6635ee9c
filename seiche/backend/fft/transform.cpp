#include <seiche/backend/fft/transform.hpp>

#include <algorithm>
#include <vector>

namespace seiche {
namespace {

// Physical values as coordinates.
class IdentityTransform final : public FieldTransform {
 public:
  explicit IdentityTransform(Index n) : n_(n) {}
  Index unknowns() const override { return n_; }
  Index slots() const override { return n_; }
  bool is_identity() const override { return true; }
  void to_slots(std::span<const double> values, std::span<double> slots) const override {
    std::copy(values.begin(), values.end(), slots.begin());
  }
  void to_values(std::span<double> slots, std::span<double> values) const override {
    std::copy(slots.begin(), slots.end(), values.begin());
  }
  double through_values(std::span<const double> from, std::span<double> slots, const Pointwise& f) const override {
    if (from.data() != slots.data()) std::copy(from.begin(), from.end(), slots.begin());
    return f(slots);
  }

 private:
  Index n_;
};

}  // namespace

void FieldTransform::forward(std::span<const double> values, std::span<double> slots) const {
  to_slots(values, slots);
  const double scale = slot_scale();
  if (scale != 1)
    for (double& slot : slots) slot *= scale;
}

void FieldTransform::inverse(std::span<const double> slots, std::span<double> values) const {
  const double scale = value_scale();
  thread_local std::vector<double> scaled;  // to_values overwrites what it is given
  scaled.resize(slots.size());
  for (std::size_t i = 0; i < slots.size(); ++i) scaled[i] = scale * slots[i];
  to_values(scaled, values);
}

std::unique_ptr<FieldTransform> identity_transform(Index unknowns) {
  return std::make_unique<IdentityTransform>(unknowns);
}

}  // namespace seiche
