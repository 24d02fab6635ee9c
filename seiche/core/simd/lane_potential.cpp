#include <seiche/core/simd/lane_potential.hpp>

namespace seiche {
namespace {

class LaneByLane final : public LanePotential {
 public:
  LaneByLane(LaneMembers members, Index rows)
      : members_(members.begin(), members.end()),
        rows_(rows),
        a_(static_cast<std::size_t>(rows)),
        b_(static_cast<std::size_t>(rows)),
        out_(static_cast<std::size_t>(rows)) {}

  void gradient(const double* u, double* gradient) const override {
    LaneValues values;
    value_and_gradient(u, gradient, values);
  }

  void value_and_gradient(const double* u, double* gradient, LaneValues& values) const override {
    for (std::size_t l = 0; l < members_.size(); ++l) {
      gather(u, l, a_);
      values[l] = members_[l]->value_and_gradient(a_, out_);
      scatter(out_, l, gradient);
    }
  }

  void value_and_magnitude(const double* u, LaneValues& values, LaneValues& magnitudes) const override {
    for (std::size_t l = 0; l < members_.size(); ++l) {
      gather(u, l, a_);
      const ValueAndMagnitude v = members_[l]->value_and_magnitude(a_);
      values[l] = v.value;
      magnitudes[l] = v.magnitude;
    }
  }

  void mean_gradient(const double* a, const double* b, double* mean) const override {
    for (std::size_t l = 0; l < members_.size(); ++l) {
      gather(a, l, a_);
      gather(b, l, b_);
      members_[l]->mean_gradient(a_, b_, out_);
      scatter(out_, l, mean);
    }
  }

 private:
  void gather(const double* panel, std::size_t lane, std::vector<double>& values) const {
    for (Index j = 0; j < rows_; ++j) values[static_cast<std::size_t>(j)] = panel[j * lanes + static_cast<Index>(lane)];
  }
  void scatter(const std::vector<double>& values, std::size_t lane, double* panel) const {
    for (Index j = 0; j < rows_; ++j) panel[j * lanes + static_cast<Index>(lane)] = values[static_cast<std::size_t>(j)];
  }

  std::vector<std::shared_ptr<const PointwisePotential>> members_;
  Index rows_;
  mutable std::vector<double> a_, b_, out_;
};

}  // namespace

std::unique_ptr<LanePotential> lane_by_lane(LaneMembers members, Index rows) {
  return std::make_unique<LaneByLane>(members, rows);
}

std::unique_ptr<LanePotential> PointwisePotential::for_lanes(LaneMembers members, Index rows) const {
  return lane_by_lane(members, rows);
}

}  // namespace seiche
