#include <seiche/core/base/error.hpp>
#include <seiche/ensemble/panel_block.hpp>

namespace seiche {
namespace {

// Above, folded transforms cost more than the fast ones of an ordinary run.
constexpr Index most_lane_points = 128;

bool may_take_members(const Problem& problem, const MethodEntry& method) {
  return method.kind.members != MembersTogether::none && problem.grid.unknowns() <= most_lane_points;
}

// Lanczos iteration is no fixed matrix that could be read off: what it makes of z depends on z, and on the force beside
// it.
bool may_iterate(const SimulationOptions& options) {
  return options.backend_options.sparse.exponential == ExponentialKind::lanczos &&
         (options.backend == "auto" || find_backend(options.backend).exponentials_by_krylov) &&
         find_method(options.method).propagator == PropagatorKind::exponential;
}

// The backend with modes that takes the problem, or null.
const BackendEntry* modal_backend(const Problem& problem) {
  for (const BackendEntry& backend : backends()) {
    if (!backend.has_modes) continue;
    try {
      backend.system(problem, {});
      return &backend;
    } catch (const Error&) {
    }
  }
  return nullptr;
}

}  // namespace

std::unique_ptr<MemberBlock> make_block(std::span<const EnsembleMember> members, const SimulationOptions& options) {
  const Problem& problem = *members.front().problem;
  if (options.noise.is_on() || !may_take_members(problem, find_method(options.method)))
    return std::make_unique<MemberBlock>(members, options);
  SimulationOptions chosen = options;
  if (options.backend == "auto")
    if (const BackendEntry* modal = modal_backend(problem)) chosen.backend = modal->name;
  if (may_iterate(chosen)) return std::make_unique<MemberBlock>(members, options);
  std::unique_ptr<PanelBlock> block(new PanelBlock(members, chosen));
  if (block->find_stepper(options.method_options)) return block;
  return std::make_unique<MemberBlock>(members, options);
}

// Columns without a member, or with one that could not start, take the matrices of another and rest at z = 0.
bool PanelBlock::find_stepper(const MethodOptions& options) {
  const Simulation* any = nullptr;
  for (Index m = 0; m < size(); ++m)
    if (status(m).running) any = simulation(m);
  if (any == nullptr) return false;
  std::vector<const Simulation*> all;
  for (Index l = 0; l < panel_members; ++l) all.push_back(l < size() && status(l).running ? simulation(l) : any);
  stepper_ = make_panel_stepper(all, options);
  if (!stepper_) return false;
  at_rest_.z.setZero(any->system().space->size());
  at_rest_.r_squared = at_rest_.shift = 1;
  load_all();
  return true;
}

void PanelBlock::load_all() {
  for (Index l = 0; l < panel_members; ++l) stepper_->load(l < size() && status(l).running ? state(l) : at_rest_, l);
}

void PanelBlock::archive(Archive& a) {
  bool side_by_side = stepper_ != nullptr;
  a(side_by_side);
  a.require(!side_by_side || stepper_ != nullptr);
  MemberBlock::archive(a);
  if (!side_by_side) stepper_.reset();
  if (a.reads() && side_by_side) load_all();
}

void PanelBlock::step_all(std::int64_t n, double t, double h) {
  try {
    if (stepper_) stepper_->step(t, h, report_);
  } catch (const Error&) {  // a member has no propagator; the ordinary steppers find out which
    for (Index m = 0; m < size(); ++m)
      if (status(m).running) update_state(m);
    stepper_.reset();
  }
  if (!stepper_) return MemberBlock::step_all(n, t, h);
  for (Index m = 0; m < size(); ++m) {
    const auto l = static_cast<std::size_t>(m);
    MemberStatus& member = status_of(m);
    if (report_.trouble[l] == 0) {
      member.scalar_iterations += report_.scalar_iterations[l];
      member.fallbacks += report_.fallbacks[l];
    } else if (member.running) {
      update_state(m);
      stepper_->mend(step_alone(m, n, t, h) ? state(m) : at_rest_, m);
    }
  }
  stepper_->accept();
}

void PanelBlock::read_energies(std::array<EnergyReading, panel_members>& readings) {
  if (!stepper_) return MemberBlock::read_energies(readings);
  stepper_->energy(readings);
}

void PanelBlock::update_state(Index member) {
  if (stepper_) stepper_->store(member, state(member));
}

}  // namespace seiche
