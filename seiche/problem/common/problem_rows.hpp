// What a case file may say of a problem, with each parameter named once: its name, meaning and bounds, and the option
// that it sets. A row without a default takes that of the options.
#pragma once

#include <seiche/core/base/error.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/problem/common/grid_options.hpp>
#include <seiche/problem/common/problem_entry.hpp>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace seiche {

// Throws Error with the nearest name.
inline std::size_t place_among(const std::vector<std::string>& names, const std::string& name) {
  const auto place = std::find(names.begin(), names.end(), name);
  if (place == names.end()) throw unknown_name("choice", name, names);
  return static_cast<std::size_t>(place - names.begin());
}

template <class Options>
class ProblemRows {
 public:
  using Read = std::function<void(Options&, const ParameterValues&)>;

  // `about` without parameters and `make`; from_options gives the problem.
  ProblemRows(ProblemEntry about, Problem (*from_options)(const Options&))
      : entry_(std::move(about)), from_options_(from_options) {}

  ProblemRows& row(double Options::*option, Parameter p) {
    return add(std::move(p), ParameterKind::real, toml_real(Options{}.*option),
               [option](Options& o, const ParameterValues& v, const std::string& name) { o.*option = v.real(name); });
  }
  ProblemRows& row(Index Options::*option, Parameter p) { return whole(option, std::move(p)); }
  ProblemRows& row(int Options::*option, Parameter p) { return whole(option, std::move(p)); }
  ProblemRows& row(DampingRate Options::*option, Parameter p) {
    return add(std::move(p), ParameterKind::rate, "0.0",
               [option](Options& o, const ParameterValues& v, const std::string& name) {
                 o.*option = v.damping_rate(name);
               });
  }
  ProblemRows& row(RatePointer Options::*option, Parameter p) {
    return add(std::move(p), ParameterKind::rate, "0.0",
               [option](Options& o, const ParameterValues& v, const std::string& name) { o.*option = v.rate(name); });
  }
  ProblemRows& row(MatrixPointer Options::*option, Parameter p) {
    return add(std::move(p), ParameterKind::matrix, "",
               [option](Options& o, const ParameterValues& v, const std::string& name) { o.*option = v.matrix(name); });
  }
  // One of p.choices: the enumerator of its place, or true for the second of two.
  template <class Choice>
  ProblemRows& choice(Choice Options::*option, Parameter p) {
    const std::vector<std::string> names = p.choices;
    const std::string value = names.at(static_cast<std::size_t>(Options{}.*option));
    return add(std::move(p), ParameterKind::choice, value,
               [option, names](Options& o, const ParameterValues& v, const std::string& name) {
                 o.*option = static_cast<Choice>(place_among(names, v.choice(name)));
               });
  }
  // Anything else.
  ProblemRows& row(Parameter p, Read read) {
    entry_.parameters.push_back(std::move(p));
    reads_.push_back(std::move(read));
    return *this;
  }

  // length, points and boundary, each for every axis or a list.
  ProblemRows& axes(GridOptions Options::*option) {
    for (Parameter& p : axes_parameters(Options{}.*option)) entry_.parameters.push_back(std::move(p));
    reads_.push_back([option](Options& o, const ParameterValues& v) {
      const GridOptions read = axes_options(v);
      (o.*option).points = read.points;
      (o.*option).length = read.length;
      (o.*option).boundary = read.boundary;
      (o.*option).here = read.here;
    });
    return *this;
  }
  ProblemRows& grid(GridOptions Options::*option) {
    axes(option);
    row(discretisation_parameter(),
        [option](Options& o, const ParameterValues& v) { (o.*option).discretisation = discretisation_of(v); });
    return row(dealias_parameter(),
               [option](Options& o, const ParameterValues& v) { (o.*option).two_thirds = two_thirds_of(v); });
  }

  // Initial data by name, the default first.
  ProblemRows& preset(std::string name) {
    entry_.presets = {std::move(name)};
    return *this;
  }
  template <class Choice>
  ProblemRows& presets(Choice Options::*option, std::vector<std::string> names) {
    entry_.presets = names;
    preset_ = [option, names](Options& o, const std::string& name) {
      o.*option = static_cast<Choice>(place_among(names, name));
    };
    return *this;
  }

  operator ProblemEntry() const {  // NOLINT(google-explicit-constructor): the end of the rows
    ProblemEntry entry = entry_;
    entry.make = [reads = reads_, preset = preset_, make = from_options_](const ParameterValues& values,
                                                                          const std::string& name) {
      Options options;
      for (const Read& read : reads) read(options, values);
      if (preset) preset(options, name);
      return make(options);
    };
    return entry;
  }

 private:
  template <class Integer>
  ProblemRows& whole(Integer Options::*option, Parameter p) {
    return add(std::move(p), ParameterKind::integer, std::to_string(Options{}.*option),
               [option](Options& o, const ParameterValues& v, const std::string& name) {
                 o.*option = static_cast<Integer>(v.integer(name));
               });
  }
  template <class Set>
  ProblemRows& add(Parameter p, ParameterKind kind, const std::string& value, const Set& set) {
    p.kind = kind;
    if (p.default_value.empty()) p.default_value = value;
    return row(p, [set, name = p.name](Options& o, const ParameterValues& v) { set(o, v, name); });
  }

  ProblemEntry entry_;
  Problem (*from_options_)(const Options&);
  std::vector<Read> reads_;
  std::function<void(Options&, const std::string&)> preset_;
};

}  // namespace seiche
