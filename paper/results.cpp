#include <paper/results.hpp>

namespace seiche {

std::string to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::holds: return "holds";
    case Outcome::does_not_hold: return "does not hold";
    case Outcome::depends: return "depends";
  }
  return "unknown";
}

}  // namespace seiche
