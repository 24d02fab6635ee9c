#include <seiche/core/commuting_damping.hpp>
#include <seiche/core/numerics/norm_bound.hpp>
#include <seiche/ensemble/panel_system.hpp>
#include <seiche/ensemble/row_loops.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

using Matrix = Eigen::MatrixXd;

// The matrix of a map of State::z, between these components of it.
template <class Map>
Matrix probe(Index size, const std::vector<Index>& rows, const std::vector<Index>& columns, const Map& map) {
  Matrix a(static_cast<Index>(rows.size()), static_cast<Index>(columns.size()));
  Vector in = Vector::Zero(size);
  Vector out = Vector::Zero(size);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    in[columns[j]] = 1;
    map(in, out);
    a.col(static_cast<Index>(j)) = out(rows);
    in[columns[j]] = 0;
  }
  return a;
}

Matrix side_by_side(const Matrix& a, const Matrix& b) {
  Matrix both(a.rows(), a.cols() + b.cols());
  both << a, b;
  return both;
}

// e^{−hD} of the constant part alone.
Matrix constant_flow(const Simulation& simulation, double h, const std::vector<Index>& places) {
  Problem constant = simulation.problem();
  constant.damping.rate = nullptr;
  const System system = simulation.backend().system(constant, {});
  return probe(system.space->size(), places, places, [&](const Vector& in, Vector& out) {
    out = in;
    system.damping->flow(0, h, out);
  });
}

// May both be held by the same rows of a panel?
bool have_one_shape(const Problem& a, const Problem& b) {
  const auto same_axis = [](const GridAxis& x, const GridAxis& y) {
    return x.intervals == y.intervals && x.boundary == y.boundary;
  };
  const bool same_potential = a.potential && b.potential ? a.potential_field == b.potential_field &&
                                                               a.potential->fields() == b.potential->fields()
                                                         : !a.potential && !b.potential;
  return a.field_count() == b.field_count() && same_potential &&
         std::equal(a.grid.axes.begin(), a.grid.axes.end(), b.grid.axes.begin(), b.grid.axes.end(), same_axis);
}

}  // namespace

PanelQuadratic::PanelQuadratic(std::span<const Matrix> matrices) : rows_(matrices.front().rows()) {
  if (!std::all_of(matrices.begin(), matrices.end(), [](const Matrix& a) { return a.isDiagonal(0); })) {
    map_ = BlockMap(matrices);
    return;
  }
  diagonal_ = Panel(rows_);
  for (Index j = 0; j < rows_; ++j)
    for (Index l = 0; l < panel_members; ++l)
      diagonal_(j, l) = matrices[matrices.size() > 1 ? static_cast<std::size_t>(l) : 0](j, j);
}

void PanelQuadratic::operator()(const double* x, PanelValues& sum) const {
  if (diagonal() != nullptr) {
    measure(x, diagonal(), rows_, sum);
  } else {
    map_.dot(x, x, sum);
  }
}

std::unique_ptr<PanelSystem> PanelSystem::make(PanelSimulations members, PropagatorKind kind) {
  const Simulation& first = *members.front();
  for (const Simulation* member : members)
    if (member->problem().damping.field_rate || member->problem().friction || member->problem().has_forces() ||
        member->problem().structure || &member->backend() != &first.backend() ||
        !have_one_shape(member->problem(), first.problem()))
      return nullptr;
  std::unique_ptr<PanelSystem> system(new PanelSystem(members, kind));
  if (!system->find_transform()) return nullptr;
  system->find_metrics();
  return system;
}

PanelSystem::PanelSystem(PanelSimulations members, PropagatorKind kind)
    : columns_(members.begin(), members.end()), members_(columns_), kind_(kind) {
  if (std::all_of(members_.begin(), members_.end(), [&](const Simulation* s) { return s == members_.front(); }))
    members_.resize(1);
}

// The orthonormal matrix by which the backend takes each field to coordinates, the same for all; without its rows of
// zeros.
bool PanelSystem::find_transform() {
  const Problem& problem = columns_.front()->problem();
  const Space& space = *columns_.front()->system().space;
  const Index points = problem.grid.unknowns();
  fields_ = problem.field_count();
  if (space.physical_size() != fields_ * points || space.size() % fields_ != 0) return false;
  const Index slots = space.size() / fields_;

  Matrix all(space.size(), space.physical_size());
  Vector z(space.size());
  for (Index j = 0; j < space.physical_size(); ++j) {
    space.from_physical(Vector::Unit(space.physical_size(), j), z);
    all.col(j) = z;
  }
  const Matrix T = all.topLeftCorner(slots, points);
  std::vector<Index> used;
  for (Index i = 0; i < slots; ++i)
    if (!T.row(i).isZero(0)) used.push_back(i);
  for (Index f = 0; f < fields_; ++f) {
    if (all.block(f * slots, f * points, slots, points) != T) return false;
    all.block(f * slots, f * points, slots, points).setZero();
    for (const Index i : used) place_.push_back(f * slots + i);
  }
  field_size_ = static_cast<Index>(used.size());
  const Matrix rows = T(used, Eigen::all);
  if (!all.isZero(0) || field_size_ != points || !(rows * rows.transpose()).isIdentity(1e-12)) return false;
  transform_ = FoldedTransform(rows);

  for (const Simulation* member : members_) {
    damping_moves_potential_ = damping_moves_potential_ || member->system().damping->touches_potential();
    has_constant_damping_ = has_constant_damping_ || member->problem().has_constant_damping();
    rates_commute_ = rates_commute_ && rate_commutes(member->problem());
    const RatePointer& rate = member->problem().damping.rate;
    has_constant_rates_ = has_constant_rates_ && (!rate || rate->is_constant());
  }
  if (!problem.potential) return true;
  support_begin_ = problem.potential_field * field_size_;
  support_size_ = problem.potential->fields() * field_size_;
  std::vector<std::shared_ptr<const PointwisePotential>> potentials;
  for (const Simulation* member : columns_) potentials.push_back(member->problem().potential);
  potential_ = potentials.front()->for_members(potentials, support_size_);
  return true;
}

void PanelSystem::find_metrics() {
  std::vector<Matrix> M, absolute;
  for (const Simulation* member : members_) {
    const LinearPart& linear = *member->system().linear;
    M.push_back(probe(member->system().space->size(), place_, place_,
                      [&](const Vector& in, Vector& out) { linear.apply_M(in, out); }));
    absolute.emplace_back(M.back().cwiseAbs());
  }
  metric_ = PanelQuadratic(M);
  absolute_metric_ = PanelQuadratic(absolute);
}

const PanelStep& PanelSystem::at(double h) {
  for (const auto& [length, step] : steps_)
    if (length == h) return step;
  return steps_.emplace_back(h, make_step(h)).second;
}

PanelStep PanelSystem::make_step(double h) const {
  std::vector<Matrix> predict, increment, force, step, all_forces, flow;
  std::vector<double> shares;
  const std::vector<Index> support(place_.begin() + support_begin_, place_.begin() + support_begin_ + support_size_);
  for (const Simulation* member : members_) {
    const System& system = member->system();
    const Index n = system.space->size();
    const std::unique_ptr<Propagator> propagator = system.linear->propagator(kind_, h);
    const Vector zero = Vector::Zero(n);
    const Matrix Q =
        probe(n, support, support, [&](const Vector& in, Vector& out) { propagator->predict(zero, in, out); });
    predict.push_back(side_by_side(probe(n, support, place_,
                                         [&](const Vector& in, Vector& out) { propagator->predict(in, zero, out); }),
                                   Q));
    shares.push_back(squared_norm_bound(Q));
    const Matrix FM = probe(n, place_, place_, [&](const Vector& in, Vector& out) { propagator->increment(in, out); });
    const Matrix F = probe(n, place_, support, [&](const Vector& in, Vector& out) { propagator->force(in, out); });
    increment.emplace_back(FM.middleRows(support_begin_, support_size_));
    force.emplace_back(F.middleRows(support_begin_, support_size_));
    step.push_back(side_by_side(FM, F));
    all_forces.push_back(F);
    if (has_constant_damping_) flow.push_back(constant_flow(*member, rates_commute_ ? h / 2 : h / 4, place_));
  }
  PanelStep maps{BlockMap(predict),    {}, BlockMap(increment), PanelQuadratic(force), BlockMap(step),
                 BlockMap(all_forces), {}};
  for (std::size_t l = 0; l < maps.gradient_share.size(); ++l)
    maps.gradient_share[l] = shares[shares.size() > 1 ? l : 0];
  if (!flow.empty()) maps.flow = BlockMap(flow);
  return maps;
}

void PanelSystem::to_values(const double* support, double* values) const {
  for (Index row = 0; row < support_size_; row += field_size_)
    transform_.inverse(support + row * panel_members, values + row * panel_members);
}

void PanelSystem::to_coordinates(double* values, double* support) const {
  for (Index row = 0; row < support_size_; row += field_size_)
    transform_.forward(values + row * panel_members, support + row * panel_members);
}

void PanelSystem::load(const Vector& z, Index member, Panel& panel) const {
  for (Index j = 0; j < size(); ++j) panel(j, member) = z[place_[static_cast<std::size_t>(j)]];
}

void PanelSystem::store(const Panel& panel, Index member, Vector& z) const {
  z.setZero(columns_[static_cast<std::size_t>(member)]->system().space->size());
  for (Index j = 0; j < size(); ++j) z[place_[static_cast<std::size_t>(j)]] = panel(j, member);
}

void PanelSystem::load_support(const Vector& z, Index member, Panel& panel) const {
  for (Index j = 0; j < support_size_; ++j) panel(j, member) = z[place_[static_cast<std::size_t>(support_begin_ + j)]];
}

void PanelSystem::store_support(const Panel& panel, Index member, Vector& z) const {
  z.setZero(columns_[static_cast<std::size_t>(member)]->system().space->size());
  for (Index j = 0; j < support_size_; ++j) z[place_[static_cast<std::size_t>(support_begin_ + j)]] = panel(j, member);
}

void PanelSystem::decay(double t, double h, std::vector<PanelValues>& factors) const {
  factors.resize(static_cast<std::size_t>(fields_));
  for (PanelValues& field : factors) field.fill(1);
  const Rate* last = nullptr;
  double factor = 1;
  for (std::size_t l = 0; l < columns_.size(); ++l) {
    const LinearDamping& damping = columns_[l]->problem().damping;
    if (!damping.rate) continue;
    if (damping.rate.get() != last) factor = std::exp(-damping.rate->integral(t, h));
    last = damping.rate.get();
    for (std::size_t f = 0; f < factors.size(); ++f)
      if (damping.rate_fields[f]) factors[f][l] = factor;
  }
}

}  // namespace seiche
