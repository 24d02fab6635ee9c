#pragma once

#include <seiche/core/phi.hpp>

namespace seiche {

// φ-functions whose maps are tables, so that to apply one costs no more than a gradient of V or two. Where every map is a Krylov
// space or a chain of factorisations, methods must ask for as few as they can.
class TabulatedPhi : public PhiEvaluator {};

}  // namespace seiche
