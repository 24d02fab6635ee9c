// Scalar auxiliary variable closure on lanes: the same lines as method/closure/sav.cpp.
#pragma once

#include <seiche/ensemble/lane_stepper.hpp>

#include <memory>

namespace seiche {

std::unique_ptr<LaneStepper> make_lane_sav(std::unique_ptr<LaneSystem> system, const MethodEntry& method,
                                           const MethodOptions& options);

}  // namespace seiche
