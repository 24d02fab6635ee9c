#include <seiche/backend/krylov/krylov_phi.hpp>
#include <seiche/backend/phi/phi_trajectories.hpp>
#include <seiche/core/base/error.hpp>

#include <cmath>
#include <optional>

namespace seiche {
namespace {

using Support = Potential::Support;

// What the maps of all h have in common.
struct Common {
  explicit Common(std::shared_ptr<const KrylovOperators> given)
      : operators(std::move(given)),
        trajectory(operators->L, operators->scales, operators->space, operators->holds_s),
        support(operators->support) {}

  Index size() const { return trajectory.scales().size(); }

  void require_reach(double h) const {
    const double substeps = krylov_substeps(std::abs(h) * operators->rate);
    if (substeps <= most_krylov_substeps) return;
    throw Error(
        "a step h = {:.6g} of the sparse backend would take {:.2g} Krylov substeps for each exponential, since rates go up to {:.3g}; at "
        "most {:.0e} are taken: h ≤ {:.2g} would do (h_max beside a tolerance), or seisav with [backend] pade_degree = 6, whose work does not depend on h, or "
        "backend \"dense\" for up to some thousand unknowns",
        h, substeps, operators->rate, most_krylov_substeps, 10 * most_krylov_substeps / operators->rate);
  }

  std::shared_ptr<const KrylovOperators> operators;
  KrylovTrajectory trajectory;
  Support support;
};

class KrylovPhiMap final : public PhiMap {
 public:
  KrylovPhiMap(const PhiRows& rows, std::shared_ptr<Common> common, double h)
      : common_(std::move(common)),
        h_(h),
        kind_(rows.kind),
        of_state_(rows.of_state),
        range_(rows.outputs == PhiRows::Outputs::support ? common_->support : Support{0, common_->size()}),
        trajectories_(phi_trajectories(rows)) {
    common_->trajectory.reserve(rows.order, rows.rows.size());
    B_.assign(trajectories_.size(), Eigen::MatrixXd(common_->size(), rows.forces > 0 ? rows.order : 0));
    outputs_.reserve(rows.rows.size());
    if (kind_ == PhiRows::Forces::gradients) sum_.resize(common_->support.size);
  }

  void apply(const Vector& z, std::span<const Vector> forces, std::span<Vector> out) const override {
    // All forces are read before the first output is written: they may be the same vectors.
    for (std::size_t i = 0; i < trajectories_.size(); ++i) combine(trajectories_[i].weights, forces, B_[i]);
    for (std::size_t i = 0; i < trajectories_.size(); ++i) {
      const PhiTrajectory& trajectory = trajectories_[i];
      outputs_.clear();
      for (std::size_t k = 0; k < trajectory.rows.size(); ++k)
        outputs_.push_back({trajectory.sigmas[k], &out[trajectory.rows[k]]});
      common_->trajectory.integrate(trajectory.theta * h_, of_state_ ? &z : nullptr, B_[i], outputs_, range_);
    }
  }

 private:
  // B_k = h Σ_j W_jk n_j, balanced
  void combine(const Eigen::MatrixXd& weights, std::span<const Vector> forces, Eigen::MatrixXd& B) const {
    for (Index k = 0; k < B.cols(); ++k) {
      auto column = B.col(k);
      const auto add_to = [&](auto&& sum, Support of) {
        sum.setZero();
        for (Index j = 0; j < weights.rows(); ++j)
          if (weights(j, k) != 0)
            sum += h_ * weights(j, k) * forces[static_cast<std::size_t>(j)].segment(of.begin, of.size);
      };
      if (kind_ == PhiRows::Forces::gradients) {
        add_to(sum_, common_->support);
        common_->operators->S_support->apply({sum_.data(), static_cast<std::size_t>(sum_.size())},
                                             {column.data(), static_cast<std::size_t>(column.size())});
      } else {
        add_to(column, {0, common_->size()});
        column.array() /= common_->trajectory.scales().array();
      }
    }
  }

  std::shared_ptr<Common> common_;
  double h_;
  PhiRows::Forces kind_;
  bool of_state_;
  Support range_;
  std::vector<PhiTrajectory> trajectories_;
  mutable std::vector<Eigen::MatrixXd> B_;
  mutable std::vector<KrylovTrajectory::Output> outputs_;
  mutable Vector sum_;
};

// ∫₀ʰ Q(x) dt along ẋ = Lx + n from z: ½zᵀMz − ½x(h)ᵀMx(h) + nᵀM∫x with ∫x = hφ₁z + h²φ₂n.
class FlowDissipation {
 public:
  FlowDissipation(const std::shared_ptr<Common>& common, PhiRows::Forces kind, double h)
      : operators_(common->operators),
        gradients_(kind == PhiRows::Forces::gradients),
        of_forces_(gradients_ ? common->support : Support{0, common->size()}),
        z_and_n_(2, Vector::Zero(common->size())),
        sum_(z_and_n_[0]),
        image_(sum_) {
    const PhiRow row{1.0, {1.0, 0.0, 0.0, h}};
    constexpr auto states = PhiRows::Forces::states;
    const PhiRows rows{.rows = {row}, .forces = 2, .order = 2, .kind = states, .of_state = false};
    integral_ = std::make_unique<KrylovPhiMap>(rows, common, h);
  }

  double operator()(const Vector& z, const Vector& end, std::span<const Vector> forces) const {
    sum_.setZero();
    for (const Vector& f : forces)
      sum_.segment(of_forces_.begin, of_forces_.size) += f.segment(of_forces_.begin, of_forces_.size);
    z_and_n_[0] = z;
    Vector& n = z_and_n_[1];
    if (gradients_)
      operators_->S->apply(sum_, n);
    else
      n = sum_;
    integral_->apply(z, z_and_n_, {&sum_, 1});
    return 0.5 * (by_M(z, z) - by_M(end, end)) + by_M(n, sum_);
  }

 private:
  double by_M(const Vector& x, const Vector& y) const {
    operators_->M->apply(y, image_);
    return operators_->space.dot(x, image_);
  }

  std::shared_ptr<const KrylovOperators> operators_;
  bool gradients_;
  Support of_forces_;
  std::unique_ptr<KrylovPhiMap> integral_;
  mutable std::vector<Vector> z_and_n_;
  mutable Vector sum_, image_;  // of the forces, then ∫x
};

// The rows of all forms as outputs of one map, then a product with Q for each.
class KrylovPhiForms final : public PhiForms {
 public:
  KrylovPhiForms(std::span<const PhiEvaluator::Form> forms, std::shared_ptr<Common> common, double h)
      : operators_(common->operators), Qz_(common->size()) {
    PhiRows all = forms.front().rows;
    all.outputs = PhiRows::Outputs::all;
    all.rows.clear();
    for (const PhiEvaluator::Form& form : forms) {
      all.rows.insert(all.rows.end(), form.rows.rows.begin(), form.rows.rows.end());
      coefficients_.push_back(form.coefficients);
      less_integral_.push_back(form.minus_integral);
      if (!form.minus_integral) continue;
      if (!integral_) integral_.emplace(common, all.kind, h);
      PhiRow end{1.0, std::vector<double>(static_cast<std::size_t>(all.forces * all.order))};
      for (Index j = 0; j < all.forces; ++j) end.weights[static_cast<std::size_t>(j * all.order)] = 1;
      all.rows.push_back(std::move(end));
    }
    states_.assign(all.rows.size(), Vector(common->size()));
    map_ = std::make_unique<KrylovPhiMap>(all, std::move(common), h);
  }

  void apply(const Vector& z, std::span<const Vector> forces, std::span<double> values) const override {
    map_->apply(z, forces, states_);
    std::size_t row = 0;
    for (std::size_t l = 0; l < coefficients_.size(); ++l) {
      values[l] = 0;
      for (const double c : coefficients_[l]) {
        operators_->Q().apply(states_[row], Qz_);
        values[l] += c * operators_->space.dot(states_[row], Qz_);
        ++row;
      }
      if (less_integral_[l]) values[l] -= (*integral_)(z, states_[row++], forces);
    }
  }

 private:
  std::unique_ptr<KrylovPhiMap> map_;
  std::shared_ptr<const KrylovOperators> operators_;
  std::vector<std::vector<double>> coefficients_;
  std::vector<bool> less_integral_;
  std::optional<FlowDissipation> integral_;
  mutable std::vector<Vector> states_;
  mutable Vector Qz_;
};

class KrylovPhi final : public PhiEvaluator {
 public:
  explicit KrylovPhi(std::shared_ptr<const KrylovOperators> operators)
      : operators_(operators), common_(std::make_shared<Common>(std::move(operators))) {}

  std::unique_ptr<PhiMap> map(const PhiRows& rows, double h) const override {
    common_->require_reach(h);
    return std::make_unique<KrylovPhiMap>(rows, common_, h);
  }
  std::unique_ptr<PhiForms> forms(std::span<const Form> forms, double h) const override {
    common_->require_reach(h);
    return std::make_unique<KrylovPhiForms>(forms, common_, h);
  }
  double rate() const override { return operators_->rate; }
  Dissipation dissipation() const override { return operators_->dissipation(); }
  bool without_casimirs(const Vector& z, Vector& d) const override { return operators_->without_casimirs(z, d); }

 private:
  std::shared_ptr<const KrylovOperators> operators_;
  std::shared_ptr<Common> common_;
};

}  // namespace

std::unique_ptr<PhiEvaluator> krylov_phi(std::shared_ptr<const KrylovOperators> operators) {
  return std::make_unique<KrylovPhi>(std::move(operators));
}

}  // namespace seiche
