// Averaged vector field closure on lanes: the fixed point of method/closure/avf.cpp, each lane until it is there.
#pragma once

#include <seiche/ensemble/lane_stepper.hpp>

#include <memory>

namespace seiche {

std::unique_ptr<LaneStepper> make_lane_avf(std::unique_ptr<LaneSystem> system, const MethodEntry& method);

}  // namespace seiche
