#include <seiche/core/panel_potential.hpp>

namespace seiche {
namespace {

class MemberByMember final : public PanelPotential {
 public:
  MemberByMember(PanelMembers members, Index rows)
      : members_(members.begin(), members.end()),
        rows_(rows),
        a_(static_cast<std::size_t>(rows)),
        b_(static_cast<std::size_t>(rows)),
        out_(static_cast<std::size_t>(rows)) {}

  void gradient(const double* u, double* gradient) const override {
    PanelValues values;
    value_and_gradient(u, gradient, values);
  }

  void value_and_gradient(const double* u, double* gradient, PanelValues& values) const override {
    for (std::size_t l = 0; l < members_.size(); ++l) {
      gather(u, l, a_);
      values[l] = members_[l]->value_and_gradient(a_, out_);
      scatter(out_, l, gradient);
    }
  }

  void value_and_magnitude(const double* u, PanelValues& values, PanelValues& magnitudes) const override {
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
  void gather(const double* panel, std::size_t member, std::vector<double>& values) const {
    for (Index j = 0; j < rows_; ++j)
      values[static_cast<std::size_t>(j)] = panel[j * panel_members + static_cast<Index>(member)];
  }
  void scatter(const std::vector<double>& values, std::size_t member, double* panel) const {
    for (Index j = 0; j < rows_; ++j)
      panel[j * panel_members + static_cast<Index>(member)] = values[static_cast<std::size_t>(j)];
  }

  std::vector<std::shared_ptr<const PointwisePotential>> members_;
  Index rows_;
  mutable std::vector<double> a_, b_, out_;
};

}  // namespace

std::unique_ptr<PanelPotential> member_by_member(PanelMembers members, Index rows) {
  return std::make_unique<MemberByMember>(members, rows);
}

std::unique_ptr<PanelPotential> PointwisePotential::for_members(PanelMembers members, Index rows) const {
  return member_by_member(members, rows);
}

}  // namespace seiche
