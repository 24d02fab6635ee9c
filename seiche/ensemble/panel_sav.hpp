// Scalar auxiliary variable closure on panels: the same lines as method/closure/sav.cpp.
#pragma once

#include <seiche/ensemble/panel_stepper.hpp>

#include <memory>

namespace seiche {

std::unique_ptr<PanelStepper> make_panel_sav(std::unique_ptr<PanelSystem> system, const MethodEntry& method,
                                             const MethodOptions& options);

}  // namespace seiche
