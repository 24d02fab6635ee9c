// φ-functions of the modal backend: one small block per mode.
#pragma once

#include <seiche/core/grid/stencil.hpp>
#include <seiche/core/phi.hpp>
#include <seiche/core/space.hpp>

#include <memory>

namespace seiche {

struct ModalOperators {
  Grid grid;
  BlockStencil S, M, D0;
  Index first = 0, count = 0;  // the fields that V depends on
  int threads = 1;
};
// `space` outlives it, and adds up what each process knows of the modes that it holds.
std::unique_ptr<PhiEvaluator> modal_phi(const ModalOperators& operators, const Space& space);

}  // namespace seiche
