// Averaged vector field closure on panels: the fixed point of method/closure/avf.cpp, each member until it is there.
#pragma once

#include <seiche/ensemble/panel_stepper.hpp>

#include <memory>

namespace seiche {

std::unique_ptr<PanelStepper> make_panel_avf(std::unique_ptr<PanelSystem> system, const MethodEntry& method,
                                             const MethodOptions& options);

}  // namespace seiche
