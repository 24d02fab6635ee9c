#include <seiche/ensemble/panel_avf.hpp>
#include <seiche/ensemble/row_loops.hpp>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace seiche {
namespace {

constexpr int max_sweeps = 100;
constexpr double stagnation = 100;  // in units of the tolerance, as in method/closure/avf.cpp

class PanelAvf final : public PanelStepper {
 public:
  PanelAvf(std::unique_ptr<PanelSystem> from, const MethodEntry& method, const MethodOptions& options)
      : PanelStepper(std::move(from), method, options.predictor),
        linear_(system().size()),
        plus_(system().size()),
        q_(system().size()) {}

 private:
  void advance(PanelState& s, const PanelStep& maps, RowFactors after, PanelState& next, PanelReport& report) override;
  // next = z + FMz + Fḡ(z, z⁺), and the size of the update in units of 4ε(|z⁺| + |Fḡ|).
  void sweep(PanelState& s, const PanelStep& maps, Panel& next);

  Panel linear_;  // z + FMz
  Panel plus_, q_;
  PanelValues update_{};
};

void PanelAvf::sweep(PanelState& s, const PanelStep& maps, Panel& next) {
  const Index n = system().size();
  double* g = gradient_of(s);
  if (system().support_size() > 0) {
    system().to_values(plus_.row(system().support_begin()), values());
    system().potential().mean_gradient(values(), slopes());
    system().to_coordinates(slopes(), g);
  }
  maps.all_forces.apply(g, q_.row(0));
  PanelValues distance, size, force;
  add_and_compare(linear_.row(0), q_.row(0), plus_.row(0), n, next.row(0), distance, size, force);
  for (std::size_t l = 0; l < update_.size(); ++l)
    update_[l] = distance[l] / std::max(4 * epsilon * (size[l] + force[l]), std::numeric_limits<double>::min());
}

//   z⁺ = Ez + F ∫₀¹ ∇V(z + s(z⁺ − z)) ds
void PanelAvf::advance(PanelState& s, const PanelStep& maps, RowFactors after, PanelState& next, PanelReport& report) {
  const Index n = system().size();
  double* z = s.z.row(0);
  double* g = gradient_of(s);
  std::memset(g, 0, sizeof(double) * static_cast<std::size_t>(system().support_size() * panel_members));
  maps.step.add_to(z, z, linear_.row(0));  // with g = 0
  if (system().support_size() > 0) {
    system().to_values(s.z.row(system().support_begin()), values());
    system().potential().begin_means(values());
    predict(s, maps);  // ẑ
    PanelValues unused;
    system().potential().value_and_gradient(values(), slopes(), unused);
    system().to_coordinates(slopes(), g);
    keep_gradient(s);
  }
  maps.all_forces.add_to(linear_.row(0), g, plus_.row(0));  // the explicit step

  PanelValues waiting, previous;
  waiting.fill(1);
  previous.fill(std::numeric_limits<double>::infinity());
  Panel& swept = next.z;
  for (int i = 0; i < max_sweeps && std::any_of(waiting.begin(), waiting.end(), [](double w) { return w != 0; }); ++i) {
    sweep(s, maps, swept);
    copy_members(swept.row(0), waiting, n, plus_.row(0));
    for (std::size_t l = 0; l < waiting.size(); ++l) {
      if (waiting[l] == 0) continue;
      ++report.scalar_iterations[l];
      const double update = update_[l];
      if (update <= 1 || (update <= stagnation && update >= previous[l])) {
        waiting[l] = 0;
      } else if (!(update < 1e3 * previous[l])) {  // diverges, or is not a number
        waiting[l] = 0;
        report.trouble[l] = 1;
      }
      previous[l] = update;
    }
  }
  std::memcpy(next.z.row(0), plus_.row(0), sizeof(double) * static_cast<std::size_t>(n * panel_members));
  damp_rows(after, n, next.z.row(0));
  PanelValues lost;
  find_not_finite(next.z.row(0), n, lost);
  for (std::size_t l = 0; l < waiting.size(); ++l)
    if (waiting[l] != 0 || lost[l] != 0) report.trouble[l] = 1;
}

}  // namespace

std::unique_ptr<PanelStepper> make_panel_avf(std::unique_ptr<PanelSystem> system, const MethodEntry& method,
                                             const MethodOptions& options) {
  return std::make_unique<PanelAvf>(std::move(system), method, options);
}

}  // namespace seiche
