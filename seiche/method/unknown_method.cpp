#include <seiche/core/base/shortened.hpp>
#include <seiche/method/unknown_method.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace seiche {
namespace {

struct OtherMethods {
  std::string_view here;
  std::vector<std::string_view> names;  // lower case, without "_", "-" and blanks
};

const std::vector<OtherMethods>& of_other_programs() {
  static const std::vector<OtherMethods> all = {
      {"seimp", {"midpoint", "implicitmidpoint", "cranknicolson", "trapezoidal", "trapezoid", "gauss2", "heun", "rk2"}},
      {"strang_exact", {"verlet", "velocityverlet", "stormerverlet", "leapfrog", "strang", "splitstep", "symplectic"}},
      {"chin4", {"yoshida", "yoshida4", "forestruth", "mclachlan", "suzuki4"}},
      {"crkn4", {"rkn", "rkn4", "nystrom", "nystrom4"}},
      {"egc4",
       {"rk4", "rk45", "dopri5", "dop5", "ode45", "tsit5", "rungekutta", "rungekutta4", "lsoda", "bdf", "radau",
        "ode15s", "gauss", "gauss4", "collocation"}},
      {"egc8", {"dop853", "rk8", "vern8", "vern9", "gauss8", "dopri853"}},
      {"etdrk4", {"etd", "etdrk", "exprb4", "ifrk4", "krogstad", "lawson4"}},
  };
  return all;
}

}  // namespace

Error unknown_method(std::string_view name, const std::vector<std::string>& allowed) {
  std::string plain;
  for (const char c : name)
    if (c != '_' && c != '-' && c != ' ') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const OtherMethods& other : of_other_programs()) {
    if (std::find(other.names.begin(), other.names.end(), plain) == other.names.end()) continue;
    const MethodEntry& method = find_method(other.here);
    return Error({.sentence = fmt::format("unknown method '{}'; in its place there is '{}', of order {}. Allowed: {}",
                                          shortened(name), method.name, method.order, fmt::join(allowed, ", ")),
                  .kind = "method",
                  .name = shortened(name),
                  .nearest = std::string(method.name),
                  .allowed = allowed});
  }
  return unknown_name("method", name, allowed);
}

}  // namespace seiche
