// One call for one run, in the manner of SciPy's solve_ivp: a problem and times in, the solution with its energies out.
#pragma once

#include <seiche/core/run_report.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/simulation/certificate.hpp>
#include <seiche/simulation/dense_output.hpp>
#include <seiche/simulation/simulation.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

// A sign change of g(t, z) from one step to the next, z in physical values: fields × points. The method starts anew
// behind it.
struct SolveEvent {
  std::function<double(double t, const Vector& z)> g;
  Event::Direction direction = Event::Direction::any;
  std::int64_t ends_at = 0;                              // the run ends with this many of them; 0: never
  std::function<void(double t, Vector& z)> action = {};  // may change z: a bounce, a kick; null: none
};

// What an observer sees after a step.
struct SolveStep {
  double t;
  const Vector& z;  // physical values
  const EnergyReading& energy;
};

struct SolveOptions {
  std::string method = "seisav";  // or "auto"
  MethodOptions method_options = {};
  std::string backend = "auto";
  BackendOptions backend_options = {};
  Noise noise = {};                   // with h, and neither tolerance, events nor dense_output
  double h = 0.0;                     // the step size; beside a tolerance the first one, or 0
  std::optional<double> tolerance{};  // steps of variable size: the error that they add per unit of time, max norm
  double h_max = 0.0;                 // and none longer than this; 0: no bound

  double t_start = 0.0;
  double t_end = std::numeric_limits<double>::quiet_NaN();  // to be given
  std::optional<Vector> z0{};                               // physical values; none: those of the problem
  std::optional<std::vector<double>>
      t_eval{};  // the times to record, ascending; they shorten no step but perhaps the first. None: where steps end
  std::int64_t record_every = 1;  // steps, where there is no t_eval; the law is judged at these steps
  std::vector<SolveEvent> events = {};
  bool dense_output = false;  // keep what Solution::sol needs: a state of the method for every step
  bool ledger = false;        // of every recorded step: where the change of H comes from; without t_eval

  std::function<bool(const SolveStep& step)> observer = {};  // after every record_every-th step; false ends the run
  const std::atomic<bool>* stop = nullptr;                   // set elsewhere: the run ends after the current step
  // Asked after every step, at least once, with where the run is: true does the same.
  std::function<bool(double t, std::int64_t steps)> is_stopped = {};
  // What a checkpoint holds is all of the Solution so far. One that goes on from it must have the same options but for
  // t_end, and ends with the same bits; observers and actions are called for what comes then.
  Resumption resumption = {};
};

struct Solution {
  Index size = 0;                  // of a state: fields × points
  std::vector<double> t;           // recorded times; where events change z, z is that behind them; of a run that ended
                                   // early, also where it did
  std::vector<double> z;           // physical values, one state of `size` after the other
  std::vector<double> H;           // at these times
  std::vector<double> modified;    // the energy that the method keeps a law for, where it is another; else empty
  std::vector<StepLedger> ledger;  // of all steps up to each time, where asked for
  struct Events {
    std::vector<double> t, z;  // z before the action
    void archive(Archive& a) { a(t, z); }
  };
  std::vector<Events> events;              // for every event of the options
  bool ended_by_event = false;             // success before t_end
  RunReport report;                        // status, message, verdict on the law, counts
  Certificate certificate;                 // the hypotheses of the law, and what they promise
  std::string method, backend;             // as taken
  std::string method_reason;               // why "auto" took it; else ""
  std::vector<std::string> notes;          // what there is to say of this h; they stand in report.message too
  std::shared_ptr<const DenseOutput> sol;  // z(t) at every time of the run, where asked for

  bool success() const { return report.status == RunReport::Status::success; }
  // The state recorded last; as long as this lives.
  Eigen::Map<const Vector> last() const { return {z.data() + (std::ssize(z) - size), size}; }
};

// Throws Error for set-up mistakes: sizes and times that do not fit, a method that does not apply, neither h nor
// tolerance. A computation that fails is a status in the report, with what was computed before; what a callback throws,
// but for Error, comes out of `solve`.
Solution solve(const Problem& problem, const SolveOptions& options);

}  // namespace seiche
