// φ-functions of the modal backend: one small block per mode.
#pragma once

#include <seiche/core/phi.hpp>
#include <seiche/core/stencil.hpp>

#include <memory>

namespace seiche {

struct ModalOperators {
  Grid grid;
  BlockStencil S, M, D0;
  Index first, count;  // the fields that V depends on
  int threads;
};
std::unique_ptr<PhiEvaluator> modal_phi(const ModalOperators& operators);

}  // namespace seiche
