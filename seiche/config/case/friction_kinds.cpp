#include <seiche/config/case/friction_kinds.hpp>

namespace seiche {

const std::vector<FrictionKind>& friction_kinds() {
  static const std::vector<FrictionKind> kinds = {
      {"quadratic", {{"coefficient"}, {.name = "linear", .default_value = "0"}}},
      {"cubic", {{"coefficient"}}},
      {"tanh", {{"coefficient"}, {.name = "width", .is_positive = true}}},
      {"dry", {{"coefficient"}}},
      {"isotropic", {{"coefficient"}}},
      {"position", {{.name = "coefficient", .is_formula = true}}},
      {"formula", {{.name = "r", .is_formula = true}}},
  };
  return kinds;
}

}  // namespace seiche
