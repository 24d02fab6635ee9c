// What a problem may be told: named values with defaults, bounds and a meaning, so that case files, error
// messages and `seiche new` all read one list.
#pragma once

#include <seiche/core/base/sparse_matrix.hpp>
#include <seiche/core/damping_rate.hpp>
#include <seiche/core/structure.hpp>

#include <limits>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace seiche {

// rate: a number, or a formula in t and place; function: a number, or a formula in the first field; matrix: the name of
// its file, or "" for none
enum class ParameterKind { real, integer, rate, function, choice, matrix };

struct Parameter {
  std::string name;
  ParameterKind kind = ParameterKind::real;
  std::string default_value = {};
  std::string meaning;
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool minimum_excluded = false;
  std::vector<std::string> choices = {};
  bool per_axis = false;  // one value for every axis, or a list with one for each
};

using MatrixPointer = std::shared_ptr<const SparseMatrix>;
using ParameterValue = std::variant<double, long, RatePointer, SpaceRatePointer, StateFunctionPointer, std::string,
                                    MatrixPointer, std::vector<double>, std::vector<long>, std::vector<std::string>>;

// Checked values, one for every Parameter of a problem. get<T> throws Error on a name the problem did not declare.
class ParameterValues {
 public:
  Rank here = {};  // of several processes that share a grid: whose part of it is to be made

  void set(const std::string& name, ParameterValue value);
  template <class T>
  const T& get(const std::string& name) const {
    return std::get<T>(at(name));
  }
  double real(const std::string& name) const { return get<double>(name); }
  long integer(const std::string& name) const { return get<long>(name); }
  const RatePointer& rate(const std::string& name) const;        // of t alone; throws Error on one that varies in space
  DampingRate damping_rate(const std::string& name) const;       // either
  StateFunctionPointer function(const std::string& name) const;  // null where a number is given
  const MatrixPointer& matrix(const std::string& name) const { return get<MatrixPointer>(name); }  // null: none
  const std::string& choice(const std::string& name) const { return get<std::string>(name); }
  // Of parameters that are per_axis: what the user wrote, one entry or one for each axis.
  const std::vector<double>& reals(const std::string& name) const { return get<std::vector<double>>(name); }
  const std::vector<long>& integers(const std::string& name) const { return get<std::vector<long>>(name); }
  const std::vector<std::string>& choices(const std::string& name) const { return get<std::vector<std::string>>(name); }
  std::vector<double> numbers(const Parameter& parameter) const;  // of one that is real or integer, per axis or not

 private:
  const ParameterValue& at(const std::string& name) const;
  std::map<std::string, ParameterValue> values_;
};

// One sentence where `value` is outside the bounds of `parameter`, else "".
std::string out_of_bounds(const Parameter& parameter, double value);

}  // namespace seiche
