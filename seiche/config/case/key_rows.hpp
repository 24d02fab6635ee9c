// The keys of a case file beside those of the problem, one row each: how a key is read, written, listed and explained.
#pragma once

#include <seiche/config/case/run_spec.hpp>
#include <seiche/config/data/case_value.hpp>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace seiche {

struct CaseReading;
struct KeyRow;

// Of the value of a key into reading.spec. Throws Error with the key, the value and what is allowed.
using ReadKey = void(CaseReading& reading, const KeyRow& row, const std::string& key, const CaseValue& value);

struct KeyRow {
  enum class Kind { number, whole, choice, text };

  std::string section, name;
  std::string meaning;
  Kind kind = Kind::number;
  std::vector<std::string> choices = {};  // of a choice
  double minimum = -std::numeric_limits<double>::infinity();
  bool minimum_excluded = false;
  double maximum = std::numeric_limits<double>::infinity();
  std::string example = {};                // in the file that `seiche new` prints; "": the problem has one
  bool is_default = true;                  // what the example says holds also where the key is not given
  std::vector<std::string> synonyms = {};  // what other programs call it: lower case, without "_"

  std::function<ReadKey> read = nullptr;
  // As a case file says it; "" where the key may be left out.
  std::function<std::string(const RunSpec&)> write = nullptr;
};

// In the order of a case file. Rows of [ensemble] have no `read` and `write`: all of them belong to one EnsembleSpec.
const std::vector<KeyRow>& key_rows();
const KeyRow& key_row(const std::string& section, const std::string& name);  // throws Error for one that is not there

const std::vector<std::string>& case_sections();  // in the same order, [problem] first

}  // namespace seiche
