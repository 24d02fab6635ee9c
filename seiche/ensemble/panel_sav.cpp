#include <seiche/core/simd/multiversion.hpp>
#include <seiche/ensemble/panel_sav.hpp>
#include <seiche/ensemble/row_loops.hpp>
#include <seiche/method/closure/sav_algebra.hpp>

#include <cmath>
#include <utility>

namespace seiche {
namespace {

// What the scalar part of a step is made of, and what it gives.
struct Powers {
  PanelValues v_mid{}, quadratic{}, of_increment{}, of_force{};  // V(ẑ), zᵀMz, ĝᵀFMz, ĝᵀFĝ
};
struct Force {
  PanelValues factor{}, rise{}, trouble{};  // of Fĝ; of C and r²; ≠ 0 where V(ẑ) + C ≤ 0 or V(ẑ) is not finite
};

SEICHE_MULTIVERSION void take_force(const Powers& __restrict powers, bool guarded, PanelState& __restrict next,
                                    Force& __restrict force) {
  const double allowed = guarded ? 1.0 : 0.0;
  for (std::size_t l = 0; l < static_cast<std::size_t>(panel_members); ++l) {
    const double v = powers.v_mid[l];
    SavAuxiliary a{next.r_squared[l], next.shift[l], next.energy_scale[l]};
    const double rise = allowed * sav_algebra::rise(a, v, powers.quadratic[l] / 2, 0);
    a.r_squared += rise;
    a.shift += rise;
    const auto [factor, r_squared] = sav_algebra::force(a, v, powers.of_increment[l], powers.of_force[l]);
    next.r_squared[l] = r_squared;
    next.shift[l] = a.shift;
    force.factor[l] = factor;
    force.rise[l] = rise;
    force.trouble[l] = v + a.shift > 0 ? v - v : 1.0;
  }
}

class PanelSav final : public PanelStepper {
 public:
  PanelSav(std::unique_ptr<PanelSystem> system, const MethodEntry& method, const MethodOptions& options)
      : PanelStepper(std::move(system), method, options.predictor), auxiliary_(options.auxiliary) {}

 private:
  void damp(PanelState& s, double t, double h) override;
  bool damps_z_only() const override { return auxiliary_ != AuxiliaryMode::refresh && !transports(); }
  void advance(PanelState& s, const PanelStep& maps, RowFactors after, PanelState& next, PanelReport& report) override;
  void modified_energy(const PanelState& s, const PanelValues& quadratic,
                       std::array<EnergyReading, panel_members>& readings) override;
  bool transports() const { return auxiliary_ == AuxiliaryMode::transport && system().damping_moves_potential(); }

  AuxiliaryMode auxiliary_;
  Powers powers_;
  Force force_;
};

// r² moves with V (transport), stays (frozen), or is V + C again (refresh).
void PanelSav::damp(PanelState& s, double t, double h) {
  PanelValues before, after, magnitude;
  if (transports()) potential_of(s, before, magnitude);
  flow(s, t, h);
  if (damps_z_only()) return;
  potential_of(s, after, magnitude);
  for (std::size_t l = 0; l < after.size(); ++l)
    s.r_squared[l] = transports() ? s.r_squared[l] + (after[l] - before[l]) : after[l] + s.shift[l];
}

//   z⁺ = Ez + F r̄g,   r⁺ − r = ½gᵀ(z⁺ − z),   r̄ = ½(r⁺ + r),   g = ĝ/√(V(ẑ) + C)               (3.1a), (3.1b), (4.2)
void PanelSav::advance(PanelState& s, const PanelStep& maps, RowFactors after, PanelState& next, PanelReport& report) {
  double* z = s.z.row(0);
  double* g = gradient_of(s);
  if (system().support_size() > 0) {
    predict(s, maps);  // ẑ
    system().potential().value_and_gradient(values(), slopes(), powers_.v_mid);
    system().to_coordinates(slopes(), g);  // ĝ
    keep_gradient(s);
  }
  powers_.quadratic = twice_quadratic_energy(s);
  maps.increment.dot(g, z, powers_.of_increment);
  maps.force(g, powers_.of_force);
  take_force(powers_, auxiliary_ != AuxiliaryMode::frozen, next, force_);
  scale_rows(g, force_.factor, system().support_size(), g);
  PanelValues lost;
  maps.step.finish(z, z, after, next.z.row(0), lost);
  for (std::size_t l = 0; l < lost.size(); ++l) {
    report.fallbacks[l] = force_.rise[l] != 0 ? 1 : 0;
    report.trouble[l] = force_.trouble[l] != 0 || lost[l] != 0 ? 1.0 : 0.0;
  }
}

void PanelSav::modified_energy(const PanelState& s, const PanelValues& quadratic,
                               std::array<EnergyReading, panel_members>& readings) {
  for (std::size_t l = 0; l < readings.size(); ++l) {
    readings[l].modified = quadratic[l] + (s.r_squared[l] - s.shift[l]);
    readings[l].modified_round_off = 50 * epsilon * (quadratic[l] + std::abs(s.r_squared[l]) + std::abs(s.shift[l]));
  }
}

}  // namespace

std::unique_ptr<PanelStepper> make_panel_sav(std::unique_ptr<PanelSystem> system, const MethodEntry& method,
                                             const MethodOptions& options) {
  return std::make_unique<PanelSav>(std::move(system), method, options);
}

}  // namespace seiche
