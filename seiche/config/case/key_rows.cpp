#include <seiche/config/case/case_reading.hpp>
#include <seiche/config/case/key_readers.hpp>
#include <seiche/config/case/key_rows.hpp>
#include <seiche/core/base/error.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace seiche {
namespace {

using Kind = KeyRow::Kind;
template <class T>
using Names = std::vector<std::pair<const char*, T>>;

std::vector<std::string_view> projecting_methods() {
  std::vector<std::string_view> names;
  for (const MethodEntry& method : methods())
    if (method.projects()) names.push_back(method.name);
  return names;
}

template <class T>
T read_named(const Names<T>& names, const std::string& key, const CaseValue& value) {
  std::vector<std::string> choices;
  for (const auto& [name, meant] : names) choices.emplace_back(name);
  const std::string chosen = read_name(key, value, choices);
  return std::find_if(names.begin(), names.end(), [&](const auto& each) { return chosen == each.first; })->second;
}

template <class T>
std::string name_of(const Names<T>& names, const T& value) {
  return toml_string(
      std::find_if(names.begin(), names.end(), [&](const auto& each) { return each.second == value; })->first);
}

void read_law(CaseReading& r, const KeyRow&, const std::string& key, const CaseValue& value) {
  const EnergyLaw law =
      read_named<EnergyLaw>({{"interval", EnergyLaw::interval}, {"guard", EnergyLaw::guard}, {"none", EnergyLaw::none}},
                            key, value);
  read_option(r, key, value, [law](MethodOptions& options) { options.law = law; });
}

// Step sizes are fractions by nature: 1/256 says more than 0.00390625.
std::string written_step_size(const RunSpec& spec) {
  if (spec.h == 0) return "";
  const double parts = std::round(1 / spec.h);
  const bool is_fraction = parts >= 2 && parts < 1e9 && 1 / parts == spec.h;
  return is_fraction ? fmt::format("\"1/{}\"", static_cast<long>(parts)) : toml_real(spec.h);
}

struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  bool is_excluded = false;
  double maximum = std::numeric_limits<double>::infinity();
};
constexpr Range any{}, from_0{0}, above_0{0, true}, from_1{1};

struct Example {
  std::string text;
  bool is_default = true;
};
Example unless_given(const char* text) { return {text, false}; }
const Example of_the_problem{};

enum class Written { always, unless_default };

// Rows are added to the section that was begun last.
class KeyRows {
 public:
  void begin(const char* section) { section_ = section; }

  KeyRow& add(Kind kind, const char* name, std::string meaning, const Range& range, const Example& example,
              const char* synonyms = "") {
    KeyRow& row =
        all.emplace_back(KeyRow{.section = section_, .name = name, .meaning = std::move(meaning), .kind = kind});
    row.minimum = range.minimum, row.minimum_excluded = range.is_excluded, row.maximum = range.maximum;
    row.example = example.text, row.is_default = example.is_default;
    std::istringstream words(synonyms);
    for (std::string word; words >> word;) row.synonyms.push_back(word);
    return row;
  }

  // `write` gives the number, or nothing where the key may be left out.
  void number(const char* name, std::string meaning, const Range& range, const Example& example, const char* synonyms,
              ReadKey* read, std::optional<double> (*write)(const RunSpec&)) {
    KeyRow& row = add(Kind::number, name, std::move(meaning), range, example, synonyms);
    row.read = read;
    row.write = [write](const RunSpec& spec) {
      const std::optional<double> number = write(spec);
      return number ? toml_real(*number) : "";
    };
  }

  // `of(spec)` is the number.
  template <class Of>
  KeyRow& whole(const char* name, std::string meaning, const Range& range, const char* example, const char* synonyms,
                Of of) {
    KeyRow& row = add(Kind::whole, name, std::move(meaning), range, {example}, synonyms);
    row.read = [of](CaseReading& r, const KeyRow& self, const std::string& key, const CaseValue& value) {
      using Number = std::remove_reference_t<decltype(of(r.spec))>;
      of(r.spec) = static_cast<Number>(
          std::min(read_whole_within(self, key, value), static_cast<long>(std::numeric_limits<Number>::max())));
    };
    row.write = [of](const RunSpec& spec) { return fmt::format("{}", of(spec)); };
    return row;
  }

  // A number of the sparse backend, whose bounds are its own.
  template <class Of>
  void sparse_option(const char* name, std::string meaning, Of of) {
    KeyRow& row = whole(name, std::move(meaning), from_0, "0", "", of);
    row.read = [read = row.read](CaseReading& r, const KeyRow& self, const std::string& key, const CaseValue& value) {
      read(r, self, key, value);
      r.spec.sparse.validate();
    };
  }

  // The first name is the default.
  template <class T, class Of>
  KeyRow& choice(const char* name, const std::string& meaning, const Names<T>& names, Written when, Of of) {
    KeyRow& row = add(Kind::choice, name, meaning, any, {toml_string(names.front().first)});
    for (const auto& [choice, value] : names) row.choices.emplace_back(choice);
    row.read = [names, of](CaseReading& r, const KeyRow&, const std::string& key, const CaseValue& value) {
      of(r.spec) = read_named(names, key, value);
    };
    row.write = [names, when, of](const RunSpec& spec) {
      const bool is_left_out = when == Written::unless_default && of(spec) == names.front().second;
      return is_left_out ? "" : name_of<T>(names, of(spec));
    };
    return row;
  }

  template <class T>
  KeyRow& option(const char* name, const std::string& meaning, const Names<T>& names, Written when,
                 T MethodOptions::*member) {
    KeyRow& row = choice(
        name, meaning, names, when, [member](auto& spec) -> auto& { return spec.method_options.*member; });
    row.read = [names, member](CaseReading& r, const KeyRow&, const std::string& key, const CaseValue& value) {
      const T chosen = read_named(names, key, value);
      read_option(r, key, value, [&](MethodOptions& options) { options.*member = chosen; });
    };
    return row;
  }

  void text(const char* name, std::string meaning, std::vector<std::string> choices, const Example& example,
            const char* synonyms, ReadKey* read, std::string RunSpec::*member) {
    KeyRow& row = add(choices.empty() ? Kind::text : Kind::choice, name, std::move(meaning), any, example, synonyms);
    row.choices = std::move(choices);
    row.read = read;
    row.write = [member](const RunSpec& spec) { return toml_string(spec.*member); };
  }

  // The rows from `first` on are written all, or none where they say what holds without them.
  void write_together(std::size_t first, bool (*is_default)(const RunSpec&)) {
    for (std::size_t i = first; i < all.size(); ++i)
      all[i].write = [write = all[i].write, is_default](const RunSpec& spec) {
        return is_default(spec) ? "" : write(spec);
      };
  }

  std::vector<KeyRow> all;

 private:
  std::string section_;
};

using Maybe = std::optional<double>;
Maybe unless_0(double number) { return number != 0 ? Maybe(number) : std::nullopt; }

void add_method(KeyRows& rows) {
  rows.begin("method");
  rows.text("name", fmt::format("{}", fmt::join(or_auto(method_names()), " | ")), or_auto(method_names()),
            of_the_problem, "method solver integrator scheme", read_method, &RunSpec::method);
  rows.number("h", "step size, time; a number, or a fraction in quotes", above_0, of_the_problem,
              "dt h0 dt0 deltat step stepsize timestep timestepsize firststep", read_step_size, nullptr);
  rows.all.back().write = written_step_size;
  rows.number(
      "tolerance",
      "steps of variable size, each adding at most this error per time (max norm); h is then the first step tried",
      above_0, unless_given("1e-8"),
      "tol rtol atol reltol abstol relativetolerance absolutetolerance accuracy precision", read_tolerance,
      [](const RunSpec& spec) { return spec.tolerance; });
  rows.number("h_max", "with a tolerance: no longer step", above_0, unless_given("0.5"),
              "hmax maxh dtmax maxdt maxstep maxstepsize maximumstep", read_h_max,
              [](const RunSpec& spec) { return unless_0(spec.h_max); });
  KeyRow& C = rows.add(Kind::number, "C", "sav family: the shift in √(V + C), energy; \"auto\" or a number", any,
                       {toml_string("auto")});
  C.read = read_shift;
  C.write = [](const RunSpec& spec) {
    return spec.method_options.C ? toml_real(*spec.method_options.C) : toml_string("auto");
  };
  rows.option<AuxiliaryMode>(
      "auxiliary",
      "auto | transport | relaxed | frozen | refresh: what becomes of r beside a substep (sav, lm "
      "family)",
      {{"auto", AuxiliaryMode::automatic},
       {"transport", AuxiliaryMode::transport},
       {"relaxed", AuxiliaryMode::relaxed},
       {"frozen", AuxiliaryMode::frozen},
       {"refresh", AuxiliaryMode::refresh}},
      Written::always, &MethodOptions::auxiliary);
  rows.option<ScalarSolver>("scalar_solver", "lm family: robust | newton (the paper's)",
                            {{"robust", ScalarSolver::robust}, {"newton", ScalarSolver::newton}}, Written::always,
                            &MethodOptions::scalar_solver);
  rows.option<Predictor>("predictor",
                         "avf, sav, lm, dm: remembered (one gradient a step) | gradient (the paper's: two)",
                         {{"remembered", Predictor::remembered}, {"gradient", Predictor::gradient}},
                         Written::unless_default, &MethodOptions::predictor);
  KeyRow& law =
      rows.add(Kind::choice, "law",
               fmt::format("methods that end with a projection ({}): {}; the strongest they can have if not given",
                           fmt::join(projecting_methods(), ", "), fmt::join(energy_law_names(), " | ")),
               any, {toml_string("interval"), false});
  law.choices = energy_law_names();
  law.read = read_law;
  law.write = [](const RunSpec& spec) {
    return spec.method_options.law ? toml_string(to_string(*spec.method_options.law)) : "";
  };
  rows.option<LinearTreatment>("linear",
                               "crkn4, crkn6: exact | explicit (all forces as kicks: fastest where nothing is stiff)",
                               {{"exact", LinearTreatment::exact}, {"explicit", LinearTreatment::explicit_kicks}},
                               Written::unless_default, &MethodOptions::linear)
      .is_default = false;
}

void add_backend(KeyRows& rows) {
  rows.begin("backend");
  rows.text("name", fmt::format("{}", fmt::join(or_auto(backend_names()), " | ")), or_auto(backend_names()),
            {toml_string("auto")}, "", read_backend, &RunSpec::backend);
  rows.choice<bool>(
      "plan", "FFTW: estimate (repeatable to the bit) | measure (fastest)", {{"estimate", false}, {"measure", true}},
      Written::always, [](auto& spec) -> auto& { return spec.measure_plans; });
  rows.choice<ExponentialKind>(
      "exponential", "sparse, petsc: pade (factorises) | lanczos (M alone; S skew, M definite)",
      {{"pade", ExponentialKind::pade}, {"lanczos", ExponentialKind::lanczos}}, Written::always,
      [](auto& spec) -> auto& { return spec.sparse.exponential; });
  rows.sparse_option(
      "pade_degree", "sparse, petsc: 1 to 12; 0: whatever round-off asks for",
      [](auto& spec) -> auto& { return spec.sparse.pade_degree; });
  rows.sparse_option(
      "lanczos_dimension", "sparse, petsc: pairs of vectors, at least 2; 0: until nothing changes",
      [](auto& spec) -> auto& { return spec.sparse.lanczos_dimension; });
  KeyRow& solver =
      rows.add(Kind::text, "solver",
               "petsc: options of its linear solvers, \"-ksp_type gmres -pc_type jacobi\"; \"\": it factorises", any,
               {toml_string("")}, "linsolver linearsolver ksp");
  solver.read = [](CaseReading& r, const KeyRow&, const std::string& key, const CaseValue& value) {
    r.spec.sparse.solver = read_text(key, value);
  };
  solver.write = [](const RunSpec& spec) { return spec.sparse.solver.empty() ? "" : toml_string(spec.sparse.solver); };
}

void add_time(KeyRows& rows) {
  rows.begin("time");
  rows.number("start", "time of the initial state, which γ(t) and forces know", from_0, unless_given("0.0"),
              "t0 tstart tbegin starttime initialtime", read_start,
              [](const RunSpec& spec) { return unless_0(spec.t_start); });
  rows.number("end", "time", above_0, of_the_problem, "t tend tmax tfinal finaltime endtime tstop duration", read_end,
              [](const RunSpec& spec) { return Maybe(spec.t_end); });
}

void add_output(KeyRows& rows) {
  const auto ledger = [](auto& spec) -> auto& { return spec.ledger; };
  const auto report = [](auto& spec) -> auto& { return spec.report; };
  rows.begin("output");
  rows.text("directory", "made if it is not there", {}, of_the_problem, "dir folder out outdir", read_directory,
            &RunSpec::output_directory);
  rows.whole(
      "energy_every", "steps", from_1, "1", "", [](auto& spec) -> auto& { return spec.energy_every; });
  rows.whole(
          "snapshot_every", "steps; 0: the first and the last state only", from_0, "64", "saveevery nsave nout",
          [](auto& spec) -> auto& { return spec.snapshot_every; })
      .write = [](const RunSpec& spec) {
    return spec.snapshot_interval > 0 ? "" : fmt::format("{}", spec.snapshot_every);
  };
  rows.choice<bool>("ledger", "on: columns of energy.csv that say where the change of H comes from",
                    {{"off", false}, {"on", true}}, Written::unless_default, ledger);
  rows.choice<bool>("report", "report.html, to which seiche plot adds pictures; off: none",
                    {{"on", true}, {"off", false}}, Written::unless_default, report);
  rows.number(
      "snapshot_interval",
      "time between snapshots, in the place of steps; not given, with a tolerance: 512 in all, or 1024 of up to 16 "
      "unknowns",
      from_0, unless_given("0.5"), "saveat dtout dtsave saveinterval", read_snapshot_interval,
      [](const RunSpec& spec) { return unless_0(spec.snapshot_interval); });
  rows.number(
      "join_below",
      "GB; a solution of more stays in solution/ at the end, as its checkpoints left it, and solution.h5 shows it",
      from_0, unless_given("8"), "", read_join_below,
      [](const RunSpec& spec) { return spec.join_below == RunSpec().join_below ? Maybe() : spec.join_below; });
}

void add_checkpoint(KeyRows& rows) {
  const std::size_t first = rows.all.size();
  rows.begin("checkpoint");
  rows.number(
      "every_seconds",
      "time between checkpoints, from which `seiche resume` goes on; 0: only when a signal asks for one; not given: "
      "after 5, 10, 20, 40 s and then every minute, or fewer where they would take more than 1 % of the time",
      from_0, unless_given("60"), "", read_every_seconds,
      [](const RunSpec& spec) { return spec.checkpoint.every_seconds; });
  rows.whole(
      "every_steps", "steps; 0: by the clock alone", from_0, "0", "",
      [](auto& spec) -> auto& { return spec.checkpoint.every_steps; });
  rows.whole(
      "keep", "files: 2, the newest and the one before it, or 1", {1, false, 2}, "2", "",
      [](auto& spec) -> auto& { return spec.checkpoint.keep; });
  rows.write_together(first, [](const RunSpec& spec) { return spec.checkpoint == CheckpointSpec{}; });
}

void add_noise(KeyRows& rows) {
  const std::size_t first = rows.all.size();
  rows.begin("noise");
  rows.number(
      "temperature",
      "T of noise that balances the damping, or S = Sᵀ ⪯ 0: states ~ exp(−H/T), H a sum over points; 0: none", from_0,
      unless_given("0.01"), "kt kbt temp boltzmann theta noise noisetemperature",
      [](CaseReading& r, const KeyRow& row, const std::string& key, const CaseValue& value) {
        r.spec.noise.temperature = read_number_within(row, key, value);
      },
      [](const RunSpec& spec) { return Maybe(spec.noise.temperature); });
  KeyRow& seed = rows.add(Kind::whole, "seed", "of the noise: the same for any number of threads and processes", from_0,
                          unless_given("1"), "rngseed randomseed rng");
  seed.read = [](CaseReading& r, const KeyRow& row, const std::string& key, const CaseValue& value) {
    r.spec.noise.seed = static_cast<std::uint64_t>(read_whole_within(row, key, value));
  };
  seed.maximum = 9007199254740991;  // 2⁵³ − 1: numbers of a case are doubles
  seed.write = [](const RunSpec& spec) { return fmt::format("{}", spec.noise.seed); };
  rows.write_together(first, [](const RunSpec& spec) { return spec.noise == Noise{}; });
}

void add_ensemble(KeyRows& rows) {
  rows.begin("ensemble");
  rows.add(Kind::whole, "members", "how many; as many as there are files, if not given", from_1, unless_given("64"));
  rows.add(Kind::whole, "seed", "of random parameters and initial states", from_0, unless_given("1"));
  rows.add(Kind::number, "perturb_initial", "standard deviation of what is added to every initial value", from_0,
           unless_given("1e-3"));
}

}  // namespace

const std::vector<KeyRow>& key_rows() {
  static const std::vector<KeyRow> all = [] {
    KeyRows rows;
    for (const auto add : {add_method, add_backend, add_time, add_output, add_checkpoint, add_noise, add_ensemble})
      add(rows);
    return std::move(rows.all);
  }();
  return all;
}

const KeyRow& key_row(const std::string& section, const std::string& name) {
  for (const KeyRow& row : key_rows())
    if (row.section == section && row.name == name) return row;
  throw Error("a case file has no key {}.{}", section, name);
}

const std::vector<std::string>& case_sections() {
  static const std::vector<std::string> names = {"problem", "method",     "backend", "time",
                                                 "output",  "checkpoint", "noise",   "ensemble"};
  return names;
}

}  // namespace seiche
