// What is said of a name that a formula does not know: where it does stand, or how one makes it known. The nearest name
// is no help for names of one letter.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

// A sentence about the name, or "" where there is nothing to say but which names there are, or the one that it is near
// to.
using NameAdvice = std::function<std::string(std::string_view name, bool is_near_another)>;

struct FormulaContext {
  enum class Kind { energy, constant_entry, damping_entry, rate, initial, friction, force };
  Kind kind;
  std::vector<std::string> fields;
  Index axes = 0;                 // of the grid; 0: there is no place
  bool takes_parameters = false;  // the user may name numbers of their own
};

NameAdvice advice_in(FormulaContext context);

bool is_unit(std::string_view name);  // s, Hz, kg: the language has none

}  // namespace seiche
