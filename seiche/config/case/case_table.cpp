#include <seiche/config/case/case_table.hpp>
#include <seiche/config/data/syntax_complaint.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/characters.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/core/text/toml_depth.hpp>

#include <toml++/toml.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace seiche {
namespace {

using Kind = CaseValue::Kind;

constexpr std::size_t longest_place = 80;  // in a sentence, of what stands before it

// Where values stand: in a file, or after --set.
struct Source {
  std::string name;
  bool is_override = false;
  std::size_t override_number = 0;

  std::string place(const toml::source_region& region) const { return place(region.begin.line, region.begin.column); }
  std::string place(std::size_t line, std::size_t column) const {
    return is_override ? name : fmt::format("{}:{}:{}", name, line, column);
  }
  std::size_t order(const toml::source_region& region) const {  // overrides come after the file
    if (is_override) return std::numeric_limits<std::size_t>::max() / 2 + override_number;
    return std::size_t{region.begin.line} * 1'000'000 + region.begin.column;
  }
};

std::string_view what_it_is(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::array: return "a list";
    case toml::node_type::table: return "a table";
    case toml::node_type::date: return "a date";
    case toml::node_type::time: return "a time of day";
    case toml::node_type::date_time: return "a date and time";
    default: return "nothing";
  }
}

// The entries of a table; toml++ keeps them by the alphabet, we by the source.
std::vector<std::pair<const toml::key*, const toml::node*>> in_source_order(const toml::table& table) {
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
  const auto begin = [](const auto& entry) { return entry.first->source().begin; };
  std::stable_sort(entries.begin(), entries.end(), [&](const auto& a, const auto& b) { return begin(a) < begin(b); });
  return entries;
}

CaseValue convert(const toml::node& node, const Source& source) {
  CaseValue value;
  value.place = source.place(node.source());
  value.order = source.order(node.source());
  if (const auto* text = node.as_string()) {
    value.kind = Kind::text;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.kind = Kind::number;
    value.number = static_cast<double>(integer->get());
    value.text = fmt::format("{}", integer->get());
  } else if (const auto* real = node.as_floating_point()) {
    value.kind = Kind::number;
    value.number = real->get();
    value.text = number_text(real->get());
  } else if (const auto* boolean = node.as_boolean()) {
    value.kind = Kind::boolean;
    value.text = boolean->get() ? "true" : "false";
  } else {
    value.text = what_it_is(node);
    if (const auto* table = node.as_table()) {
      value.kind = Kind::table;
      for (const auto& [key, entry] : in_source_order(*table))
        value.entries.emplace_back(std::string(key->str()), convert(*entry, source));
    } else if (const auto* list = node.as_array()) {
      value.kind = Kind::list;
      for (const toml::node& entry : *list) value.entries.emplace_back("", convert(entry, source));
    }
  }
  return value;
}

CaseTable convert(const toml::table& root, const Source& source) {
  CaseTable table;
  for (const auto& [key, node] : in_source_order(root)) {
    CaseSection section{.name = std::string(key->str()),
                        .place = source.place(key->source()),
                        .order = source.order(key->source()),
                        .is_table = node->is_table()};
    if (const auto* entries = node->as_table()) {
      for (const auto& [entry_key, entry] : in_source_order(*entries))
        section.entries.push_back({.key = std::string(entry_key->str()),
                                   .place = source.place(entry_key->source()),
                                   .value = convert(*entry, source)});
    }
    table.sections.push_back(std::move(section));
  }
  return table;
}

// Before `text` is parsed.
void require_bounded(std::string_view text, const Source& source) {
  if (text.size() > largest_case)
    throw Error("it is no case: it has more than {} MB", largest_case >> 20U).at(source.name);
  if (const TomlComplaint complaint = toml_depth_complaint(text); !complaint.sentence.empty())
    throw Error(complaint.sentence).at(source.place(complaint.line, complaint.column));
}

CaseValue override_value(const std::string& text, const Source& source) {
  const std::string line = "value = " + text;
  require_bounded(line, source);
  try {
    const toml::table parsed = toml::parse(line);
    if (parsed.size() == 1) {  // more: the text holds lines of its own
      CaseValue value = convert(*parsed.get("value"), source);
      value.given = text;
      return value;
    }
  } catch (const toml::parse_error&) {  // not TOML: a text that needs no quotes here
  }
  return {.kind = Kind::text,
          .text = text,
          .given = text,
          .place = source.name,
          .order = source.order(toml::source_region{})};
}

CaseValue empty_table() {
  CaseValue table;
  table.kind = Kind::table;
  table.text = "a table";
  return table;
}

// Puts `value` at the end of `path`, key by key, into the table `into`, which `so_far` calls; tables that are not there
// are made.
void put_into(CaseValue& into, const std::string& so_far, std::string_view path, const CaseValue& value) {
  if (into.kind != Kind::table) {
    const std::string whole = value.kind == Kind::text ? toml_string(value.text) : value.shown();
    const bool is_inner = std::count(so_far.begin(), so_far.end(), '.') > 1;
    throw Error("{} = {} is no table, so that nothing can be put into it{}", shortened(so_far), into.shown(),
                is_inner ? ""
                         : fmt::format("; a whole one is written as {}={{ {} = {} }}", shortened(so_far),
                                       shortened(path), shortened(whole)))
        .at(value.place);
  }
  into.place = value.place;
  into.order = value.order;
  const std::size_t dot = path.find('.');
  const std::string key(path.substr(0, dot));
  if (key.empty()) throw Error("a key is missing between two dots").at(value.place);
  auto entry = std::find_if(into.entries.begin(), into.entries.end(), [&](const auto& e) { return e.first == key; });
  if (entry == into.entries.end()) entry = into.entries.insert(entry, {key, empty_table()});
  if (dot == std::string_view::npos) {
    entry->second = value;
  } else {
    put_into(entry->second, so_far + "." + key, path.substr(dot + 1), value);
  }
}

void apply_override(CaseTable& table, const std::string& given, std::size_t number) {
  const std::size_t equals = given.find('=');
  const std::string path(trimmed(std::string_view(given).substr(0, equals)));
  const std::size_t dot = path.find('.');
  if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 == path.size())
    throw Error("write it as section.key=value, for example --set method.h=1/64")
        .at("--set " + shortened(given, longest_place));

  const Source source{.name = "--set " + shortened(given, longest_place),
                      .is_override = true,
                      .override_number = number};
  if (!is_utf8(given)) throw Error("it is not in UTF-8, as case files are").at(source.name);
  if (std::count(path.begin(), path.end(), '.') >= most_key_parts)
    throw Error("a key has more than {} parts", most_key_parts).at(source.name);
  const std::string name = path.substr(0, dot);
  const std::size_t inner_dot = path.find('.', dot + 1);  // of a key inside a table: problem.D.v
  CaseEntry entry{.key = path.substr(dot + 1, inner_dot == std::string::npos ? inner_dot : inner_dot - dot - 1),
                  .place = source.name,
                  .value = override_value(std::string(trimmed(std::string_view(given).substr(equals + 1))), source)};
  auto section =
      std::find_if(table.sections.begin(), table.sections.end(), [&](const CaseSection& s) { return s.name == name; });
  if (section == table.sections.end()) {
    table.sections.push_back({.name = name, .place = source.name, .order = entry.value.order});
    section = std::prev(table.sections.end());
  }
  if (inner_dot != std::string::npos) {
    CaseValue inner = std::exchange(entry.value, {});
    const auto old = std::find_if(section->entries.begin(), section->entries.end(),
                                  [&](const CaseEntry& e) { return e.key == entry.key; });
    entry.value = old != section->entries.end() ? old->value : empty_table();
    put_into(entry.value, name + "." + entry.key, std::string_view(path).substr(inner_dot + 1), inner);
  }
  std::erase_if(section->entries, [&](const CaseEntry& old) { return old.key == entry.key; });
  section->entries.push_back(std::move(entry));
}

}  // namespace

const CaseSection* CaseTable::section(std::string_view name) const {
  for (const CaseSection& section : sections)
    if (section.name == name) return &section;
  return nullptr;
}

const CaseValue* CaseTable::value(std::string_view section_name, std::string_view key) const {
  const CaseSection* found = section(section_name);
  if (found == nullptr) return nullptr;
  for (const CaseEntry& entry : found->entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

CaseTable read_case_table(std::string_view text, std::string_view name, const std::vector<std::string>& overrides) {
  CaseTable table;
  const Source file{.name = shortened_path(name, longest_place)};
  require_bounded(text, file);
  try {
    table = convert(toml::parse(text), file);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw Error("{}", syntax_complaint(text, error.description(), at.line, at.column)).at(file.place(error.source()));
  }
  for (std::size_t i = 0; i < overrides.size(); ++i) apply_override(table, overrides[i], i);
  return table;
}

}  // namespace seiche
