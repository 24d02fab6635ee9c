// A block whose members step side by side in the columns of panels.
#pragma once

#include <seiche/ensemble/member_block.hpp>
#include <seiche/ensemble/panel_stepper.hpp>

#include <memory>
#include <span>

namespace seiche {

// Steps that a member cannot take (V(ẑ) + C ≤ 0, a fixed point that does not contract, NaN or infinity) go to
// the ordinary stepper of that member, which takes the step another way or says why it cannot. Where a member has no
// propagator for the step, the ordinary steppers take over the whole block.
class PanelBlock final : public MemberBlock {
 public:
  void archive(Archive& a) override;

 private:
  friend std::unique_ptr<MemberBlock> make_block(std::span<const EnsembleMember>, const SimulationOptions&);
  using MemberBlock::MemberBlock;
  bool find_stepper(const MethodOptions& options);
  void load_all();
  void step_all(std::int64_t n, double t, double h) override;
  void read_energies(std::array<EnergyReading, panel_members>& readings) override;
  void update_state(Index member) override;

  std::unique_ptr<PanelStepper> stepper_;  // null: the ordinary steppers have taken over
  PanelReport report_;
  State at_rest_;
};

// Panels where the method is written for them and the members allow it, else one member after the other. With backend
// "auto", members take modal coordinates wherever there are some.
std::unique_ptr<MemberBlock> make_block(std::span<const EnsembleMember> members, const SimulationOptions& options);

}  // namespace seiche
