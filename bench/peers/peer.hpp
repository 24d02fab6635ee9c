// What the bench measures: an integrator that can be used for one of the equations.
#pragma once

#include <bench/peers/equation.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace seiche::bench {

// Since the last restart; −1 where the integrator does not tell.
struct Work {
  std::int64_t steps = -1;
  std::int64_t evaluations = -1;  // of the right-hand side, or of its nonlinear part
};

// An energy other than H that an integrator promises never to let grow.
struct OwnEnergy {
  double value, round_off;
};

// One integrator with one step size or tolerance, set up for one equation.
class Run {
 public:
  virtual ~Run() = default;
  virtual void restart() = 0;  // to z₀ at t = 0
  // Integrates to t ≥ the present time. Returns why that failed, or "".
  virtual std::string advance(double t) = 0;
  virtual void values(std::span<double> z) const = 0;  // field-major
  virtual Work work() const = 0;
  virtual std::optional<OwnEnergy> own_energy() const { return std::nullopt; }
  // Of H as this integrator evaluates it, where it does and keeps a law by it.
  virtual double energy_round_off() const { return 0; }
  // ż as this integrator sees it, put together from the parts it steps with.
  virtual void right_hand_side(std::span<const double> z, std::span<double> dz) = 0;
};

enum class Sweep { step_size, tolerance };
enum class Origin { seiche, packaged, hand_written };

struct Peer {
  std::string name;
  std::string library;
  Origin origin = Origin::packaged;
  Sweep sweep = Sweep::tolerance;
  std::function<bool(const Equation&)> applies;
  std::function<std::unique_ptr<Run>(const Equation&, double parameter)> make;
};

struct PeerLibrary {
  std::string name, version;
  std::string note = {};  // what a reader of its times must know
};

struct PeerGroup {
  PeerLibrary library;
  std::vector<Peer> peers;
};

inline bool any_equation(const Equation&) { return true; }
inline bool gradient_flow(const Equation& equation) { return equation.is_gradient_flow(); }
inline bool no_gradient_flow(const Equation& equation) { return !equation.is_gradient_flow(); }
inline bool second_order_in_time(const Equation& equation) { return equation.is_second_order(); }
inline bool wave_on_a_line(const Equation& equation) { return equation.is_second_order() && equation.rows == 1; }

}  // namespace seiche::bench
