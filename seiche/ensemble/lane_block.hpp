// A block whose members step side by side in the lanes of panels.
#pragma once

#include <seiche/ensemble/lane_stepper.hpp>
#include <seiche/ensemble/member_block.hpp>

#include <memory>
#include <span>

namespace seiche {

// Steps that a lane cannot take (V(ẑ) + C ≤ 0, a fixed point that does not contract, a number that is none) are handed
// to the ordinary stepper of that member, which finds the way or says why there is none. Where a member has no
// propagator for the step, the ordinary steppers take over the whole block.
class LaneBlock final : public MemberBlock {
 private:
  friend std::unique_ptr<MemberBlock> make_block(std::span<const EnsembleMember>, const SimulationOptions&);
  using MemberBlock::MemberBlock;
  bool find_stepper(const MethodOptions& options);
  void step_all(std::int64_t n, double t, double h) override;
  void read_energies(std::array<EnergyReading, lanes>& readings) override;
  void update_state(Index member) override;

  std::unique_ptr<LaneStepper> stepper_;  // null: the ordinary steppers have taken over
  LaneReport report_;
  State at_rest_;
};

// Lanes where the method is written for them and the members allow it, else one member after the other. With backend
// "auto", lanes take modal coordinates wherever there are some.
std::unique_ptr<MemberBlock> make_block(std::span<const EnsembleMember> members, const SimulationOptions& options);

}  // namespace seiche
