// A case file on its way to a RunSpec. Everything that can be read is read, and every complaint kept, so that the first
// one in the source can be thrown.
#pragma once

#include <seiche/config/case/case_table.hpp>
#include <seiche/config/case/run_spec.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/problem/problems.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

struct CaseReading {
  static constexpr std::size_t at_the_end = static_cast<std::size_t>(-1);

  std::string name;  // of the source
  std::filesystem::path folder;
  std::vector<std::string> methods;  // that will run it, where not its own does
  CaseTable table;
  RunSpec spec = {};
  const ProblemEntry* problem = nullptr;  // null after a complaint about its name

  struct Complaint {
    std::size_t order;
    Error error;
  };
  std::vector<Complaint> complaints = {};

  void complain(std::size_t order, std::string_view place, const Error& error);
  void complain_about_source(std::string_view sentence);  // of what is not there
  void throw_first_complaint() const;

  // Runs `read(key, value)` if the key is given; what it throws becomes a complaint at the value.
  template <class Read>
  bool on(const std::string& section, const std::string& key, Read read) {
    const CaseValue* value = table.value(section, key);
    if (value == nullptr) return false;
    try {
      read(section + "." + key, *value);
    } catch (const Error& error) {
      complain(value->order, value->place, error.under(section + "." + key));
    }
    return true;
  }

  bool gives(const std::string& section, const std::string& key) const { return table.value(section, key) != nullptr; }
  // Be it one that makes no sense: that is said once.
  bool asks_for_tolerance() const { return gives("method", "tolerance"); }
};

CaseValue default_value(const std::string& text);  // what a key that is not given is read from
bool is_one_of(const CaseEntry& entry, const std::vector<std::string>& keys);

}  // namespace seiche
