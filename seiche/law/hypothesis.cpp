#include <seiche/law/hypothesis.hpp>

#include <array>

namespace seiche {

std::string to_string(Grade grade) {
  constexpr std::array names = {"by structure", "verified with margin", "sampled", "violated"};
  return names[static_cast<std::size_t>(grade)];
}

}  // namespace seiche
