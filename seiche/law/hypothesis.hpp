// One hypothesis of an energy law: its grade, how it was decided, and a witness if it fails.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace seiche {

enum class Grade {
  by_structure,  // follows from the form of the problem, exactly
  verified,      // computed, with a margin
  sampled,       // seen at finitely many points or times
  violated,      // a witness stands against it
};

struct Hypothesis {
  std::string name;  // "M ⪰ 0"
  Grade grade;
  std::string statement;                        // what was found, in a sentence
  std::optional<double> margin = std::nullopt;  // how far from failing, in the units of the hypothesis
  std::string witness = {};                     // the vector, mode, point or time that shows it
};

inline std::string to_string(Grade grade) {
  constexpr std::array names = {"by structure", "verified with margin", "sampled", "violated"};
  return names[static_cast<std::size_t>(grade)];
}

}  // namespace seiche
