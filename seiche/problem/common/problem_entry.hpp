// One row of the list of problems.
#pragma once

#include <seiche/core/parameter.hpp>
#include <seiche/core/problem.hpp>

#include <functional>
#include <string>
#include <vector>

namespace seiche {

struct ProblemEntry {
  std::string name;
  std::string title = {};  // what people call it: "Klein–Gordon equation"; "" of one that is written down
  std::string equation;    // in Unicode
  std::string reference;   // where it comes from
  std::vector<std::string> fields;
  std::vector<std::string> meanings = {};  // of the fields, in their order: "displacement"
  std::vector<Parameter> parameters = {};
  std::vector<std::string> presets = {};  // names of initial data, the default first
  // Throws Error where the values do not fit together.
  std::function<Problem(const ParameterValues& values, const std::string& preset)> make = {};
  // What `seiche new` proposes, and a case file that is silent takes.
  std::string default_h;
  double default_end;
  std::string default_method = "seisav";
};

}  // namespace seiche
