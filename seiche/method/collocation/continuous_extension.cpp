#include <seiche/method/collocation/collocation_weights.hpp>
#include <seiche/method/collocation/continuous_extension.hpp>

#include <algorithm>

namespace seiche {

ContinuousExtension::ContinuousExtension(const PhiEvaluator& phi, const GaussRule& rule, PhiRows::Forces kind,
                                         Index size)
    : phi_(phi),
      rule_(rule),
      kind_(kind),
      defects_(cached_step_sizes(size)),
      out_(1, Vector::Zero(size)),
      rest_(1, Vector::Zero(size)) {}

ContinuousExtension::Maps ContinuousExtension::maps(const Step& step, double theta, bool difference) const {
  const Index s = rule_.nodes.size();
  const bool alone = step.history_h == 0;
  Eigen::VectorXd nodes(alone ? s : 2 * s);
  if (!alone) nodes.head(s) = (rule_.nodes.array() - 1) * (step.history_h / step.h);
  nodes.tail(s) = rule_.nodes;
  Eigen::MatrixXd C = interpolation(nodes);
  if (difference) C.topRightCorner(s, s) -= interpolation(rule_.nodes);

  const auto map = [&](const Eigen::MatrixXd& of_forces, bool of_state) {
    PhiRows rows{.rows = {{theta, collocation_weights(of_forces, theta)}},
                 .forces = s,
                 .order = nodes.size(),
                 .kind = kind_,
                 .outputs = PhiRows::Outputs::all,
                 .of_state = of_state};
    return phi_.map(rows, step.h);
  };
  Maps made{step.history_h, nullptr, map(C.rightCols(s), !difference), Eigen::VectorXd::Zero(C.cols())};
  for (Index k = 0; k < C.rows(); ++k)
    made.moments += square(step.h) / static_cast<double>((k + 1) * (k + 2)) * C.row(k).transpose();
  if (!alone) made.of_before = map(C.leftCols(s), false);
  return made;
}

void ContinuousExtension::evaluate(const Step& step, double theta, const Vector& z_before,
                                   std::span<const Vector> forces_before, std::span<const Vector> forces, Vector& z) {
  const Maps m = maps(step, theta, false);
  m.of_this->apply(z_before, forces, out_);
  z = out_[0];
  if (!m.of_before) return;
  m.of_before->apply(z_before, forces_before, out_);
  z += out_[0];
}

const ContinuousExtension::Maps& ContinuousExtension::defect_maps(const Step& step) {
  std::vector<Maps>& of_h = defects_.at(step.h, [] { return std::make_unique<std::vector<Maps>>(); });
  auto found = std::find_if(of_h.begin(), of_h.end(), [&](const Maps& m) { return m.history_h == step.history_h; });
  if (found == of_h.end() && of_h.size() == 4) found = of_h.erase(of_h.begin(), of_h.end());
  if (found == of_h.end()) found = of_h.insert(of_h.end(), maps(step, 1.0, true));
  return *found;
}

void ContinuousExtension::moment(const Step& step, std::span<const Vector> forces_before,
                                 std::span<const Vector> forces, Vector& m) {
  const Eigen::VectorXd& w = defect_maps(step).moments;
  const Index s = rule_.nodes.size();
  m.setZero();
  for (Index i = 0; i < s; ++i)
    m += w[i] * forces_before[static_cast<std::size_t>(i)] + w[s + i] * forces[static_cast<std::size_t>(i)];
}

const Vector& ContinuousExtension::defect(const Step& step, std::span<const Vector> forces_before,
                                          std::span<const Vector> forces) {
  const Maps& maps = defect_maps(step);
  maps.of_this->apply(out_[0], forces, rest_);
  maps.of_before->apply(out_[0], forces_before, out_);
  out_[0] += rest_[0];
  return out_[0];
}

}  // namespace seiche
