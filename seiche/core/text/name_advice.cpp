#include <seiche/core/text/axis_names.hpp>
#include <seiche/core/text/name_advice.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace seiche {
namespace {

using Kind = FormulaContext::Kind;

template <std::size_t N>
bool is_one_of(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

constexpr std::array<std::string_view, 3> places = {"x", "y", "z"};
constexpr std::array<std::string_view, 4> wave_numbers = {"k", "k_x", "k_y", "k_z"};
constexpr std::array<std::string_view, 10> derivations = {"diff", "Diff", "Derivative", "grad",    "gradient",
                                                          "div",  "curl", "del",        "laplace", "nabla"};
constexpr std::array<std::string_view, 4> operators = {"d_x", "d_y", "d_z", "laplacian"};

class Advisor {
 public:
  explicit Advisor(FormulaContext context) : c_(std::move(context)) {}

  std::string operator()(std::string_view name) const {
    for (const std::string& field : c_.fields) {
      if (name == field) return of_field(field);
      if (is_derivative_of(field, name)) return of_derivative(name);
      if (is_time_derivative_of(field, name)) return of_velocity(name);
    }
    if (is_one_of(derivations, name)) return of_derivative(c_.fields.empty() ? "u_x" : c_.fields.front() + "_x");
    if (name == "t") return of_time();
    if (is_one_of(places, name)) return of_place(name);
    if (is_one_of(wave_numbers, name)) return of_wave_number(name) + or_parameter(name);
    if (is_one_of(operators, name)) return of_operator(name);
    if (name == "j" && c_.kind != Kind::initial)
      return c_.axes == 1 ? of_place(name) : "j, the number of a point, stands in formulas on a line and in initial";
    return "";
  }

  std::string of_unknown(std::string_view name) const {
    if (!c_.takes_parameters) return "";
    const std::string what = c_.kind == Kind::energy
                                 ? fmt::format("it is neither a field ({}) nor a parameter", fmt::join(c_.fields, ", "))
                                 : "it is no parameter";
    return fmt::format("{}; for a number of your own write problem.parameters = {{ {} = … }}", what, name);
  }

 private:
  // u_x, u_xx, ux, uxx, du
  static bool is_derivative_of(std::string_view field, std::string_view name) {
    if (name.front() == 'd' && name.substr(1) == field) return true;
    const std::string_view axes = behind(field, name);
    return !axes.empty() && std::all_of(axes.begin(), axes.end(), [](char c) { return c >= 'x' && c <= 'z'; });
  }
  // u_t, u_tt, ut
  static bool is_time_derivative_of(std::string_view field, std::string_view name) {
    const std::string_view letters = behind(field, name);
    return letters == "t" || letters == "tt";
  }
  // xx of u_xx and of uxx
  static std::string_view behind(std::string_view field, std::string_view name) {
    if (!name.starts_with(field)) return "";
    name.remove_prefix(field.size());
    if (name.starts_with('_')) name.remove_prefix(1);
    return name;
  }

  std::string of_velocity(std::string_view name) const {
    return fmt::format("{} is a velocity, which is a field of its own, and the fields are {}", name,
                       fmt::join(c_.fields, ", "));
  }

  std::string of_field(std::string_view field) const {
    switch (c_.kind) {
      case Kind::constant_entry:
        return fmt::format(
            "{} is a field, and entries of S and M are constant: numbers and derivatives. A structure S(z) is written in C++ (seiche::Structure, "
            "as in the problem rigid_body), and egc2 … egc8, seimp and etdrk4 take it",
            field);
      case Kind::damping_entry:
        return fmt::format(
            "{} is a field, and D is linear: its entries are coefficients, rates in t and the place, and derivatives; damping "
            "that depends on fields is problem.friction",
            field);
      case Kind::rate:
        return fmt::format(
            "{} is a field, and a rate is a formula in t and the place: damping that depends on fields is problem.friction",
            field);
      case Kind::initial: return fmt::format("{} is a field, and its initial values are given by the place", field);
      case Kind::force:
        return fmt::format(
            "{} is a field, and an external force is a formula in t and the place: forces that depend on fields come from the "
            "energy, or from problem.friction",
            field);
      case Kind::friction:
        return fmt::format(
            "{} is a field, and the formula serves every coordinate with its velocity: write u and v for them", field);
      default: return "";
    }
  }

  std::string of_derivative(std::string_view name) const {
    if (c_.axes == 0) return needs_grid(name);
    switch (c_.kind) {
      case Kind::energy:
        return fmt::format(
            "derivatives of a field u are written u_x and u_xx, u_y, … for the axes of the grid, which has {}, and du "
            "is the difference to the next point on a line",
            c_.axes);
      case Kind::constant_entry:
      case Kind::damping_entry: return "derivatives are written as operators here: d_x, d_x^2, laplacian";
      default: return "derivatives of fields stand in H only";
    }
  }

  std::string of_time() const {
    switch (c_.kind) {
      case Kind::energy: return "the energy has no t: what changes in time is D, friction or force";
      case Kind::constant_entry: return "entries of S and M have no t: what changes in time is D, friction or force";
      case Kind::initial: return "initial values have no t: they are those at the start";
      default: return "";
    }
  }

  std::string of_place(std::string_view name) const {
    if (c_.axes == 0) return needs_grid(name);
    if (c_.kind == Kind::constant_entry) return "entries of S and M are the same everywhere: numbers and derivatives";
    return "the grid has " + counted_axes(c_.axes);
  }

  std::string of_wave_number(std::string_view name) const {
    if (c_.kind == Kind::constant_entry || c_.kind == Kind::damping_entry)
      return c_.axes == 0 ? fmt::format("{}, the wave number, stands where there is a grid with Fourier modes", name)
                          : fmt::format("the wave number along an axis needs that axis, and the grid has {}", c_.axes);
    return fmt::format("{}, the wave number, stands in S, M and D only, on a grid with Fourier modes", name);
  }

  std::string or_parameter(std::string_view name) const {
    return c_.takes_parameters ? fmt::format("; for a number write problem.parameters = {{ {} = … }}", name) : "";
  }

  std::string of_operator(std::string_view name) const {
    if (c_.axes == 0) return needs_grid(name);
    if (c_.kind == Kind::energy) return fmt::format("{} stands in S, M and D; in an energy write u_x or u_xx", name);
    if (c_.kind == Kind::constant_entry || c_.kind == Kind::damping_entry)
      return "the grid has " + counted_axes(c_.axes);
    return fmt::format("{} stands in S, M and D only", name);
  }

  static std::string needs_grid(std::string_view name) {
    return fmt::format("{} needs a grid, which problem.length and problem.points make", name);
  }

  FormulaContext c_;
};

}  // namespace

NameAdvice advice_in(FormulaContext context) {
  return [advisor = Advisor(std::move(context))](std::string_view name, bool is_near_another) {
    std::string known = advisor(name);
    return known.empty() && !is_near_another ? advisor.of_unknown(name) : known;
  };
}

bool is_unit(std::string_view name) {
  static constexpr std::array<std::string_view, 27> units = {"s",   "ms", "us", "ns", "min", "sec", "hr", "Hz",  "kHz",
                                                             "MHz", "m",  "mm", "cm", "km",  "um",  "nm", "kg",  "g",
                                                             "N",   "kN", "J",  "W",  "Pa",  "K",   "V",  "rad", "deg"};
  return is_one_of(units, name);
}

}  // namespace seiche
