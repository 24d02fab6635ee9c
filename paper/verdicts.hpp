// Every claim that the paper makes about its experiments, decided from what was measured here.
#pragma once

#include <paper/evidence.hpp>
#include <paper/results.hpp>

#include <vector>

namespace seiche {

// Needs all five examples. Quick runs are judged by the same code.
std::vector<Verdict> judge(const PaperResults& results, const Evidence& evidence);

}  // namespace seiche
