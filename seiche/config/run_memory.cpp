#include <seiche/config/run_memory.hpp>

namespace seiche {
namespace {

double doubles_per_unknown(ClosureKind closure) {
  switch (closure) {
    case ClosureKind::sav: return 12;
    case ClosureKind::dm: return 21;
    case ClosureKind::avf: return 22;
    case ClosureKind::none: return 60;
    case ClosureKind::lm: break;
  }
  return 27;
}

}  // namespace

double run_bytes(const MethodEntry& method, const Problem& problem) {
  return 8 * doubles_per_unknown(method.closure) * static_cast<double>(problem.size());
}

}  // namespace seiche
