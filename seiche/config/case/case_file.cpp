#include <seiche/config/case/case_file.hpp>
#include <seiche/config/case/case_keys.hpp>
#include <seiche/config/case/case_reading.hpp>
#include <seiche/config/case/ensemble_case.hpp>
#include <seiche/config/case/key_rows.hpp>
#include <seiche/config/case/problem_section.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/core/text/toml_depth.hpp>
#include <seiche/formula/algebra_lock.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace seiche {
namespace {

// The sections in turn.
class Sections {
 public:
  explicit Sections(CaseReading& reading) : r_(reading), spec_(reading.spec) {}

  void read() {
    read_problem_name(r_);
    refuse_unknown();
    read_time();
    if (r_.problem != nullptr) read_problem_section(r_);
    read_method();
    read_section("backend");
    read_noise();
    read_output();
    read_section("checkpoint");
    if (r_.problem != nullptr) read_ensemble();
  }

 private:
  // Only the first of each kind, since all are in the order of the source: nearest names of a million take too long.
  void refuse_unknown() {
    const std::vector<std::string>& sections = case_sections();
    bool is_told = false;
    for (const CaseSection& section : r_.table.sections) {
      const bool known = std::find(sections.begin(), sections.end(), section.name) != sections.end();
      if (!section.is_table || !known) {
        if (is_told) continue;
        is_told = true;
        r_.complain(section.order, section.place,
                    !section.is_table ? Error(key_outside_sections(section.name, r_.problem))
                                      : unknown_name("section", section.name, sections));
      } else if (section.name != "problem" || r_.problem != nullptr) {
        refuse_unknown_keys(section);
      }
    }
  }

  void refuse_unknown_keys(const CaseSection& section) {
    const std::vector<std::string> keys = case_keys(section.name, r_.problem);
    for (const CaseEntry& entry : section.entries)
      if (!is_one_of(entry, keys))
        return r_.complain(entry.value.order, entry.place, unknown_key(section.name, entry.key, r_.problem));
  }

  void read_row(const KeyRow& row) {
    r_.on(row.section, row.name,
          [&](const std::string& key, const CaseValue& value) { row.read(r_, row, key, value); });
  }
  void read_section(const std::string& section) {
    for (const KeyRow& row : key_rows())
      if (row.section == section) read_row(row);
  }

  void read_time() {
    read_row(key_row("time", "start"));
    if (r_.problem != nullptr) spec_.t_end = spec_.t_start + r_.problem->default_end;
    read_row(key_row("time", "end"));
  }

  void read_method() {
    if (r_.problem != nullptr) spec_.method = r_.problem->default_method;
    read_section("method");
    if (r_.gives("method", "h") || r_.problem == nullptr || r_.asks_for_tolerance()) return;
    spec_.h = read_number("method.h", default_value(r_.problem->default_h));
    spec_.h_is_default = spec_.h <= spec_.duration();
    if (spec_.h_is_default) return;
    spec_.h = spec_.duration();
    spec_.notes.push_back(
        fmt::format("method.h is not given and its default {} is more than the time of the run: h = {}",
                    r_.problem->default_h, spec_.h));
  }

  void read_noise() {
    read_section("noise");
    const CaseSection* section = r_.table.section("noise");
    if (section == nullptr || !section->is_table) return;
    const auto refuse = [&](const std::string& what) { r_.complain(section->order, section->place, Error(what)); };
    if (!r_.gives("noise", "temperature") && !section->entries.empty())
      refuse("[noise] needs a temperature, in the units of H: write temperature = 0.01");
    if (spec_.noise.is_on() && r_.asks_for_tolerance())
      refuse("noise needs steps of one size: write method.h, and no tolerance");
  }

  // A step size typed wrong must not fill the disk.
  void refuse_endless_files() {
    if (r_.asks_for_tolerance()) return;  // who knows
    constexpr double most_records = 1e8;  // some gigabytes of energy.csv
    const double records = spec_.duration() / spec_.h / static_cast<double>(spec_.energy_every);
    if (!(records > most_records)) return;
    const CaseValue* h = r_.table.value("method", "h");
    r_.complain(h ? h->order : CaseReading::at_the_end, h ? h->place : r_.name,
                Error("h = {} makes {:.3g} steps, and output.energy_every = {} would record {:.3g} energies; set it to "
                      "at least {:.0f}, or choose a larger h",
                      spec_.h, spec_.duration() / spec_.h, spec_.energy_every, records,
                      std::ceil(spec_.duration() / spec_.h / most_records)));
  }

  void read_output() {
    // Two problems of one's own are two, and neither takes the other's folder.
    const std::string stem = std::filesystem::path(r_.name).stem().string();
    spec_.output_directory = "out/" + (spec_.custom && !stem.empty() ? stem : spec_.problem);
    for (const char* key : {"snapshot_every", "snapshot_interval"})
      spec_.snapshots_given = spec_.snapshots_given || r_.gives("output", key);
    read_section("output");
    refuse_endless_files();
  }

  void read_ensemble() {
    const CaseSection* section = r_.table.section("ensemble");
    if (section == nullptr || !section->is_table) return;
    if (spec_.ledger)
      r_.complain(section->order, section->place, Error("an ensemble keeps no ledger: write output.ledger = \"off\""));
    if (spec_.tolerance)
      r_.complain(section->order, section->place,
                  Error("an ensemble takes steps of one size: write method.h, and no tolerance"));
    EnsembleSpec& ensemble = spec_.ensemble.emplace();
    const std::size_t complaints = r_.complaints.size();
    for (const CaseEntry& entry : section->entries) {
      r_.on("ensemble", entry.key, [&](const std::string&, const CaseValue& value) {
        read_ensemble_key(ensemble, entry.key, value, *r_.problem, r_.folder);
      });
    }
    const std::vector<std::string> keys = case_keys(section->name, r_.problem);
    const bool all_known = std::all_of(section->entries.begin(), section->entries.end(),
                                       [&](const CaseEntry& entry) { return is_one_of(entry, keys); });
    const std::string complaint = ensemble_complaint(ensemble, spec_.noise.is_on());
    if (all_known && r_.complaints.size() == complaints && !complaint.empty())
      r_.complain(section->order, section->place, Error(complaint));
  }

  CaseReading& r_;
  RunSpec& spec_;
};

}  // namespace

std::string case_text(const std::filesystem::path& file) {
  const std::string name = shortened_path(file.string());
  const InputFile found = look_at(file);
  switch (found.kind) {
    case InputKind::missing: throw Error("the case file {} does not exist", name);
    case InputKind::folder: throw Error("{} is a folder, not a case file", name);
    case InputKind::unreachable: throw Error("the case file {} cannot be reached: {}", name, found.reason);
    case InputKind::other:
      throw Error("{} is a pipe or a device, not a case file; what a program writes is read as in `… | seiche check -`",
                  name);
    case InputKind::file:
    case InputKind::stream: break;
  }
  std::ifstream input(file, std::ios::binary);
  std::string text = text_up_to(input, largest_case);
  if (!input.is_open() || input.bad()) throw Error("the case file {} cannot be read", name);
  if (text.size() <= largest_case && text.find('\0') != std::string::npos)
    throw Error("{} is no case file: it holds binary data", name);
  return text;
}

RunSpec read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                  const std::vector<std::string>& methods) {
  return parse_case(case_text(file), file.string(), overrides, file.parent_path(), methods);
}

RunSpec parse_case(std::string_view text, std::string_view name, const std::vector<std::string>& overrides,
                   const std::filesystem::path& folder, const std::vector<std::string>& methods) {
  const auto lock = algebra_lock();
  CaseReading reading{.name = std::string(name),
                      .folder = folder,
                      .methods = methods,
                      .table = read_case_table(text, name, overrides)};
  reading.spec.source = reading.name;
  reading.spec.overrides = overrides;
  for (const CaseSection& section : reading.table.sections)
    for (const CaseEntry& entry : section.entries)
      reading.spec.places[section.name + "." + entry.key] = entry.value.place;
  Sections(reading).read();
  reading.throw_first_complaint();
  return std::move(reading.spec);
}

}  // namespace seiche
