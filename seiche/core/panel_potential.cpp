#include <seiche/core/panel_potential.hpp>
#include <seiche/core/simd/lanes.hpp>
#include <seiche/core/simd/multiversion.hpp>

namespace seiche {
namespace {

constexpr Index four = 4;

// Columns of four rows of four numbers, as rows.
[[gnu::always_inline]] inline void turn_four(const double* from, Index stride, double* to, Index to_stride) {
  const auto a = load<HalfLanes>(from), b = load<HalfLanes>(from + stride), c = load<HalfLanes>(from + 2 * stride),
             d = load<HalfLanes>(from + 3 * stride);
  const HalfLanes ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6),
                  ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const HalfLanes cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6),
                  cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  store<HalfLanes>(to, __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5));
  store<HalfLanes>(to + to_stride, __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5));
  store<HalfLanes>(to + 2 * to_stride, __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7));
  store<HalfLanes>(to + 3 * to_stride, __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7));
}

SEICHE_MULTIVERSION void panel_to_members(const double* panel, Index rows, double* members, Index stride) {
  const Index whole = rows / four * four;
  for (Index l = 0; l < panel_members; l += four)
    for (Index j = 0; j < whole; j += four)
      turn_four(panel + j * panel_members + l, panel_members, members + l * stride + j, stride);
  for (Index j = whole; j < rows; ++j)
    for (Index l = 0; l < panel_members; ++l) members[l * stride + j] = panel[j * panel_members + l];
}

SEICHE_MULTIVERSION void members_to_panel(const double* members, Index stride, Index rows, double* panel) {
  const Index whole = rows / four * four;
  for (Index l = 0; l < panel_members; l += four)
    for (Index j = 0; j < whole; j += four)
      turn_four(members + l * stride + j, stride, panel + j * panel_members + l, panel_members);
  for (Index j = whole; j < rows; ++j)
    for (Index l = 0; l < panel_members; ++l) panel[j * panel_members + l] = members[l * stride + j];
}

class MemberByMember final : public PanelPotential {
 public:
  MemberByMember(PanelMembers members, Index rows)
      : members_(members.begin(), members.end()), rows_(rows), stride_(whole_lanes(rows)) {
    for (Vector* scratch : {&a_, &b_, &mean_}) scratch->setZero(panel_members * stride_);
  }

  void value_and_gradient(const double* u, double* gradient, PanelValues& values) const override {
    turn(u, b_);
    for (std::size_t l = 0; l < members_.size(); ++l)
      values[l] = members_[l]->value_and_gradient_in_place(1, 1, member(b_, l));
    turn_back(b_, gradient);
  }
  void value_and_magnitude(const double* u, PanelValues& values, PanelValues& magnitudes) const override {
    turn(u, b_);
    for (std::size_t l = 0; l < members_.size(); ++l) {
      const ValueAndMagnitude v = members_[l]->value_and_magnitude(member(b_, l));
      values[l] = v.value;
      magnitudes[l] = v.magnitude;
    }
  }
  void begin_means(const double* a) override { turn(a, a_); }
  void mean_gradient(const double* b, double* mean) const override {
    turn(b, b_);
    for (std::size_t l = 0; l < members_.size(); ++l)
      members_[l]->mean_gradient(member(a_, l), member(b_, l), member(mean_, l));
    turn_back(mean_, mean);
  }

 private:
  void turn(const double* panel, Vector& members) const { panel_to_members(panel, rows_, members.data(), stride_); }
  void turn_back(const Vector& members, double* panel) const {
    members_to_panel(members.data(), stride_, rows_, panel);
  }
  std::span<double> member(Vector& turned, std::size_t l) const {
    return {turned.data() + static_cast<Index>(l) * stride_, static_cast<std::size_t>(rows_)};
  }

  std::vector<std::shared_ptr<const PointwisePotential>> members_;
  Index rows_, stride_;  // of the numbers of one member, and to those of the next
  mutable Vector a_, b_, mean_;
};

}  // namespace

std::unique_ptr<PanelPotential> member_by_member(PanelMembers members, Index rows) {
  return std::make_unique<MemberByMember>(members, rows);
}

std::unique_ptr<PanelPotential> PointwisePotential::for_members(PanelMembers members, Index rows) const {
  return member_by_member(members, rows);
}

}  // namespace seiche
