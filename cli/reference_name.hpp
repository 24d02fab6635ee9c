// --reference, as `converge` and `paper` take it.
#pragma once

#include <seiche/core/base/error.hpp>
#include <seiche/study/reference.hpp>

#include <string>

namespace seiche::cli {

inline constexpr const char* reference_help = "odeint (Fehlberg 7(8) of Boost.odeint) or seavf (the paper's, slow)";

inline ReferenceKind find_reference(const std::string& name) {
  if (name == "odeint") return ReferenceKind::fehlberg78;
  if (name == "seavf") return ReferenceKind::seavf;
  throw unknown_name("reference", name, {"odeint", "seavf"});
}

}  // namespace seiche::cli
