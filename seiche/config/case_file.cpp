#include <seiche/config/case_file.hpp>
#include <seiche/config/case_parameters.hpp>
#include <seiche/config/case_table.hpp>
#include <seiche/config/ensemble_case.hpp>
#include <seiche/core/error.hpp>
#include <seiche/core/vector.hpp>
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

std::vector<std::string> section_names() { return {"problem", "method", "backend", "time", "output", "ensemble"}; }

std::vector<std::string> keys_of(const std::string& section, const ProblemEntry* problem) {
  if (section == "method")
    return {"name", "h", "tolerance", "h_max", "C", "auxiliary", "scalar_solver", "law", "linear"};
  if (section == "backend") return {"name", "plan", "exponential", "pade_degree", "lanczos_dimension"};
  if (section == "time") return {"end"};
  if (section == "output") return {"directory", "energy_every", "ledger", "snapshot_every", "snapshot_interval"};
  if (section == "ensemble") return ensemble_keys(problem);
  std::vector<std::string> keys = {"name", "initial", "friction", "force"};
  if (problem != nullptr)
    for (const Parameter& parameter : problem->parameters) keys.push_back(parameter.name);
  return keys;
}

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
         std::filesystem::path folder)
      : name_(name), folder_(std::move(folder)), table_(read_case_table(text, name, overrides)) {
    spec_.source = name_;
  }

  RunSpec read() {
    find_problem_entry();
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
      problem_ = &find_problem(read_name(key, value, problem_names()));
      spec_.problem = problem_->name;
    });
    if (!given) {
      complain(at_the_end, name_,
               fmt::format("[problem] has no name; write name = \"…\" with one of {}",
                           fmt::join(problem_names(), ", ")));
    }
  }

  void refuse_unknown() {
    const std::vector<std::string> sections = section_names();
    for (const CaseSection& section : table_.sections) {
      const bool known = std::find(sections.begin(), sections.end(), section.name) != sections.end();
      if (!section.is_table) {
        complain(section.order, section.place, misplaced(section.name, known));
      } else if (!known) {
        complain(section.order, section.place, unknown_name("section", section.name, sections).what());
      } else if (section.name != "problem" || problem_ != nullptr) {
        refuse_unknown_keys(section);
      }
    }
  }

  std::string misplaced(const std::string& name, bool is_section) const {
    if (is_section) return fmt::format("{0} must be a section, [{0}]", name);
    for (const std::string& section : section_names()) {
      const std::vector<std::string> keys = keys_of(section, problem_);
      if (name != "name" && std::find(keys.begin(), keys.end(), name) != keys.end())
        return fmt::format("the key '{}' stands outside every section; it belongs into [{}]", name, section);
    }
    return fmt::format("the key '{}' stands outside every section ({})", name, fmt::join(section_names(), ", "));
  }

  void refuse_unknown_keys(const CaseSection& section) {
    const std::vector<std::string> keys = keys_of(section.name, problem_);
    for (const CaseEntry& entry : section.entries) {
      if (std::find(keys.begin(), keys.end(), entry.key) != keys.end()) continue;
      const std::string where =
          section.name == "problem" ? fmt::format("[problem] {}", spec_.problem) : fmt::format("[{}]", section.name);
      complain(entry.value.order, entry.place, unknown_name("key in " + where, entry.key, keys).what());
    }
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
    spec_.initial = PresetData{problem_->presets.front()};
    on("problem", "initial", [&](const std::string& key, const CaseValue& value) {
      spec_.initial = read_initial(key, value, *problem_, folder_);
    });
    on("problem", "friction",
       [&](const std::string& key, const CaseValue& value) { spec_.drives.friction = read_friction(key, value); });
    on("problem", "force", [&](const std::string& key, const CaseValue& value) {
      spec_.drives.forces = read_forces(key, value, *problem_);
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
    read_option("C", method, [](MethodOptions& options, const std::string& key, const CaseValue& value) {
      if (value.kind == CaseValue::Kind::text && value.text == "auto") return;
      if (value.kind != CaseValue::Kind::number && value.kind != CaseValue::Kind::text)
        throw Error("{} = {} must be a number or \"auto\"", key, value.shown());
      options.C = read_number(key, value);
    });
    read_option("auxiliary", method, [](MethodOptions& options, const std::string& key, const CaseValue& value) {
      const std::string name = read_name(key, value, {"transport", "frozen", "refresh"});
      options.auxiliary = name == "frozen"    ? AuxiliaryMode::frozen
                          : name == "refresh" ? AuxiliaryMode::refresh
                                              : AuxiliaryMode::transport;
    });
    read_option("scalar_solver", method, [](MethodOptions& options, const std::string& key, const CaseValue& value) {
      const bool newton = read_name(key, value, {"robust", "newton"}) == "newton";
      options.scalar_solver = newton ? ScalarSolver::newton : ScalarSolver::robust;
    });
    read_option("linear", method, [](MethodOptions& options, const std::string& key, const CaseValue& value) {
      const bool kicks = read_name(key, value, {"exact", "explicit"}) == "explicit";
      options.linear = kicks ? LinearTreatment::explicit_kicks : LinearTreatment::exact;
    });
    read_option("law", method, [](MethodOptions& options, const std::string& key, const CaseValue& value) {
      const std::string name = read_name(key, value, energy_law_names());
      options.law = name == "interval" ? EnergyLaw::interval : name == "guard" ? EnergyLaw::guard : EnergyLaw::none;
    });
  }

  // Each option is validated alone too, so that the complaint is at the key that caused it.
  template <class Read>
  void read_option(const std::string& option, const MethodEntry* method, Read read) {
    on("method", option, [&](const std::string& key, const CaseValue& value) {
      MethodOptions alone;
      read(alone, key, value);
      if (spec_.method == "auto" && alone != MethodOptions{})
        throw Error(
            "{} belongs to one method, and method.name = \"auto\" is yet to choose it: leave {} out, or name a method",
            key, option);
      if (method != nullptr) alone.validate(*method);
      read(spec_.method_options, key, value);
    });
  }

  void read_tolerance() {
    on("method", "tolerance", [&](const std::string& key, const CaseValue& value) {
      const double tolerance = read_number(key, value);
      if (tolerance <= 0 || tolerance >= 1)
        throw Error("{} = {} must be > 0 and < 1: the error of values at the end of the run", key, value.shown());
      if (tolerance < 1e-14)
        throw Error("{} = {} is below what double precision can tell; write at least 1e-14", key, value.shown());
      spec_.tolerance = tolerance;
    });
    on("method", "h_max", [&](const std::string& key, const CaseValue& value) {
      const double h = read_number(key, value);
      if (h <= 0) throw Error("{} = {} must be > 0", key, value.shown());
      if (!spec_.tolerance)
        throw Error("{} = {} needs method.tolerance: it bounds steps of variable size", key, value.shown());
      spec_.h_max = h;
    });
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
    if (on("method", "h", read) || problem_ == nullptr || spec_.tolerance) return;
    spec_.h = read_number("method.h", text_value(problem_->default_h));
    if (spec_.h <= spec_.t_end) return;
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
    if (spec_.tolerance) return;          // who knows
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
    spec_.output_directory = "out/" + spec_.problem;
    on("output", "directory", [&](const std::string& key, const CaseValue& value) {
      spec_.output_directory = read_text(key, value);
      if (spec_.output_directory.empty()) throw Error("{} must not be empty", key);
    });
    on("output", "energy_every",
       [&](const std::string& key, const CaseValue& value) { spec_.energy_every = read_whole(key, value, 1); });
    refuse_endless_files();
    on("output", "snapshot_every",
       [&](const std::string& key, const CaseValue& value) { spec_.snapshot_every = read_whole(key, value, 0); });
    on("output", "ledger", [&](const std::string& key, const CaseValue& value) {
      spec_.ledger = read_name(key, value, {"off", "on"}) == "on";
    });
    on("output", "snapshot_interval", [&](const std::string& key, const CaseValue& value) {
      const double interval = read_number(key, value);
      if (interval < 0) throw Error("{} = {} must be ≥ 0", key, value.shown());
      if (interval > 0 && !spec_.tolerance)
        throw Error("{} = {} needs method.tolerance; with steps of one size write snapshot_every", key, value.shown());
      if (interval > 0 && spec_.t_end / interval > 1e7)
        throw Error("{} = {} would make {:.3g} snapshots", key, value.shown(), spec_.t_end / interval);
      spec_.snapshot_interval = interval;
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
    const std::vector<std::string> keys = ensemble_keys(problem_);
    const bool all_known = std::all_of(section->entries.begin(), section->entries.end(), [&](const CaseEntry& entry) {
      return std::find(keys.begin(), keys.end(), entry.key) != keys.end();
    });
    const std::string complaint = ensemble_complaint(ensemble);
    if (all_known && complaints_.size() == complaints && !complaint.empty())
      complain(section->order, section->place, complaint);
  }

  std::string name_;
  std::filesystem::path folder_;
  CaseTable table_;
  const ProblemEntry* problem_ = nullptr;
  RunSpec spec_;
  std::vector<Complaint> complaints_;
};

}  // namespace

RunSpec read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  if (!std::filesystem::exists(file)) throw Error("the case file {} does not exist", file.string());
  if (std::filesystem::is_directory(file)) throw Error("{} is a folder, not a case file", file.string());
  std::ifstream input(file, std::ios::binary);
  std::ostringstream text;
  if (input.peek() != std::ifstream::traits_type::eof()) text << input.rdbuf();  // nothing to copy is a failure to <<
  if (!input.is_open() || input.bad() || text.fail()) throw Error("the case file {} cannot be read", file.string());
  return parse_case(text.str(), file.string(), overrides, file.parent_path());
}

RunSpec parse_case(std::string_view text, std::string_view name, const std::vector<std::string>& overrides,
                   const std::filesystem::path& folder) {
  return Reader(text, name, overrides, folder).read();
}

}  // namespace seiche
