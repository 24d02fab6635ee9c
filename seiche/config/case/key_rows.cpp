#include <seiche/config/case/case_reading.hpp>
#include <seiche/config/case/key_rows.hpp>
#include <seiche/core/error.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace seiche {
namespace {

using Kind = KeyRow::Kind;
using Read = void(CaseReading& r, const std::string& key, const CaseValue& value);
template <class T>
using Names = std::vector<std::pair<const char*, T>>;

std::vector<std::string> or_auto(std::vector<std::string> names) {
  std::erase(names, "auto");
  names.emplace(names.begin(), "auto");
  return names;
}

std::vector<std::string_view> projecting_methods() {
  std::vector<std::string_view> names;
  for (const MethodEntry& method : methods())
    if (method.projects()) names.push_back(method.name);
  return names;
}

double read_number_within(const KeyRow& row, const std::string& key, const CaseValue& value) {
  const double number = read_number(key, value);
  if (number < row.minimum || (row.minimum_excluded && number == row.minimum))
    throw Error("{} = {} must be {} {}", key, value.shown(), row.minimum_excluded ? ">" : "≥", row.minimum);
  return number;
}

long read_whole_within(const KeyRow& row, const std::string& key, const CaseValue& value) {
  const long number = read_whole(key, value, static_cast<long>(row.minimum));
  if (static_cast<double>(number) > row.maximum) throw Error("{} = {} must be ≤ {}", key, value.shown(), row.maximum);
  return number;
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

// An option of methods is validated alone too, so that a complaint stands at the key that caused it.
void read_option(CaseReading& r, const std::string& key, const CaseValue& value,
                 const std::function<void(MethodOptions&)>& set) {
  MethodOptions alone;
  set(alone);
  if (!r.methods.empty()) {
    std::optional<Error> first;
    const bool is_known = std::any_of(r.methods.begin(), r.methods.end(), [&](const std::string& name) {
      try {
        alone.validate(find_method(name));
        return true;
      } catch (const Error& error) {
        if (!first) first = error;
        return false;
      }
    });
    if (!is_known) throw Error(*first);
  } else if (r.spec.method == "auto" && alone != MethodOptions{}) {
    throw Error(
        "{} = {} belongs to one method, and method.name = \"auto\" is yet to choose it: leave it out, or name a "
        "method",
        key, value.shown());
  } else if (r.spec.method != "auto" && !r.spec.method.empty()) {
    alone.validate(find_method(r.spec.method));
  }
  set(r.spec.method_options);
}

void read_method(CaseReading& r, const std::string&, const CaseValue& value) {
  r.spec.method.clear();  // also after a complaint, so that options are not compared with another one
  std::vector<std::string> names = method_names();
  names.emplace_back("auto");
  r.spec.method = read_name("method", value, names);
}

void read_step_size(CaseReading& r, const std::string& key, const CaseValue& value) {
  const RunSpec& spec = r.spec;
  const double h = read_number_within(key_row("method", "h"), key, value);
  if (r.problem == nullptr && spec.duration() == 0) return;
  if (h > spec.duration())
    throw Error("{} = {} must be ≤ {}", key, value.shown(),
                spec.t_start == 0 ? fmt::format("time.end = {}", spec.t_end)
                                  : fmt::format("{}, the time from time.start to time.end", spec.duration()));
  if (spec.duration() / h > 1e15)
    throw Error("{} = {} would take {:.3g} steps", key, value.shown(), spec.duration() / h);
  r.spec.h = h;
}

// Step sizes are fractions by nature: 1/256 says more than 0.00390625.
std::string written_step_size(const RunSpec& spec) {
  const double parts = std::round(1 / spec.h);
  const bool is_fraction = parts >= 2 && parts < 1e9 && 1 / parts == spec.h;
  if (spec.h == 0) return "";
  return is_fraction ? fmt::format("\"1/{}\"", static_cast<long>(parts)) : toml_real(spec.h);
}

void read_tolerance(CaseReading& r, const std::string& key, const CaseValue& value) {
  r.spec.tolerance = read_number_within(key_row("method", "tolerance"), key, value);
}

void read_h_max(CaseReading& r, const std::string& key, const CaseValue& value) {
  const double h = read_number_within(key_row("method", "h_max"), key, value);
  if (!r.asks_for_tolerance())
    throw Error("{} = {} needs method.tolerance: it bounds steps of variable size", key, value.shown());
  r.spec.h_max = h;
}

void read_shift(CaseReading& r, const std::string& key, const CaseValue& value) {
  if (value.kind == CaseValue::Kind::text && value.text == "auto") return;
  if (value.kind != CaseValue::Kind::number && value.kind != CaseValue::Kind::text)
    throw Error("{} = {} must be a number or \"auto\"", key, value.shown());
  const double C = read_number(key, value);
  read_option(r, key, value, [C](MethodOptions& options) { options.C = C; });
}

void read_law(CaseReading& r, const std::string& key, const CaseValue& value) {
  const EnergyLaw law =
      read_named<EnergyLaw>({{"interval", EnergyLaw::interval}, {"guard", EnergyLaw::guard}, {"none", EnergyLaw::none}},
                            key, value);
  read_option(r, key, value, [law](MethodOptions& options) { options.law = law; });
}

void read_start(CaseReading& r, const std::string& key, const CaseValue& value) {
  const double start = read_number(key, value);
  // Hypotheses of the energy law are looked at from t = 0 on.
  if (start < 0)
    throw Error("{} = {} must be ≥ 0: rather shift the formulas in t, so that the run begins at 0", key, value.shown());
  r.spec.t_start = start;
}

void read_end(CaseReading& r, const std::string& key, const CaseValue& value) {
  const double end = read_number(key, value);
  if (end <= r.spec.t_start)
    throw Error("{} = {} must be > {}", key, value.shown(),
                r.spec.t_start == 0 ? "0" : fmt::format("time.start = {}", r.spec.t_start));
  r.spec.t_end = end;
}

void read_backend(CaseReading& r, const std::string&, const CaseValue& value) {
  r.spec.backend = read_name("backend", value, or_auto(backend_names()));
}

void read_directory(CaseReading& r, const std::string& key, const CaseValue& value) {
  r.spec.output_directory = read_text(key, value);
  if (r.spec.output_directory.empty()) throw Error("{} must not be empty", key);
}

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

void read_snapshot_interval(CaseReading& r, const std::string& key, const CaseValue& value) {
  RunSpec& spec = r.spec;
  const double interval = read_number_within(key_row("output", "snapshot_interval"), key, value);
  if (interval > 0 && spec.duration() / interval > 1e7)
    throw Error("{} = {} would make {:.3g} snapshots", key, value.shown(), spec.duration() / interval);
  if (interval == 0 || r.asks_for_tolerance()) {
    spec.snapshot_interval = interval;
  } else if (spec.h > 0) {
    spec.snapshot_every = steps_between_snapshots(key, value, spec.h);
  }
}

void read_every_seconds(CaseReading& r, const std::string& key, const CaseValue& value) {
  r.spec.checkpoint.every_seconds = read_number_within(key_row("checkpoint", "every_seconds"), key, value);
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
              Read* read, std::optional<double> (*write)(const RunSpec&)) {
    KeyRow& row = add(Kind::number, name, std::move(meaning), range, example, synonyms);
    row.read = read;
    row.write = [write](const RunSpec& spec) {
      const std::optional<double> number = write(spec);
      return number ? toml_real(*number) : "";
    };
  }

  // `of(spec)` is the number.
  template <class Of>
  void whole(const char* name, std::string meaning, const Range& range, const char* example, const char* synonyms,
             Of of) {
    KeyRow& row = add(Kind::whole, name, std::move(meaning), range, {example}, synonyms);
    row.read = [row, of](CaseReading& r, const std::string& key, const CaseValue& value) {
      using Number = std::remove_reference_t<decltype(of(r.spec))>;
      of(r.spec) = static_cast<Number>(
          std::min(read_whole_within(row, key, value), static_cast<long>(std::numeric_limits<Number>::max())));
      r.spec.sparse.validate();
    };
    row.write = [of](const RunSpec& spec) { return fmt::format("{}", of(spec)); };
  }

  // The first name is the default.
  template <class T, class Of>
  KeyRow& choice(const char* name, std::string meaning, const Names<T>& names, Written when, Of of) {
    KeyRow& row = add(Kind::choice, name, std::move(meaning), any, {toml_string(names.front().first)});
    for (const auto& [choice, value] : names) row.choices.emplace_back(choice);
    row.read = [names, of](CaseReading& r, const std::string& key, const CaseValue& value) {
      of(r.spec) = read_named(names, key, value);
    };
    row.write = [names, when, of](const RunSpec& spec) {
      const bool is_left_out = when == Written::unless_default && of(spec) == names.front().second;
      return is_left_out ? "" : name_of<T>(names, of(spec));
    };
    return row;
  }

  template <class T>
  KeyRow& option(const char* name, std::string meaning, const Names<T>& names, Written when, T MethodOptions::*member) {
    KeyRow& row = choice(
        name, std::move(meaning), names, when, [member](auto& spec) -> auto& { return spec.method_options.*member; });
    row.read = [names, member](CaseReading& r, const std::string& key, const CaseValue& value) {
      const T chosen = read_named(names, key, value);
      read_option(r, key, value, [&](MethodOptions& options) { options.*member = chosen; });
    };
    return row;
  }

  void text(const char* name, std::string meaning, std::vector<std::string> choices, const Example& example,
            const char* synonyms, Read* read, std::string RunSpec::*member) {
    KeyRow& row = add(choices.empty() ? Kind::text : Kind::choice, name, std::move(meaning), any, example, synonyms);
    row.choices = std::move(choices);
    row.read = read;
    row.write = [member](const RunSpec& spec) { return toml_string(spec.*member); };
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
  rows.option<AuxiliaryMode>("auxiliary", "transport | frozen | refresh: what the damping does to r (sav, lm family)",
                             {{"transport", AuxiliaryMode::transport},
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
      "exponential", "sparse: pade (factorises) | lanczos (does not; S skew, M definite)",
      {{"pade", ExponentialKind::pade}, {"lanczos", ExponentialKind::lanczos}}, Written::always,
      [](auto& spec) -> auto& { return spec.sparse.exponential; });
  rows.whole(
      "pade_degree", "sparse: 1 to 12; 0: whatever round-off asks for", from_0, "0", "",
      [](auto& spec) -> auto& { return spec.sparse.pade_degree; });
  rows.whole(
      "lanczos_dimension", "sparse: pairs of vectors, at least 2; 0: until nothing changes", from_0, "0", "",
      [](auto& spec) -> auto& { return spec.sparse.lanczos_dimension; });
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
      [](auto& spec) -> auto& { return spec.snapshot_every; });
  rows.choice<bool>("ledger", "on: columns of energy.csv that say where the change of H comes from",
                    {{"off", false}, {"on", true}}, Written::unless_default, ledger);
  rows.choice<bool>("report", "report.html, to which seiche plot adds pictures; off: none",
                    {{"on", true}, {"off", false}}, Written::unless_default, report);
  rows.number(
      "snapshot_interval",
      "with a tolerance: time between snapshots; 0: by steps; not given: 512 in all, or 1024 of up to 16 unknowns",
      from_0, unless_given("0.5"), "saveat dtout dtsave saveinterval", read_snapshot_interval,
      [](const RunSpec& spec) { return unless_0(spec.snapshot_interval); });
}

// Its keys are written together, or not at all.
void add_checkpoint(KeyRows& rows) {
  const std::size_t first = rows.all.size();
  rows.begin("checkpoint");
  rows.number("every_seconds",
              "time between checkpoints, from which `seiche resume` goes on; 0: only when a signal asks for one",
              from_0, {"600"}, "", read_every_seconds,
              [](const RunSpec& spec) { return Maybe(spec.checkpoint.every_seconds); });
  rows.whole(
      "every_steps", "steps; 0: by the clock alone", from_0, "0", "",
      [](auto& spec) -> auto& { return spec.checkpoint.every_steps; });
  rows.whole(
      "keep", "files: 2, the newest and the one before it, or 1", {1, false, 2}, "2", "",
      [](auto& spec) -> auto& { return spec.checkpoint.keep; });
  for (std::size_t i = first; i < rows.all.size(); ++i)
    rows.all[i].write = [write = rows.all[i].write](const RunSpec& spec) {
      return spec.checkpoint == CheckpointSpec{} ? "" : write(spec);
    };
}

void add_ensemble(KeyRows& rows) {
  rows.begin("ensemble");
  rows.add(Kind::whole, "members", "how many; as many as there are files, if not given", from_1, unless_given("64"));
  rows.add(Kind::whole, "seed", "of all random numbers", from_0, unless_given("1"));
  rows.add(Kind::number, "perturb_initial", "standard deviation of what is added to every initial value", from_0,
           unless_given("1e-3"));
}

}  // namespace

const std::vector<KeyRow>& key_rows() {
  static const std::vector<KeyRow> all = [] {
    KeyRows rows;
    for (const auto add : {add_method, add_backend, add_time, add_output, add_checkpoint, add_ensemble}) add(rows);
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
                                                 "output",  "checkpoint", "ensemble"};
  return names;
}

}  // namespace seiche
