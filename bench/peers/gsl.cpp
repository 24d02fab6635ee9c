// GNU Scientific Library: Prince–Dormand 8(9) with its driver.
#include <bench/peers/groups.hpp>
#include <bench/peers/right_hand_side.hpp>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_version.h>

#include <algorithm>

namespace seiche::bench {
namespace {

constexpr double first_step = 1e-3;

class GslRun : public Run {
 public:
  GslRun(const Equation& equation, double tolerance)
      : equation_(equation),
        rhs_(equation),
        system_{evaluate, nullptr, equation.size(), this},
        driver_(gsl_odeiv2_driver_alloc_y_new(&system_, gsl_odeiv2_step_rk8pd, first_step, tolerance, tolerance)) {
    restart();
  }

  void restart() override {
    gsl_odeiv2_driver_reset_hstart(driver_.get(), first_step);
    driver_->e->count = 0;
    z_ = equation_.initial;
    t_ = 0;
    rhs_.evaluations = 0;
  }

  std::string advance(double t) override {
    rhs_.begin_advance();
    const int code = gsl_odeiv2_driver_apply(driver_.get(), &t_, t, z_.data());
    if (rhs_.is_exhausted()) return RightHandSide::exhausted;
    return code == GSL_SUCCESS ? "" : gsl_strerror(code);
  }

  void values(std::span<double> z) const override { std::copy(z_.begin(), z_.end(), z.begin()); }
  Work work() const override { return {static_cast<std::int64_t>(driver_->e->count), rhs_.evaluations}; }
  void right_hand_side(std::span<const double> z, std::span<double> dz) override { rhs_.full(z.data(), dz.data()); }

 private:
  struct Free {
    void operator()(gsl_odeiv2_driver* driver) const { gsl_odeiv2_driver_free(driver); }
  };
  static int evaluate(double, const double z[], double dz[], void* self) {
    RightHandSide& rhs = static_cast<GslRun*>(self)->rhs_;
    rhs.full(z, dz);
    return rhs.is_exhausted() ? GSL_EBADFUNC : GSL_SUCCESS;
  }

  const Equation equation_;
  RightHandSide rhs_;
  gsl_odeiv2_system system_;
  std::unique_ptr<gsl_odeiv2_driver, Free> driver_;
  std::vector<double> z_;
  double t_ = 0;
};

}  // namespace

PeerGroup gsl_peers() {
  gsl_set_error_handler_off();  // errors come back as codes
  return {.library = {.name = "GSL", .version = gsl_version, .note = "as packaged"},
          .peers = {{.name = "GSL rk8pd",
                     .library = "GSL",
                     .applies = any_equation,
                     .make = [](const Equation& equation, double tolerance) -> std::unique_ptr<Run> {
                       return std::make_unique<GslRun>(equation, tolerance);
                     }}}};
}

}  // namespace seiche::bench
