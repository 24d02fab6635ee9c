#include <seiche/backend/grid/segment.hpp>
#include <seiche/backend/reference/long_matrix.hpp>
#include <seiche/backend/reference/reference_terms.hpp>
#include <seiche/core/momenta.hpp>
#include <seiche/core/numerics/gauss_rule.hpp>
#include <seiche/core/step_cache.hpp>

#include <algorithm>

namespace seiche {
namespace {

class ReferencePotential final : public Potential {
 public:
  explicit ReferencePotential(const Problem& problem)
      : V_(problem.potential),
        nodes_(gauss_rule(V_->fields() == 1 ? (V_->degree() + 1) / 2 : 0)),  // exact for ∇V along a line
        support_{problem.potential_field * problem.grid.unknowns(), V_->fields() * problem.grid.unknowns()},
        u_(Vector::Zero(support_.size)),
        g_(u_) {}

  double value(const Vector& z) const override {
    ++counts_.values;
    return V_->value(of_support(z));
  }
  double magnitude(const Vector& z) const override { return V_->magnitude(of_support(z)); }
  ValueAndMagnitude value_and_magnitude(const Vector& z) const override {
    ++counts_.values;
    return V_->value_and_magnitude(of_support(z));
  }
  double value_and_gradient(const Vector& z, Vector& gradient) const override {
    ++counts_.gradients;
    u_ = z.segment(support_.begin, support_.size);
    return V_->value_and_gradient(all(u_), of_support(gradient));
  }
  void mean_gradient(const Vector& a, const Vector& b, Vector& mean) const override {
    ++counts_.gradients;
    const auto [begin, size] = support_;
    if (nodes_.empty()) return V_->mean_gradient(of_support(a), of_support(b), of_support(mean));
    auto sum = mean.segment(begin, size);
    sum.setZero();
    for (const auto& [place, weight] : nodes_) {
      u_ = (1 - place) * a.segment(begin, size) + place * b.segment(begin, size);
      V_->gradient(all(u_), all(g_));
      sum += weight * g_;
    }
  }
  void gradient_round_off(const Vector& z, Vector& bounds) const override {
    bounds.setZero();
    V_->gradient_round_off(of_support(z), of_support(bounds));
  }
  int degree() const override { return V_->degree(); }
  void along(const Vector& p, const Vector& q, std::span<double> coefficients) const override {
    ++counts_.values;
    V_->along(of_support(p), of_support(q), coefficients);
  }
  void along_ray(const Vector& z, std::span<double> coefficients) const override {
    ++counts_.values;
    std::fill(coefficients.begin(), coefficients.end(), 0.0);
    if (const int d = homogeneity(); d > 0) {
      coefficients[static_cast<std::size_t>(d)] = V_->value(of_support(z));
      return;
    }
    u_.setZero();
    V_->along(all(u_), of_support(z), coefficients);
  }
  int homogeneity() const override { return V_->homogeneity(); }
  Support support() const override { return support_; }

 private:
  std::span<const double> of_support(const Vector& z) const { return segment(z, support_.begin, support_.size); }
  std::span<double> of_support(Vector& z) const { return segment(z, support_.begin, support_.size); }

  std::shared_ptr<const PointwisePotential> V_;
  std::vector<GaussNode> nodes_;
  Support support_;
  mutable Vector u_, g_;
};

// D(t) = C + diag(γ) with the rates γ of all components. Ψ is e^{−hC/2} e^{−∫γ} e^{−hC/2}, and with friction its flow
// between two halves of that.
class ReferenceDamping final : public Damping {
 public:
  ReferenceDamping(const Problem& problem, const Eigen::MatrixXd& C, std::unique_ptr<Damping> estimates)
      : rate_(problem.damping.rate),
        field_rate_(problem.damping.field_rate),
        friction_(problem.friction),
        damped_(problem.damping.rate_fields),
        touches_potential_(problem.damping_moves_potential()),
        rate_of_D0_(seiche::rate_of_D0(problem)),
        C_(C),
        has_C_(!C.isZero(0)),
        estimates_(std::move(estimates)),
        points_(Vector::Zero(problem.grid.unknowns())),
        gamma_(Vector::Zero(problem.size())),
        long_z_(C.rows(), 1),
        long_image_(C.rows(), 1) {
    if (friction_) momenta_ = momenta(problem).value();
    p_begin_ = momenta_.first * points_.size();
    for (Vector* v : {&v_, &r_}) v->setZero(momenta_.count * points_.size());
  }

  bool is_zero() const override { return !has_C_ && !rate_ && !field_rate_ && !friction_; }
  bool is_linear() const override { return !friction_; }
  bool touches_potential() const override { return touches_potential_; }
  bool is_constant() const override { return !friction_ && !field_rate_ && (!rate_ || rate_->is_constant()); }
  std::optional<double> factor_of_identity(double t) const override {
    const bool of_all = std::find(damped_.begin(), damped_.end(), false) == damped_.end();
    if (has_C_ || field_rate_ || friction_ || !rate_ || !of_all) return std::nullopt;
    return rate_->value(t);
  }

  void flow(double t, double h, Vector& z) const override {
    if (!friction_) return linear_flow(t, h, z);
    linear_flow(t, h / 2, z);
    const double w = momenta_.inverse_mass;
    v_ = w * z.segment(p_begin_, v_.size());
    friction_->flow(t, h, w, q_of(z), all(v_));
    z.segment(p_begin_, v_.size()) = v_ / w;
    linear_flow(t + h / 2, h / 2, z);
  }
  void apply(double t, const Vector& z, Vector& out) const override {
    set_rates(rate_ ? rate_->value(t) : 0.0, t);
    out.noalias() = C_ * z;
    out += gamma_.cwiseProduct(z);
    add_friction(t, z, out);
  }
  void apply_rest(double t, const Vector& z, Vector& out) const override {
    out.setZero();
    if (is_constant()) return;
    set_rates((rate_ ? rate_->value(t) : 0.0) - rate_of_D0_, t);
    out = gamma_.cwiseProduct(z);
    add_friction(t, z, out);
  }
  void apply_D0(const Vector& z, Vector& out) const override {
    spread(rate_of_D0_, false);
    out.noalias() = C_ * z;
    out += gamma_.cwiseProduct(z);
  }

  void add_quadrature_error(const Space& space, double t, double h, std::span<const double> c,
                            std::span<const double> w, const Vector& before, const Vector& after,
                            Vector& out) const override {
    estimates_->add_quadrature_error(space, t, h, c, w, before, after, out);
  }
  double largest_rate(const Space& space, double t, double h, const Vector& before,
                      const Vector& after) const override {
    return estimates_->largest_rate(space, t, h, before, after);
  }
  std::int64_t corrections() const override { return friction_ ? friction_->corrections() : 0; }

 private:
  // γ of every component: `uniform`, and what stands in points_ if asked for, on the fields that are damped.
  void spread(double uniform, bool with_points) const {
    const Index n = points_.size();
    for (std::size_t f = 0; f < damped_.size(); ++f) {
      if (!damped_[f]) continue;
      gamma_.segment(static_cast<Index>(f) * n, n).setConstant(uniform);
      if (with_points) gamma_.segment(static_cast<Index>(f) * n, n) += points_;
    }
  }
  void set_rates(double uniform, double t) const {
    if (field_rate_) field_rate_->values(t, all(points_));
    spread(uniform, field_rate_ != nullptr);
  }
  void linear_flow(double t, double h, Vector& z) const {
    constant_flow(h / 2, z);
    if (field_rate_) field_rate_->integrals(t, h, all(points_));
    spread(rate_ ? rate_->integral(t, h) : 0.0, field_rate_ != nullptr);
    z.array() *= (-gamma_.array()).exp();
    constant_flow(h / 2, z);
  }
  void constant_flow(double h, Vector& z) const {
    if (!has_C_) return;
    const LongMatrix& X = flows_.at(h, [&] {
      const LongMatrix exponent = -static_cast<long double>(h) * C_.cast<long double>();
      return std::make_unique<LongMatrix>(reference_phi_functions(exponent, 1)[0]);
    });
    long_z_.col(0) = z.cast<long double>();
    long_image_.noalias() = X * long_z_;
    z = (long_z_ + long_image_).cast<double>();
  }

  std::span<const double> q_of(const Vector& z) const { return segment(z, 0, v_.size()); }
  void add_friction(double t, const Vector& z, Vector& out) const {
    if (!friction_) return;
    v_ = momenta_.inverse_mass * z.segment(p_begin_, v_.size());
    friction_->force(t, q_of(z), all(v_), all(r_));
    out.segment(p_begin_, v_.size()) += r_;
  }

  RatePointer rate_;
  FieldRatePointer field_rate_;
  FrictionPointer friction_;
  std::vector<bool> damped_;
  bool touches_potential_;
  double rate_of_D0_;
  Eigen::MatrixXd C_;
  bool has_C_;
  Momenta momenta_;
  Index p_begin_ = 0;
  std::unique_ptr<Damping> estimates_;
  mutable Vector points_, gamma_, v_, r_;
  mutable LongMatrix long_z_, long_image_;
  mutable StepCache<LongMatrix> flows_{16};
};

}  // namespace

std::unique_ptr<Potential> reference_potential(const Problem& problem) {
  return std::make_unique<ReferencePotential>(problem);
}

std::unique_ptr<Damping> reference_damping(const Problem& problem, const Eigen::MatrixXd& C,
                                           std::unique_ptr<Damping> estimates) {
  return std::make_unique<ReferenceDamping>(problem, C, std::move(estimates));
}

}  // namespace seiche
