// Steps in which no solution was found, and something that keeps the law stands for one.
#pragma once

#include <seiche/core/control/archive.hpp>

#include <cstdint>
#include <string_view>

namespace seiche {

struct ReplacedSteps {
  std::int64_t count = 0;
  bool ruinous = false;                    // did what stands for one lose nine tenths of z?
  std::string_view why = {}, remedy = {};  // why the first of them was replaced, and what helps; literals

  void archive(Archive& a) {
    a(count, ruinous);
    a.literal(why);
    a.literal(remedy);
  }
  ReplacedSteps& operator+=(const ReplacedSteps& other) {
    if (count == 0) {
      why = other.why;
      remedy = other.remedy;
    }
    count += other.count;
    ruinous = ruinous || other.ruinous;
    return *this;
  }
};

}  // namespace seiche
