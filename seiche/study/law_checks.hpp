// The paper's theorems as experiments: energy laws at step sizes from small to very large.
#pragma once

#include <seiche/study/evidence.hpp>
#include <seiche/study/examples.hpp>

namespace seiche {

// Fills the parts of `evidence` that speak of laws.
void check_laws(Evidence& evidence, const std::vector<PaperExample>& examples, bool quick);

}  // namespace seiche
