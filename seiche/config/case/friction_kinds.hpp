// The kinds of friction that problem.friction may name, with the keys of each.
#pragma once

#include <string>
#include <vector>

namespace seiche {

struct FrictionKey {
  std::string name;
  bool is_formula = false;         // in the velocity, the coordinate, t and the place; else a number ≥ 0
  std::string default_value = {};  // empty: it must be given
  bool is_positive = false;
};

struct FrictionKind {
  std::string name;
  std::vector<FrictionKey> keys;
};

const std::vector<FrictionKind>& friction_kinds();

}  // namespace seiche
