// SUNDIALS: CVODE (Adams with Anderson acceleration, BDF with Newton and GMRES) and ARKODE (explicit; implicit–explicit
// with the linear part implicit). GMRES is preconditioned by the exact inverse of the linear part, in modes.
#include <bench/peers/groups.hpp>
#include <bench/peers/modes.hpp>
#include <bench/peers/right_hand_side.hpp>
#include <bench/peers/sundials_vector.hpp>

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace seiche::bench {
namespace {

class Context {
 public:
  Context() { SUNContext_Create(nullptr, &context_); }
  ~Context() { SUNContext_Free(&context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  operator SUNContext() const { return context_; }

 private:
  SUNContext context_ = nullptr;
};

struct FreeLinear {
  void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
};
struct FreeNonlinear {
  void operator()(SUNNonlinearSolver s) const { SUNNonlinSolFree(s); }
};

const double* in(N_Vector v) { return NV_DATA_S(v); }
double* out(N_Vector v) { return NV_DATA_S(v); }

// What the four integrators share; SUNDIALS calls back with a pointer to it.
class SundialsRun : public Run {
 public:
  explicit SundialsRun(const Equation& equation)
      : equation_(equation), rhs_(equation), solve_(equation), z_(make_vector(equation.initial, context_)) {}

  void restart() override {
    std::copy(equation_.initial.begin(), equation_.initial.end(), out(z_.get()));
    t_ = 0;
    rhs_.evaluations = 0;
    reinitialise();
  }
  std::string advance(double t) override {
    if (t <= t_) return "";
    rhs_.begin_advance();
    const int code = integrate(t);
    if (rhs_.is_exhausted()) return RightHandSide::exhausted;
    return code >= 0 ? "" : "SUNDIALS returned " + std::to_string(code);
  }
  void values(std::span<double> z) const override { std::copy_n(in(z_.get()), z.size(), z.begin()); }
  Work work() const override { return {steps(), rhs_.evaluations}; }
  void right_hand_side(std::span<const double> z, std::span<double> dz) override { rhs_.full(z.data(), dz.data()); }

 protected:
  virtual void reinitialise() = 0;
  virtual int integrate(double t) = 0;
  virtual std::int64_t steps() const = 0;

  static SundialsRun& self(void* user) { return *static_cast<SundialsRun*>(user); }
  static int full(double, N_Vector z, N_Vector dz, void* user) {
    RightHandSide& rhs = self(user).rhs_;
    rhs.full(in(z), out(dz));
    return rhs.is_exhausted() ? -1 : 0;
  }
  static int linear(double, N_Vector z, N_Vector dz, void* user) {
    self(user).rhs_.linear(in(z), out(dz));
    return 0;
  }
  static int nonlinear(double, N_Vector z, N_Vector dz, void* user) {
    RightHandSide& rhs = self(user).rhs_;
    ++rhs.evaluations;
    rhs.nonlinear(in(z), out(dz));
    return rhs.is_exhausted() ? -1 : 0;
  }
  static int jacobian_times(N_Vector w, N_Vector jw, double, N_Vector z, N_Vector, void* user, N_Vector) {
    self(user).rhs_.jacobian(in(z), in(w), out(jw));
    return 0;
  }
  static int linear_times(N_Vector w, N_Vector jw, double, N_Vector, N_Vector, void* user, N_Vector) {
    self(user).rhs_.linear(in(w), out(jw));
    return 0;
  }
  static int precondition(double, N_Vector, N_Vector, N_Vector r, N_Vector x, double gamma, double, int, void* user) {
    self(user).solve_(gamma, in(r), out(x));
    return 0;
  }

  Context context_;  // outlives everything made with it
  const Equation equation_;
  RightHandSide rhs_;
  LinearSolve solve_;
  SundialsVector z_;
  double t_ = 0;
};

class CvodeRun : public SundialsRun {
 public:
  CvodeRun(const Equation& equation, double tolerance, int multistep)
      : SundialsRun(equation), memory_(CVodeCreate(multistep, context_)) {
    CVodeInit(memory_, full, 0, z_.get());
    CVodeSStolerances(memory_, tolerance, tolerance);
    CVodeSetUserData(memory_, static_cast<SundialsRun*>(this));
    CVodeSetMaxNumSteps(memory_, -1);
    CVodeSetErrFile(memory_, nullptr);
    if (multistep == CV_ADAMS) {
      constexpr int accelerated_by = 3;
      nonlinear_solver_.reset(SUNNonlinSol_FixedPoint(z_.get(), accelerated_by, context_));
      CVodeSetNonlinearSolver(memory_, nonlinear_solver_.get());
    } else {
      linear_solver_.reset(SUNLinSol_SPGMR(z_.get(), SUN_PREC_LEFT, 0, context_));
      CVodeSetLinearSolver(memory_, linear_solver_.get(), nullptr);
      CVodeSetJacTimes(memory_, nullptr, jacobian_times);
      CVodeSetPreconditioner(memory_, nullptr, precondition);
    }
    restart();
  }
  ~CvodeRun() override { CVodeFree(&memory_); }
  CvodeRun(const CvodeRun&) = delete;
  CvodeRun& operator=(const CvodeRun&) = delete;

 private:
  void reinitialise() override { CVodeReInit(memory_, 0, z_.get()); }
  int integrate(double t) override {
    CVodeSetStopTime(memory_, equation_.t_end);
    return CVode(memory_, t, z_.get(), &t_, CV_NORMAL);
  }
  std::int64_t steps() const override {
    long count = 0;  // NOLINT(google-runtime-int): CVODE's type
    CVodeGetNumSteps(memory_, &count);
    return count;
  }

  void* memory_;
  std::unique_ptr<_generic_SUNLinearSolver, FreeLinear> linear_solver_;
  std::unique_ptr<_generic_SUNNonlinearSolver, FreeNonlinear> nonlinear_solver_;
};

class ErkRun : public SundialsRun {
 public:
  ErkRun(const Equation& equation, double tolerance)
      : SundialsRun(equation), memory_(ERKStepCreate(full, 0, z_.get(), context_)) {
    constexpr int order = 5;
    ERKStepSetOrder(memory_, order);
    ERKStepSStolerances(memory_, tolerance, tolerance);
    ERKStepSetUserData(memory_, static_cast<SundialsRun*>(this));
    ERKStepSetMaxNumSteps(memory_, -1);
    ERKStepSetErrFile(memory_, nullptr);
    restart();
  }
  ~ErkRun() override { ERKStepFree(&memory_); }
  ErkRun(const ErkRun&) = delete;
  ErkRun& operator=(const ErkRun&) = delete;

 private:
  void reinitialise() override { ERKStepReInit(memory_, full, 0, z_.get()); }
  int integrate(double t) override {
    ERKStepSetStopTime(memory_, equation_.t_end);
    return ERKStepEvolve(memory_, t, z_.get(), &t_, ARK_NORMAL);
  }
  std::int64_t steps() const override {
    long count = 0;  // NOLINT(google-runtime-int): ARKODE's type
    ERKStepGetNumSteps(memory_, &count);
    return count;
  }

  void* memory_;
};

class ImexRun : public SundialsRun {
 public:
  ImexRun(const Equation& equation, double tolerance)
      : SundialsRun(equation),
        memory_(ARKStepCreate(nonlinear, linear, 0, z_.get(), context_)),
        linear_solver_(SUNLinSol_SPGMR(z_.get(), SUN_PREC_LEFT, 0, context_)) {
    constexpr int order = 5;
    ARKStepSetOrder(memory_, order);
    ARKStepSStolerances(memory_, tolerance, tolerance);
    ARKStepSetUserData(memory_, static_cast<SundialsRun*>(this));
    ARKStepSetMaxNumSteps(memory_, -1);
    ARKStepSetErrFile(memory_, nullptr);
    ARKStepSetLinearSolver(memory_, linear_solver_.get(), nullptr);
    ARKStepSetJacTimes(memory_, nullptr, linear_times);
    ARKStepSetPreconditioner(memory_, nullptr, precondition);
    ARKStepSetLinear(memory_, 0);
    restart();
  }
  ~ImexRun() override { ARKStepFree(&memory_); }
  ImexRun(const ImexRun&) = delete;
  ImexRun& operator=(const ImexRun&) = delete;

  void right_hand_side(std::span<const double> z, std::span<double> dz) override {
    std::vector<double> other(dz.size());
    rhs_.linear(z.data(), dz.data());
    rhs_.nonlinear(z.data(), other.data());
    for (std::size_t i = 0; i < dz.size(); ++i) dz[i] += other[i];
  }

 private:
  void reinitialise() override { ARKStepReInit(memory_, nonlinear, linear, 0, z_.get()); }
  int integrate(double t) override {
    ARKStepSetStopTime(memory_, equation_.t_end);
    return ARKStepEvolve(memory_, t, z_.get(), &t_, ARK_NORMAL);
  }
  std::int64_t steps() const override {
    long count = 0;  // NOLINT(google-runtime-int): ARKODE's type
    ARKStepGetNumSteps(memory_, &count);
    return count;
  }

  void* memory_;
  std::unique_ptr<_generic_SUNLinearSolver, FreeLinear> linear_solver_;
};

Peer peer(const std::string& name, std::unique_ptr<Run> (*make)(const Equation&, double)) {
  return {.name = name, .library = "SUNDIALS", .applies = any_equation, .make = make};
}

std::string note() {
  constexpr double clearly_unoptimised = 2.5;
  const double slowdown = packaged_vector_slowdown();
  if (slowdown < clearly_unoptimised) return "as packaged, vector operations compiled with the bench";
  char text[160];
  std::snprintf(text, sizeof text,
                "package compiled without optimisation (its vector sum takes %.1f times ours); "
                "vector operations replaced by ours",
                slowdown);
  return text;
}

}  // namespace

PeerGroup sundials_peers() {
  using Made = std::unique_ptr<Run>;
  return {.library = {.name = "SUNDIALS", .version = SUNDIALS_VERSION, .note = note()},
          .peers = {
              peer("CVODE Adams",
                   [](const Equation& e, double t) -> Made { return std::make_unique<CvodeRun>(e, t, CV_ADAMS); }),
              peer("CVODE BDF",
                   [](const Equation& e, double t) -> Made { return std::make_unique<CvodeRun>(e, t, CV_BDF); }),
              peer("ARKODE ERK", [](const Equation& e, double t) -> Made { return std::make_unique<ErkRun>(e, t); }),
              peer("ARKODE ImEx", [](const Equation& e, double t) -> Made { return std::make_unique<ImexRun>(e, t); }),
          }};
}

}  // namespace seiche::bench
