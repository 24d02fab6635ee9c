#include <seiche/config/case/case_file.hpp>
#include <seiche/config/case/case_keys.hpp>
#include <seiche/config/case/case_reading.hpp>
#include <seiche/config/case/ensemble_case.hpp>
#include <seiche/config/case/method_section.hpp>
#include <seiche/config/case/problem_section.hpp>
#include <seiche/core/error.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/core/text/shortened.hpp>
#include <seiche/core/text/toml_depth.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace seiche {
namespace {

// How many steps of h > 0 the interval > 0 between snapshots takes. Throws Error, with the nearest number of steps,
// where it is no multiple of h: steps of one size come to no other times than theirs.
std::int64_t steps_between_snapshots(const std::string& key, const CaseValue& interval, double h) {
  constexpr double round_off = 1e-9;
  const double time = read_number(key, interval);
  const double every = std::max(1.0, std::round(time / h));
  if (std::abs(time - every * h) > round_off * time)
    throw Error("{} = {} is no multiple of h = {}: write snapshot_every = {}, for one every {}, or another h", key,
                interval.shown(), h, every, every * h);
  return static_cast<std::int64_t>(every);
}

// The sections in turn; those beside [problem] and [method] are read here.
class Sections {
 public:
  explicit Sections(CaseReading& reading) : r_(reading), spec_(reading.spec) {}

  void read() {
    read_problem_name(r_);
    refuse_unknown();
    read_time();
    if (r_.problem != nullptr) read_problem_section(r_);
    read_method_section(r_);
    read_backend();
    read_output();
    read_checkpoint();
    if (r_.problem != nullptr) read_ensemble();
  }

 private:
  // Only the first of each kind, since all are in the order of the source: nearest names of a million take too long.
  void refuse_unknown() {
    const std::vector<std::string> sections = case_sections();
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

  void read_time() {
    // Hypotheses of the energy law are looked at from t = 0 on.
    r_.on("time", "start", [&](const std::string& key, const CaseValue& value) {
      const double start = read_number(key, value);
      if (start < 0)
        throw Error("{} = {} must be ≥ 0: rather shift the formulas in t, so that the run begins at 0", key,
                    value.shown());
      spec_.t_start = start;
    });
    if (r_.problem != nullptr) spec_.t_end = spec_.t_start + r_.problem->default_end;
    r_.on("time", "end", [&](const std::string& key, const CaseValue& value) {
      const double end = read_number(key, value);
      if (end <= spec_.t_start)
        throw Error("{} = {} must be > {}", key, value.shown(),
                    spec_.t_start == 0 ? "0" : fmt::format("time.start = {}", spec_.t_start));
      spec_.t_end = end;
    });
  }

  void read_backend() {
    r_.on("backend", "name", [&](const std::string&, const CaseValue& value) {
      std::vector<std::string> names = backend_names();
      if (std::find(names.begin(), names.end(), "auto") == names.end()) names.insert(names.begin(), "auto");
      spec_.backend = read_name("backend", value, names);
    });
    r_.on("backend", "plan", [&](const std::string& key, const CaseValue& value) {
      spec_.measure_plans = read_name(key, value, {"estimate", "measure"}) == "measure";
    });
    r_.on("backend", "exponential", [&](const std::string& key, const CaseValue& value) {
      const bool lanczos = read_name(key, value, {"pade", "lanczos"}) == "lanczos";
      spec_.sparse.exponential = lanczos ? ExponentialKind::lanczos : ExponentialKind::pade;
    });
    r_.on("backend", "pade_degree", [&](const std::string& key, const CaseValue& value) {
      spec_.sparse.pade_degree = static_cast<int>(std::min(read_whole(key, value, 0), 1000L));
      spec_.sparse.validate();
    });
    r_.on("backend", "lanczos_dimension", [&](const std::string& key, const CaseValue& value) {
      spec_.sparse.lanczos_dimension = static_cast<int>(std::min(read_whole(key, value, 0), 1'000'000L));
      spec_.sparse.validate();
    });
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
    r_.on("output", "directory", [&](const std::string& key, const CaseValue& value) {
      spec_.output_directory = read_text(key, value);
      if (spec_.output_directory.empty()) throw Error("{} must not be empty", key);
    });
    r_.on("output", "energy_every",
          [&](const std::string& key, const CaseValue& value) { spec_.energy_every = read_whole(key, value, 1); });
    refuse_endless_files();
    r_.on("output", "snapshot_every",
          [&](const std::string& key, const CaseValue& value) { spec_.snapshot_every = read_whole(key, value, 0); });
    for (const char* key : {"snapshot_every", "snapshot_interval"})
      spec_.snapshots_given = spec_.snapshots_given || r_.table.value("output", key) != nullptr;
    r_.on("output", "ledger", [&](const std::string& key, const CaseValue& value) {
      spec_.ledger = read_name(key, value, {"off", "on"}) == "on";
    });
    r_.on("output", "report", [&](const std::string& key, const CaseValue& value) {
      spec_.report = read_name(key, value, {"on", "off"}) == "on";
    });
    r_.on("output", "snapshot_interval", [&](const std::string& key, const CaseValue& value) {
      const double interval = read_number(key, value);
      if (interval < 0) throw Error("{} = {} must be ≥ 0", key, value.shown());
      if (interval > 0 && spec_.duration() / interval > 1e7)
        throw Error("{} = {} would make {:.3g} snapshots", key, value.shown(), spec_.duration() / interval);
      if (interval == 0 || r_.asks_for_tolerance()) {
        spec_.snapshot_interval = interval;
      } else if (spec_.h > 0) {
        spec_.snapshot_every = steps_between_snapshots(key, value, spec_.h);
      }
    });
  }

  void read_checkpoint() {
    r_.on("checkpoint", "every_seconds", [&](const std::string& key, const CaseValue& value) {
      spec_.checkpoint.every_seconds = read_number(key, value);
      if (spec_.checkpoint.every_seconds < 0) throw Error("{} = {} must be ≥ 0", key, value.shown());
    });
    r_.on("checkpoint", "every_steps", [&](const std::string& key, const CaseValue& value) {
      spec_.checkpoint.every_steps = read_whole(key, value, 0);
    });
    r_.on("checkpoint", "keep", [&](const std::string& key, const CaseValue& value) {
      spec_.checkpoint.keep = read_whole(key, value, 1);
      if (spec_.checkpoint.keep > 2)
        throw Error("{} = {} must be 1 or 2: the newest checkpoint, and the one before it", key, value.shown());
    });
  }

  void read_ensemble() {
    const CaseSection* section = r_.table.section("ensemble");
    if (section == nullptr || !section->is_table) return;
    if (spec_.checkpoint != CheckpointSpec{})
      spec_.notes.emplace_back("an ensemble keeps no checkpoints: [checkpoint] has no effect");
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
    const std::string complaint = ensemble_complaint(ensemble);
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
