#include <seiche/config/case_file.hpp>
#include <seiche/config/case_keys.hpp>
#include <seiche/config/case_parameters.hpp>
#include <seiche/config/case_table.hpp>
#include <seiche/config/custom_case.hpp>
#include <seiche/config/ensemble_case.hpp>
#include <seiche/config/method_option_keys.hpp>
#include <seiche/config/snapshot_steps.hpp>
#include <seiche/core/error.hpp>
#include <seiche/problem/problems.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace seiche {
namespace {

constexpr std::size_t at_the_end = std::numeric_limits<std::size_t>::max();

CaseValue text_value(const std::string& text) {
  CaseValue value;
  value.kind = CaseValue::Kind::text;
  value.text = text;
  return value;
}

// Reads everything that can be read and keeps every complaint, so that the first one in the source can be thrown.
class Reader {
 public:
  Reader(std::string_view text, std::string_view name, const std::vector<std::string>& overrides,
         std::filesystem::path folder, const std::vector<std::string>& methods)
      : name_(name), folder_(std::move(folder)), methods_(methods), table_(read_case_table(text, name, overrides)) {
    spec_.source = name_;
    spec_.overrides = overrides;
  }

  RunSpec read() {
    find_problem_entry();
    read_custom();
    refuse_unknown();
    read_time();
    if (problem_ != nullptr) read_problem();
    read_method();
    read_backend();
    read_output();
    if (problem_ != nullptr) read_ensemble();
    throw_first_complaint();
    return std::move(spec_);
  }

 private:
  struct Complaint {
    std::size_t order;
    std::string text;
  };

  void complain(std::size_t order, std::string_view place, std::string_view sentence) {
    complaints_.push_back({order, fmt::format("{}: {}", place, sentence)});
  }

  void throw_first_complaint() const {
    const auto first = std::min_element(complaints_.begin(), complaints_.end(),
                                        [](const auto& a, const auto& b) { return a.order < b.order; });
    if (first != complaints_.end()) throw Error(first->text);
  }

  // Runs `read(key, value)` if the key is given; what it throws becomes a complaint at the value.
  template <class Read>
  bool on(const std::string& section, const std::string& key, Read read) {
    const CaseValue* value = table_.value(section, key);
    if (value == nullptr) return false;
    try {
      read(section + "." + key, *value);
    } catch (const Error& error) {
      complain(value->order, value->place, error.what());
    }
    return true;
  }

  void find_problem_entry() {
    const bool given = on("problem", "name", [&](const std::string& key, const CaseValue& value) {
      spec_.problem = read_name(key, value, all_problem_names());
      if (spec_.problem != custom_name) problem_ = &find_problem(spec_.problem);
    });
    if (!given) {
      complain(at_the_end, name_,
               fmt::format("[problem] has no name; write name = \"…\" with one of {}",
                           fmt::join(all_problem_names(), ", ")));
    }
  }

  // The entry that stands for the list's. Without one, after a complaint, nothing else of [problem] is read.
  void read_custom() {
    if (spec_.problem != custom_name) return;
    CustomProblem custom;
    const CaseSection& section = *table_.section("problem");
    std::vector<std::string> of_grid;
    for (const Parameter& parameter : grid_parameters("", "")) of_grid.push_back(parameter.name);
    const bool has_grid = std::any_of(section.entries.begin(), section.entries.end(),
                                      [&](const CaseEntry& entry) { return has(of_grid, entry); });
    if (has_grid) custom.grid.emplace();
    const std::size_t complaints = complaints_.size();
    for (const std::string& key : custom_keys()) {
      if (complaints_.size() > complaints) break;  // without the names, nothing that follows makes sense
      on("problem", key, [&](const std::string&, const CaseValue& value) { read_custom_key(custom, key, value); });
    }
    if (complaints_.size() > complaints) return;
    try {
      spec_.entry = std::make_shared<const ProblemEntry>(custom_entry(custom, has_grid));
      problem_ = spec_.entry.get();
      spec_.custom = std::move(custom);
    } catch (const Error& error) {
      complain_about_custom(error.what());
    }
  }

  // At the key that the sentence begins with.
  void complain_about_custom(const std::string& sentence) {
    const CaseValue* at = nullptr;
    for (const std::string& key : custom_keys())
      if (sentence.starts_with("problem." + key) && table_.value("problem", key) != nullptr)
        at = table_.value("problem", key);
    complain(at != nullptr ? at->order : at_the_end, at != nullptr ? at->place : name_, sentence);
  }

  // Formulas are tried on a small grid, so that a mistake is said at its key, and before a large one is made.
  void try_custom() {
    if (!spec_.custom || !complaints_.empty()) return;
    try {
      try_formulas(*spec_.custom, spec_.parameters);
    } catch (const Error& error) {
      complain_about_custom(error.what());
    }
  }

  void note_unused_parameters() {
    if (!spec_.custom || !complaints_.empty()) return;  // formulas that cannot be read have been complained about
    std::vector<std::string> others;
    if (const auto* data = std::get_if<FormulaData>(&spec_.initial))
      for (const auto& [field, formula] : data->formulas) others.push_back(formula);
    if (spec_.drives.friction)
      for (const auto& [key, formula] : spec_.drives.friction->texts) others.push_back(formula);
    for (const auto& [field, formula] : spec_.drives.forces) others.push_back(formula);
    for (const std::string& name : unused_parameters(*spec_.custom, others))
      spec_.notes.push_back(fmt::format("no formula names the parameter {}", name));
  }

  void refuse_unknown() {
    const std::vector<std::string> sections = case_sections();
    for (const CaseSection& section : table_.sections) {
      const bool known = std::find(sections.begin(), sections.end(), section.name) != sections.end();
      if (!section.is_table) {
        complain(section.order, section.place, key_outside_sections(section.name, problem_));
      } else if (!known) {
        complain(section.order, section.place, unknown_name("section", section.name, sections).what());
      } else if (section.name != "problem" || problem_ != nullptr) {
        refuse_unknown_keys(section);
      }
    }
  }

  static bool has(const std::vector<std::string>& keys, const CaseEntry& entry) {
    return std::find(keys.begin(), keys.end(), entry.key) != keys.end();
  }

  void refuse_unknown_keys(const CaseSection& section) {
    const std::vector<std::string> keys = case_keys(section.name, problem_);
    for (const CaseEntry& entry : section.entries)
      if (!has(keys, entry)) complain(entry.value.order, entry.place, unknown_key(section.name, entry.key, problem_));
  }

  void read_time() {
    if (problem_ != nullptr) spec_.t_end = problem_->default_end;
    on("time", "end", [&](const std::string& key, const CaseValue& value) {
      const double end = read_number(key, value);
      if (end <= 0) throw Error("{} = {} must be > 0", key, value.shown());
      spec_.t_end = end;
    });
  }

  void read_problem() {
    for (const Parameter& parameter : problem_->parameters) {
      const bool given = on("problem", parameter.name, [&](const std::string&, const CaseValue& value) {
        set_parameter(spec_, parameter, value, folder_);
      });
      if (!given) set_parameter(spec_, parameter, text_value(parameter.default_value));
    }
    note_short_lists();
    spec_.initial = PresetData{problem_->presets.front()};
    on("problem", "initial", [&](const std::string& key, const CaseValue& value) {
      spec_.initial = read_initial(key, value, *problem_, folder_);
    });
    try_custom();  // what the problem lacks comes before how it starts
    if (spec_.custom && table_.value("problem", "initial") == nullptr)
      complain(at_the_end, name_,
               fmt::format(
                   "[problem] has no initial state; write initial = {{ {} = \"…\" }}, {{ file = \"…\" }}, or \"zero\"",
                   fmt::join(problem_->fields, " = \"…\", ")));
    FormulaConstants constants;
    try {
      constants = formula_constants(spec_);
    } catch (const Error&) {  // one of them has a complaint of its own
    }
    on("problem", "friction", [&](const std::string& key, const CaseValue& value) {
      spec_.drives.friction = read_friction(key, value, *problem_, constants);
    });
    on("problem", "force", [&](const std::string& key, const CaseValue& value) {
      spec_.drives.forces = read_forces(key, value, *problem_, constants);
    });
    note_unused_parameters();
  }

  // [2.0] on a grid in several dimensions may be all that its author thought of.
  void note_short_lists() {
    std::size_t axes = 1;
    const auto for_lists = [&](const auto& visit) {
      for (const Parameter& parameter : problem_->parameters) {
        const CaseValue* value = table_.value("problem", parameter.name);
        if (parameter.per_axis && value != nullptr && value->kind == CaseValue::Kind::list) visit(parameter, *value);
      }
    };
    for_lists([&](const Parameter&, const CaseValue& list) { axes = std::max(axes, list.entries.size()); });
    for_lists([&](const Parameter& parameter, const CaseValue& list) {
      if (list.entries.size() == 1 && axes > 1)
        spec_.notes.push_back(
            fmt::format("problem.{} is a list with one entry, and serves all {} axes", parameter.name, axes));
    });
  }

  void read_method() {
    if (problem_ != nullptr) spec_.method = problem_->default_method;
    const MethodEntry* method = &find_method(spec_.method);
    on("method", "name", [&](const std::string&, const CaseValue& value) {
      method = nullptr;
      std::vector<std::string> names = method_names();
      names.emplace_back("auto");
      spec_.method = read_name("method", value, names);
      method = spec_.method == "auto" ? nullptr : &find_method(spec_.method);
    });
    read_tolerance();
    read_step_size();
    for (const MethodOptionKey& option : method_option_keys()) read_option(option, method);
  }

  // Each option is validated alone too, so that the complaint is at the key that caused it.
  void read_option(const MethodOptionKey& option, const MethodEntry* method) {
    on("method", option.name, [&](const std::string& key, const CaseValue& value) {
      MethodOptions alone;
      option.read(alone, key, value);
      if (!methods_.empty())
        require_one_that_knows(alone);
      else if (spec_.method == "auto" && alone != MethodOptions{})
        throw Error(
            "{} belongs to one method, and method.name = \"auto\" is yet to choose it: leave {} out, or name a method",
            key, option.name);
      else if (method != nullptr)
        alone.validate(*method);
      option.read(spec_.method_options, key, value);
    });
  }

  void require_one_that_knows(const MethodOptions& options) const {
    std::optional<Error> first;
    for (const std::string& name : methods_) {
      try {
        return options.validate(find_method(name));
      } catch (const Error& error) {
        if (!first) first = error;
      }
    }
    throw Error(*first);
  }

  void read_tolerance() {
    on("method", "tolerance", [&](const std::string& key, const CaseValue& value) {
      const double tolerance = read_number(key, value);
      if (tolerance <= 0 || tolerance >= 1)
        throw Error("{} = {} must be > 0 and < 1: the error that steps add per unit of time", key, value.shown());
      if (tolerance < 1e-14)
        throw Error("{} = {} is below what double precision can tell; write at least 1e-14", key, value.shown());
      spec_.tolerance = tolerance;
    });
    on("method", "h_max", [&](const std::string& key, const CaseValue& value) {
      const double h = read_number(key, value);
      if (h <= 0) throw Error("{} = {} must be > 0", key, value.shown());
      if (!asks_for_tolerance())
        throw Error("{} = {} needs method.tolerance: it bounds steps of variable size", key, value.shown());
      spec_.h_max = h;
    });
  }

  bool asks_for_tolerance() const {  // be it one that makes no sense: that is said once
    return table_.value("method", "tolerance") != nullptr;
  }

  void read_step_size() {
    const auto read = [&](const std::string& key, const CaseValue& value) {
      const double h = read_number(key, value);
      if (h <= 0) throw Error("{} = {} must be > 0", key, value.shown());
      if (problem_ == nullptr && spec_.t_end == 0) return;
      if (h > spec_.t_end) throw Error("{} = {} must be ≤ time.end = {}", key, value.shown(), spec_.t_end);
      if (spec_.t_end / h > 1e15) throw Error("{} = {} would take {:.3g} steps", key, value.shown(), spec_.t_end / h);
      spec_.h = h;
    };
    if (on("method", "h", read) || problem_ == nullptr || asks_for_tolerance()) return;
    spec_.h = read_number("method.h", text_value(problem_->default_h));
    spec_.h_is_default = spec_.h <= spec_.t_end;
    if (spec_.h_is_default) return;
    spec_.h = spec_.t_end;
    spec_.notes.push_back(fmt::format("method.h is not given and its default {} is more than time.end: h = {}",
                                      problem_->default_h, spec_.h));
  }

  void read_backend() {
    on("backend", "name", [&](const std::string&, const CaseValue& value) {
      std::vector<std::string> names = backend_names();
      if (std::find(names.begin(), names.end(), "auto") == names.end()) names.insert(names.begin(), "auto");
      spec_.backend = read_name("backend", value, names);
    });
    on("backend", "plan", [&](const std::string& key, const CaseValue& value) {
      spec_.measure_plans = read_name(key, value, {"estimate", "measure"}) == "measure";
    });
    on("backend", "exponential", [&](const std::string& key, const CaseValue& value) {
      const bool lanczos = read_name(key, value, {"pade", "lanczos"}) == "lanczos";
      spec_.sparse.exponential = lanczos ? ExponentialKind::lanczos : ExponentialKind::pade;
    });
    on("backend", "pade_degree", [&](const std::string& key, const CaseValue& value) {
      spec_.sparse.pade_degree = static_cast<int>(std::min(read_whole(key, value, 0), 1000L));
      spec_.sparse.validate();
    });
    on("backend", "lanczos_dimension", [&](const std::string& key, const CaseValue& value) {
      spec_.sparse.lanczos_dimension = static_cast<int>(std::min(read_whole(key, value, 0), 1'000'000L));
      spec_.sparse.validate();
    });
  }

  // A step size typed wrong must not fill the disk.
  void refuse_endless_files() {
    if (asks_for_tolerance()) return;     // who knows
    constexpr double most_records = 1e8;  // some gigabytes of energy.csv
    const double records = spec_.t_end / spec_.h / static_cast<double>(spec_.energy_every);
    if (!(records > most_records)) return;
    const CaseValue* h = table_.value("method", "h");
    complain(
        h ? h->order : at_the_end, h ? h->place : name_,
        fmt::format("h = {} makes {:.3g} steps, and output.energy_every = {} would record {:.3g} energies; set it to "
                    "at least {:.0f}, or choose a larger h",
                    spec_.h, spec_.t_end / spec_.h, spec_.energy_every, records,
                    std::ceil(spec_.t_end / spec_.h / most_records)));
  }

  void read_output() {
    // Two problems of one's own are two, and neither takes the other's folder.
    const std::string stem = std::filesystem::path(name_).stem().string();
    spec_.output_directory = "out/" + (spec_.custom && !stem.empty() ? stem : spec_.problem);
    on("output", "directory", [&](const std::string& key, const CaseValue& value) {
      spec_.output_directory = read_text(key, value);
      if (spec_.output_directory.empty()) throw Error("{} must not be empty", key);
    });
    on("output", "energy_every",
       [&](const std::string& key, const CaseValue& value) { spec_.energy_every = read_whole(key, value, 1); });
    refuse_endless_files();
    on("output", "snapshot_every",
       [&](const std::string& key, const CaseValue& value) { spec_.snapshot_every = read_whole(key, value, 0); });
    for (const char* key : {"snapshot_every", "snapshot_interval"})
      spec_.snapshots_given = spec_.snapshots_given || table_.value("output", key) != nullptr;
    on("output", "ledger", [&](const std::string& key, const CaseValue& value) {
      spec_.ledger = read_name(key, value, {"off", "on"}) == "on";
    });
    on("output", "report", [&](const std::string& key, const CaseValue& value) {
      spec_.report = read_name(key, value, {"on", "off"}) == "on";
    });
    on("output", "snapshot_interval", [&](const std::string& key, const CaseValue& value) {
      const double interval = read_number(key, value);
      if (interval < 0) throw Error("{} = {} must be ≥ 0", key, value.shown());
      if (interval > 0 && spec_.t_end / interval > 1e7)
        throw Error("{} = {} would make {:.3g} snapshots", key, value.shown(), spec_.t_end / interval);
      if (interval == 0 || asks_for_tolerance()) {
        spec_.snapshot_interval = interval;
      } else if (spec_.h > 0) {
        spec_.snapshot_every = steps_between_snapshots(key, value, spec_.h);
      }
    });
  }

  void read_ensemble() {
    const CaseSection* section = table_.section("ensemble");
    if (section == nullptr || !section->is_table) return;
    if (spec_.ledger)
      complain(section->order, section->place, "an ensemble keeps no ledger: write output.ledger = \"off\"");
    if (spec_.tolerance)
      complain(section->order, section->place, "an ensemble takes steps of one size: write method.h, and no tolerance");
    EnsembleSpec& ensemble = spec_.ensemble.emplace();
    const std::size_t complaints = complaints_.size();
    for (const CaseEntry& entry : section->entries) {
      on("ensemble", entry.key, [&](const std::string&, const CaseValue& value) {
        read_ensemble_key(ensemble, entry.key, value, *problem_, folder_);
      });
    }
    const std::vector<std::string> keys = case_keys(section->name, problem_);
    const bool all_known = std::all_of(section->entries.begin(), section->entries.end(),
                                       [&](const CaseEntry& entry) { return has(keys, entry); });
    const std::string complaint = ensemble_complaint(ensemble);
    if (all_known && complaints_.size() == complaints && !complaint.empty())
      complain(section->order, section->place, complaint);
  }

  std::string name_;
  std::filesystem::path folder_;
  const std::vector<std::string>& methods_;
  CaseTable table_;
  const ProblemEntry* problem_ = nullptr;
  RunSpec spec_;
  std::vector<Complaint> complaints_;
};

}  // namespace

std::string case_text(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) throw Error("the case file {} does not exist", file.string());
  if (std::filesystem::is_directory(file)) throw Error("{} is a folder, not a case file", file.string());
  std::ifstream input(file, std::ios::binary);
  std::ostringstream text;
  if (input.peek() != std::ifstream::traits_type::eof()) text << input.rdbuf();  // nothing to copy is a failure to <<
  if (!input.is_open() || input.bad() || text.fail()) throw Error("the case file {} cannot be read", file.string());
  return text.str();
}

RunSpec read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                  const std::vector<std::string>& methods) {
  return parse_case(case_text(file), file.string(), overrides, file.parent_path(), methods);
}

RunSpec parse_case(std::string_view text, std::string_view name, const std::vector<std::string>& overrides,
                   const std::filesystem::path& folder, const std::vector<std::string>& methods) {
  return Reader(text, name, overrides, folder, methods).read();
}

}  // namespace seiche
