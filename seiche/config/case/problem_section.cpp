#include <seiche/config/case/case_keys.hpp>
#include <seiche/config/case/case_parameters.hpp>
#include <seiche/config/case/problem_section.hpp>
#include <seiche/config/custom/custom_case.hpp>
#include <seiche/config/data/matrix_file.hpp>

#include <fmt/ranges.h>

#include <algorithm>

namespace seiche {
namespace {

class ProblemSection {
 public:
  explicit ProblemSection(CaseReading& reading) : r_(reading), spec_(reading.spec) {}

  void find() {
    find_entry();
    if (spec_.problem == custom_name) read_custom();
  }

  void read() {
    const bool can_be_read = compare_matrices();
    for (const bool formulas : {false, true})  // which may name the others
      for (const Parameter& parameter : r_.problem->parameters)
        if ((parameter.kind == ParameterKind::rate || parameter.kind == ParameterKind::function) == formulas &&
            (parameter.kind != ParameterKind::matrix || can_be_read))
          read(parameter);
    note_short_lists();
    spec_.initial = PresetData{r_.problem->presets.front()};
    r_.on("problem", "initial", [&](const std::string& key, const CaseValue& value) {
      spec_.initial = read_initial(key, value, spec_, r_.folder);
    });
    try_custom();  // what the problem lacks comes before how it starts
    if (spec_.custom && !r_.gives("problem", "initial"))
      r_.complain_about_source(fmt::format(
          "[problem] has no initial state; write initial = {{ {} = \"…\" }}, {{ file = \"…\" }}, or \"zero\"",
          fmt::join(r_.problem->fields, " = \"…\", ")));
    FormulaConstants constants;
    try {
      constants = formula_constants(spec_);
    } catch (const Error&) {  // one of them has a complaint of its own
    }
    r_.on("problem", "friction", [&](const std::string& key, const CaseValue& value) {
      spec_.drives.friction =
          read_friction(key, value, formula_context(spec_, FormulaContext::Kind::friction), constants);
    });
    r_.on("problem", "force", [&](const std::string& key, const CaseValue& value) {
      spec_.drives.forces = read_forces(key, value, formula_context(spec_, FormulaContext::Kind::force), constants);
    });
    note_unused_parameters();
  }

 private:
  void read(const Parameter& parameter) {
    bool is_set = false;
    r_.on("problem", parameter.name, [&](const std::string&, const CaseValue& value) {
      set_parameter(spec_, parameter, value, r_.folder);
      is_set = true;
    });
    // Also after a complaint: what is read next may name it.
    if (!is_set) set_parameter(spec_, parameter, default_value(parameter.default_value));
  }

  // Before any of them takes memory: matrices of one system are square and of one size, and hardly a row is empty.
  bool compare_matrices() {
    const std::size_t complaints = r_.complaints.size();
    MatrixSizes first;
    std::string first_key;
    for (const Parameter& parameter : r_.problem->parameters) {
      if (parameter.kind != ParameterKind::matrix) continue;
      r_.on("problem", parameter.name, [&](const std::string& key, const CaseValue& value) {
        const std::optional<MatrixSizes> sizes = matrix_sizes(key, value, r_.folder);
        if (!sizes) return;
        const auto [rows, columns, entries] = *sizes;
        if (rows != columns) throw Error("{} is {} × {} and must be square", key, rows, columns);
        if (!first_key.empty()) {
          if (rows != first.rows)
            throw Error("{} is {} × {} but {} is {} × {}", key, rows, columns, first_key, first.rows, first.columns);
          return;
        }
        constexpr Index many_rows = Index{1} << 20U, most_rows_per_entry = 8;
        if (rows > many_rows && rows / most_rows_per_entry > entries)
          throw Error("{} has {} rows and {} entr{}: nearly all rows are empty, and would take memory for nothing", key,
                      rows, entries, entries == 1 ? "y" : "ies");
        first = *sizes;
        first_key = key;
      });
    }
    return r_.complaints.size() == complaints;
  }

  void find_entry() {
    const bool given = r_.on("problem", "name", [&](const std::string& key, const CaseValue& value) {
      spec_.problem = read_name(key, value, all_problem_names());
      if (spec_.problem != custom_name) r_.problem = &find_problem(spec_.problem);
    });
    if (!given) {
      r_.complain_about_source(fmt::format("[problem] has no name; write name = \"…\" with one of {}",
                                           fmt::join(all_problem_names(), ", ")));
    }
  }

  // The entry that stands for the list's. Without one, after a complaint, nothing else of [problem] is read.
  void read_custom() {
    CustomProblem custom;
    const CaseSection& section = *r_.table.section("problem");
    std::vector<std::string> of_grid;
    for (const Parameter& parameter : grid_parameters("", "")) of_grid.push_back(parameter.name);
    const bool has_grid = std::any_of(section.entries.begin(), section.entries.end(),
                                      [&](const CaseEntry& entry) { return is_one_of(entry, of_grid); });
    if (has_grid) custom.grid.emplace();
    const std::size_t complaints = r_.complaints.size();
    for (const std::string& key : custom_keys()) {
      if (r_.complaints.size() > complaints) break;  // without the names, nothing that follows makes sense
      r_.on("problem", key, [&](const std::string&, const CaseValue& value) { read_custom_key(custom, key, value); });
    }
    if (r_.complaints.size() > complaints) return;
    try {
      spec_.entry = std::make_shared<const ProblemEntry>(custom_entry(custom, has_grid));
      r_.problem = spec_.entry.get();
      spec_.custom = std::move(custom);
    } catch (const Error& error) {
      complain_about_custom(error);
    }
  }

  // At the key that the sentence begins with.
  void complain_about_custom(const Error& error) {
    const CaseValue* at = nullptr;
    for (const std::string& key : custom_keys())
      if (!error.under("problem." + key).parts().key.empty() && r_.gives("problem", key))
        at = r_.table.value("problem", key);
    r_.complain(at != nullptr ? at->order : CaseReading::at_the_end, at != nullptr ? at->place : r_.name, error);
  }

  // Formulas are tried on a small grid, so that a mistake is said at its key, and before a large one is made.
  void try_custom() {
    if (!spec_.custom || !r_.complaints.empty()) return;
    try {
      try_formulas(*spec_.custom, spec_.parameters);
    } catch (const Error& error) {
      complain_about_custom(error);
    }
  }

  void note_unused_parameters() {
    if (!spec_.custom || !r_.complaints.empty()) return;  // formulas that cannot be read have been complained about
    std::vector<std::string> others;
    if (const auto* data = std::get_if<FormulaData>(&spec_.initial))
      for (const auto& [field, formula] : data->formulas) others.push_back(formula);
    if (spec_.drives.friction)
      for (const auto& [key, formula] : spec_.drives.friction->texts) others.push_back(formula);
    for (const auto& [field, formula] : spec_.drives.forces) others.push_back(formula);
    for (const std::string& name : unused_parameters(*spec_.custom, others))
      spec_.notes.push_back(fmt::format("no formula names the parameter {}", name));
  }

  // [2.0] on a grid in several dimensions may be all that its author thought of.
  void note_short_lists() {
    std::size_t axes = 1;
    const auto for_lists = [&](const auto& visit) {
      for (const Parameter& parameter : r_.problem->parameters) {
        const CaseValue* value = r_.table.value("problem", parameter.name);
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

  CaseReading& r_;
  RunSpec& spec_;
};

}  // namespace

void read_problem_name(CaseReading& reading) { ProblemSection(reading).find(); }
void read_problem_section(CaseReading& reading) { ProblemSection(reading).read(); }

}  // namespace seiche
