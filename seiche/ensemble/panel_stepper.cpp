#include <seiche/ensemble/panel_avf.hpp>
#include <seiche/ensemble/panel_sav.hpp>
#include <seiche/ensemble/panel_stepper.hpp>
#include <seiche/ensemble/row_loops.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace seiche {
namespace {

void copy_rows(const double* in, Index rows, double* out) {
  std::memcpy(out, in, sizeof(double) * static_cast<std::size_t>(rows * panel_members));
}

void copy_scalars(const PanelState& from, PanelState& to) {
  to.r_squared = from.r_squared;
  to.shift = from.shift;
  to.energy_scale = from.energy_scale;
}

}  // namespace

PanelStepper::PanelStepper(std::unique_ptr<PanelSystem> system, const MethodEntry& method, Predictor predictor)
    : system_(std::move(system)), predictor_(*system_, predictor), splits_damping_(method.kind.splits_damping) {
  for (PanelState* s : {&first_, &second_, &work_}) {
    s->z = Panel(system_->size() + system_->support_size());
    s->r_squared.fill(1);  // columns without a member rest at z = 0
    s->shift.fill(1);
  }
  values_ = Panel(system_->support_size());
  slopes_ = Panel(system_->support_size());
  none_.of_field.resize(static_cast<std::size_t>(system_->fields()));
  for (PanelValues& field : none_.of_field) field.fill(1);
  set_rows(none_);
}

void PanelStepper::load(const State& state, Index member) {
  load_values(state, member);
  predictor_.load(state, member);
}

void PanelStepper::load_values(const State& state, Index member) {
  const auto l = static_cast<std::size_t>(member);
  system_->load(state.z, member, state_->z);
  state_->r_squared[l] = state.r_squared;
  state_->shift[l] = state.shift;
  state_->energy_scale[l] = state.energy_scale;
}

void PanelStepper::predict(PanelState& s, const PanelStep& maps) {
  double* const g = gradient_of(s);
  predictor_.predict(s.z.row(0), g, maps, step_size_, slopes(), [&] {
    system_->to_values(s.z.row(system_->support_begin()), values());
    PanelValues unused;
    system_->potential().value_and_gradient(values(), values(), unused);
    system_->to_coordinates(values(), g);
  });
  system_->to_values(slopes(), values());
}

void PanelStepper::store(Index member, State& state) const {
  const auto l = static_cast<std::size_t>(member);
  system_->store(state_->z, member, state.z);
  state.r_squared = state_->r_squared[l];
  state.shift = state_->shift[l];
  state.energy_scale = state_->energy_scale[l];
  predictor_.store(member, state);
}

void PanelStepper::mend(const State& state, Index member) {
  std::swap(state_, next_);
  load_values(state, member);
  std::swap(state_, next_);
  predictor_.mend(state, member);
}

void PanelStepper::accept() {
  std::swap(state_, next_);
  predictor_.accept();
}

void PanelStepper::set_rows(Decay& decay) {
  decay.of_row.clear();
  for (const PanelValues& field : decay.of_field)
    decay.of_row.insert(decay.of_row.end(), static_cast<std::size_t>(system_->field_size()), field.data());
}

RowFactors PanelStepper::factors(Decay& decay, double t, double h) {
  if (decay.h != h || !system_->has_constant_rates()) system_->decay(t, h, decay.of_field);
  if (decay.of_row.empty()) set_rows(decay);
  decay.h = h;
  return decay.of_row.data();
}

// Where a half-flow is nothing but a factor for every field, it is made on the way: the first with the copy that keeps
// the state before the step, the second with the sum that makes the new one.
void PanelStepper::step(double t, double h, PanelReport& report) {
  report = PanelReport{};
  step_size_ = h;
  const PanelStep& maps = system_->at(h);
  const bool on_the_way = damps_z_only() && maps.flow.rows() == 0;
  is_measured_ = false;
  if (splits_damping_) {
    copy_scalars(*state_, work_);
    if (on_the_way && system_->metric().diagonal() != nullptr) {
      damp_and_measure(state_->z.row(0), factors(before_, t, h / 2), system_->metric().diagonal(), system_->size(),
                       work_.z.row(0), quadratic_);
      is_measured_ = true;
    } else {
      copy_rows(state_->z.row(0), system_->size(), work_.z.row(0));
      damp(work_, t, h / 2);
    }
  }
  PanelState& start = splits_damping_ ? work_ : *state_;
  copy_scalars(start, *next_);
  const bool last_on_the_way = splits_damping_ && on_the_way;
  advance(start, maps, last_on_the_way ? factors(after_, t + h / 2, h / 2) : none_.of_row.data(), *next_, report);
  if (!splits_damping_ || last_on_the_way) return;
  damp(*next_, t + h / 2, h / 2);
  PanelValues lost;
  find_not_finite(next_->z.row(0), system_->size(), lost);
  for (std::size_t l = 0; l < lost.size(); ++l)
    if (lost[l] != 0) report.trouble[l] = 1;
}

const PanelValues& PanelStepper::twice_quadratic_energy(const PanelState& s) {
  if (!is_measured_) system_->metric()(s.z.row(0), quadratic_);
  return quadratic_;
}

void PanelStepper::flow(PanelState& s, double t, double h) {
  const PanelStep& maps = system_->at(step_size_);
  const bool has_constant = maps.flow.rows() > 0;
  if (has_constant && !system_->rates_commute()) apply_flow(maps.flow, s);
  damp_rows(factors(before_, t, h), system_->size(), s.z.row(0));
  if (has_constant) apply_flow(maps.flow, s);
}

void PanelStepper::apply_flow(const BlockMap& flow, PanelState& s) {
  if (moved_.rows() == 0) moved_ = Panel(s.z.rows());
  flow.apply(s.z.row(0), moved_.row(0));
  std::swap(s.z, moved_);
}

void PanelStepper::potential_of(const PanelState& s, PanelValues& v, PanelValues& magnitude) {
  v.fill(0);
  magnitude.fill(0);
  if (system_->support_size() == 0) return;
  system_->to_values(s.z.row(system_->support_begin()), values());
  system_->potential().value_and_magnitude(values(), v, magnitude);
}

void PanelStepper::energy(std::array<EnergyReading, panel_members>& readings) {
  PanelValues v, v_size, quadratic, size;
  potential_of(*state_, v, v_size);
  const double* z = state_->z.row(0);
  system_->metric()(z, quadratic);
  Panel absolute(system_->size());
  for (Index i = 0; i < system_->size() * panel_members; ++i) absolute.row(0)[i] = std::abs(z[i]);
  system_->absolute_metric()(absolute.row(0), size);
  for (std::size_t l = 0; l < readings.size(); ++l) {
    quadratic[l] /= 2;
    readings[l].H = readings[l].modified = quadratic[l] + v[l];
    readings[l].round_off = readings[l].modified_round_off = 50 * epsilon * (size[l] + v_size[l]);
    readings[l].size = size[l] / 2 + std::abs(v[l]);
  }
  modified_energy(*state_, quadratic, readings);
}

std::unique_ptr<PanelStepper> make_panel_stepper(PanelSimulations members, const MethodOptions& options) {
  const MethodEntry& method = members.front()->method();
  if (method.kind.members == MembersTogether::none) return nullptr;
  const MethodOptions chosen = settled(method, members.front()->system(), options);
  if (chosen.auxiliary == AuxiliaryMode::relaxed) return nullptr;
  std::unique_ptr<PanelSystem> system = PanelSystem::make(members, method.propagator);
  if (!system) return nullptr;
  if (method.kind.members == MembersTogether::sav) return make_panel_sav(std::move(system), method, chosen);
  return make_panel_avf(std::move(system), method, chosen);
}

}  // namespace seiche
