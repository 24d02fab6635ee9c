// [method] of a case file, and the options of methods as its keys.
#pragma once

#include <seiche/config/case/case_value.hpp>
#include <seiche/method/methods.hpp>

#include <span>
#include <string>

namespace seiche {

struct CaseReading;

struct MethodOptionKey {
  std::string name;
  // Puts the value into the options; throws Error with the key, the value and what is allowed.
  void (*read)(MethodOptions& options, const std::string& key, const CaseValue& value);
};

std::span<const MethodOptionKey> method_option_keys();

void read_method_section(CaseReading& reading);  // into reading.spec, behind [time]

}  // namespace seiche
