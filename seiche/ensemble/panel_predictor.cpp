#include <seiche/ensemble/panel_predictor.hpp>
#include <seiche/ensemble/row_loops.hpp>
#include <seiche/method/closure/midpoint_predictor.hpp>

#include <algorithm>
#include <cstring>

namespace seiche {

PanelPredictor::PanelPredictor(const PanelSystem& system, Predictor kind)
    : system_(system), remembers_(kind == Predictor::remembered) {
  if (!remembers_) return;
  for (Panel* panel : {&gradients_[0], &gradients_[1], &gradients_[2], &kept_, &by_gradient_})
    *panel = Panel(system.support_size());
  difference_ = Panel(system.size() + system.support_size());
}

void PanelPredictor::predict(const double* z, double* g, const PanelStep& maps, double h, double* z_mid,
                             FunctionRef<void()> take_gradient) {
  has_missed_.fill(0);
  const auto by_gradient = [&](double* out) {
    take_gradient();
    maps.predict.apply(z, out);
  };
  if (!remembers_) return by_gradient(z_mid);
  const double weight = midpoint_memory::weight(lengths_, h);
  find_unable(weight);
  if (std::none_of(unable_.begin(), unable_.end(), [](double member) { return member == 0; }))
    return by_gradient(z_mid);
  PanelValues second_difference;
  extrapolate_rows(gradients_[0].row(0), gradients_[1].row(0), gradients_[2].row(0), weight,
                   midpoint_memory::ratio(lengths_), system_.support_size(), g, second_difference);
  maps.predict.apply(z, z_mid);
  find_missed(z, z_mid, maps, second_difference);
  if (!any_unable()) return;
  by_gradient(by_gradient_.row(0));
  copy_members(by_gradient_.row(0), unable_, system_.support_size(), z_mid);
}

bool PanelPredictor::any_unable() const {
  return std::any_of(unable_.begin(), unable_.end(), [](double member) { return member != 0; });
}

void PanelPredictor::find_unable(double weight) {
  for (std::size_t l = 0; l < unable_.size(); ++l)
    unable_[l] = known_[l] >= MidpointMemory::depth && resting_[l] == 0 && midpoint_memory::reaches(weight) ? 0.0 : 1.0;
}

void PanelPredictor::find_missed(const double* z, const double* z_mid, const PanelStep& maps,
                                 const PanelValues& second_difference) {
  PanelValues moved, missed;
  sum_squared_distances(z_mid, z + system_.support_begin() * panel_members, system_.support_size(), moved);
  const auto predicts_well = [&](std::size_t l) {
    return unable_[l] != 0 || midpoint_memory::predicts_well(missed[l], moved[l]);
  };
  bool all = true;
  for (std::size_t l = 0; l < unable_.size(); ++l) {
    missed[l] = maps.gradient_share[l] * second_difference[l];
    all = all && predicts_well(l);
  }
  if (all) return;
  missed = measure_missed(maps);
  for (std::size_t l = 0; l < unable_.size(); ++l)
    if (!predicts_well(l)) unable_[l] = has_missed_[l] = 1;
}

PanelValues PanelPredictor::measure_missed(const PanelStep& maps) {
  const Index n = system_.support_size();
  const double ratio = midpoint_memory::ratio(lengths_);
  const double *a = gradients_[0].row(0), *b = gradients_[1].row(0), *c = gradients_[2].row(0);
  double* const d = difference_.row(system_.size());
  for (Index i = 0; i < n * panel_members; ++i) d[i] = (a[i] - b[i]) - ratio * (b[i] - c[i]);
  maps.predict.apply(difference_.row(0), by_gradient_.row(0));
  PanelValues missed;
  const double* const zeros = difference_.row(0);
  sum_squared_distances(by_gradient_.row(0), zeros, n, missed);
  return missed;
}

void PanelPredictor::keep(const double* g, double h) {
  if (!remembers_) return;
  std::memcpy(kept_.row(0), g, sizeof(double) * static_cast<std::size_t>(system_.support_size() * panel_members));
  kept_length_ = h;
  for (std::size_t l = 0; l < known_.size(); ++l) {
    kept_known_[l] = std::min<double>(known_[l] + 1, MidpointMemory::depth);
    kept_resting_[l] = midpoint_memory::resting(resting_[l], has_missed_[l] != 0);
  }
}

void PanelPredictor::accept() {
  if (!remembers_) return;
  std::rotate(gradients_.begin(), gradients_.end() - 1, gradients_.end());
  std::rotate(lengths_.begin(), lengths_.end() - 1, lengths_.end());
  std::swap(gradients_[0], kept_);
  lengths_[0] = kept_length_;
  known_ = kept_known_;
  resting_ = kept_resting_;
}

void PanelPredictor::load(const State& state, Index member) {
  const MidpointMemory& memory = state.midpoints;
  if (!remembers_) return;
  const auto l = static_cast<std::size_t>(member);
  known_[l] = memory.known;
  resting_[l] = memory.resting;
  for (std::size_t i = 0; i < memory.gradients.size(); ++i) {
    system_.load_support(memory.gradients[i], member, gradients_[i]);
    if (memory.known > static_cast<int>(i)) lengths_[i] = memory.lengths[i];
  }
}

void PanelPredictor::store(Index member, State& state) const {
  if (!remembers_) return;
  const auto l = static_cast<std::size_t>(member);
  MidpointMemory& memory = state.midpoints;
  memory.known = static_cast<int>(known_[l]);
  memory.resting = static_cast<int>(resting_[l]);
  memory.gradients.resize(gradients_.size());
  memory.lengths.assign(lengths_.begin(), lengths_.end());
  for (std::size_t i = 0; i < gradients_.size(); ++i) system_.store_support(gradients_[i], member, memory.gradients[i]);
}

void PanelPredictor::mend(const State& state, Index member) {
  if (!remembers_) return;
  const auto l = static_cast<std::size_t>(member);
  kept_known_[l] = state.midpoints.known;
  kept_resting_[l] = state.midpoints.resting;
  if (state.midpoints.known > 0) system_.load_support(state.midpoints.gradients.front(), member, kept_);
}

}  // namespace seiche
