// Steps in which no solution was found, and something that keeps the law stands for one.
#pragma once

#include <seiche/core/control/archive.hpp>

#include <cstdint>
#include <string_view>

namespace seiche {

struct ReplacedSteps {
  std::int64_t count = 0;
  bool lost_state = false;                 // what stands for one of them lost nine tenths of z
  std::string_view why = {}, remedy = {};  // why the first of them was replaced, and what helps; literals

  void archive(Archive& a) {
    a(count, lost_state);
    a.literal(why);
    a.literal(remedy);
  }
  ReplacedSteps& operator+=(const ReplacedSteps& other) {
    if (count == 0) {
      why = other.why;
      remedy = other.remedy;
    }
    count += other.count;
    lost_state = lost_state || other.lost_state;
    return *this;
  }
};

}  // namespace seiche
