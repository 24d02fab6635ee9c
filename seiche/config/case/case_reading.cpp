#include <seiche/config/case/case_reading.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace seiche {

void CaseReading::complain(std::size_t order, std::string_view place, const Error& error) {
  complaints.push_back({order, error.at(place)});
}

void CaseReading::complain_about_source(std::string_view sentence) { complain(at_the_end, name, Error(sentence)); }

void CaseReading::throw_first_complaint() const {
  const auto first = std::min_element(complaints.begin(), complaints.end(),
                                      [](const auto& a, const auto& b) { return a.order < b.order; });
  if (first != complaints.end()) throw Error(first->error);
}

CaseValue default_value(const std::string& text) {
  CaseValue value;
  value.kind = CaseValue::Kind::text;
  value.text = text;
  return value;
}

bool is_one_of(const CaseEntry& entry, const std::vector<std::string>& keys) {
  return std::find(keys.begin(), keys.end(), entry.key) != keys.end();
}

}  // namespace seiche
