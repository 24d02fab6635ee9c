// The terms of a formula as their author wrote them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace seiche {

struct WrittenSummand {
  bool is_subtracted = false;
  std::string text;
};

// "v^2/2 - (a + b)*u" is + "v^2/2" and − "(a + b)*u". Of a formula that can be read.
std::vector<WrittenSummand> written_summands(std::string_view formula);

std::string sum_text(const std::vector<WrittenSummand>& summands);  // "0" without any

}  // namespace seiche
