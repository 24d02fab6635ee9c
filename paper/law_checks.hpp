// The paper's theorems as experiments: energy laws at step sizes from small to very large.
#pragma once

#include <paper/evidence.hpp>
#include <paper/examples.hpp>

namespace seiche {

// Fills the parts of `evidence` that speak of laws.
void check_laws(Evidence& evidence, const std::vector<PaperExample>& examples, bool quick);

}  // namespace seiche
