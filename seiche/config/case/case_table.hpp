// A case file as sections of keys and values in the order of the source, with what --set put over it. What the keys
// mean is not known here.
#pragma once

#include <seiche/config/data/case_value.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace seiche {

struct CaseEntry {
  std::string key;
  std::string place;  // of the key
  CaseValue value;
};

struct CaseSection {
  std::string name;
  std::string place;
  std::size_t order = 0;
  bool is_table = true;  // false for a key that stands outside every section
  std::vector<CaseEntry> entries = {};
};

struct CaseTable {
  std::vector<CaseSection> sections;
  const CaseSection* section(std::string_view name) const;
  const CaseValue* value(std::string_view section, std::string_view key) const;  // null: not given
};

// `name` is how errors call the file. Each override is "section.key=value", or "section.key.inner=value" for what
// stands in a table (problem.D.v=0.1 leaves its other entries as they are); the value is TOML where it can be read as
// that, and else a text, so that method.h=1/64 needs no quotes. Throws Error at the first mistake in the syntax, and
// before it parses where a text is larger or deeper than core/text/toml_depth allows.
CaseTable read_case_table(std::string_view text, std::string_view name, const std::vector<std::string>& overrides);

}  // namespace seiche
