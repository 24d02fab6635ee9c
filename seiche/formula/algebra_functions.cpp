#include <seiche/core/base/error.hpp>
#include <seiche/formula/algebra_functions.hpp>

#include <map>

namespace seiche {
namespace {

using GiNaC::ex;

// abs, its derivative sign, and sech are declared here. GiNaC writes |x|' as x/|x|, which is NaN at 0 — and so
// is the force of |q|³ at rest — and has no sech.
constexpr const char* own_abs = "magnitude";  // GiNaC warns of a second one with the same name

ex function_of(unsigned serial, const ex& x) { return GiNaC::function(serial, x); }
ex held(unsigned serial, const ex& x) { return GiNaC::function(serial, x).hold(); }

unsigned abs_serial();
unsigned sign_serial();
unsigned sech_serial();

bool is_number(const ex& x) { return GiNaC::is_a<GiNaC::numeric>(x); }
ex sign_of(const ex& number) { return GiNaC::ex_to<GiNaC::numeric>(number).csgn(); }

// The number in front of a product: |−2x| = 2|x|.
ex number_in_front(const ex& x) {
  if (!GiNaC::is_a<GiNaC::mul>(x)) return 1;
  for (const ex& factor : x)
    if (is_number(factor)) return factor;
  return 1;
}

ex abs_eval(const ex& x) {
  if (is_number(x)) return GiNaC::abs(x);
  if (GiNaC::is_a<GiNaC::function>(x) && GiNaC::ex_to<GiNaC::function>(x).get_serial() == abs_serial()) return x;
  const ex number = number_in_front(x);
  if (!number.is_equal(1)) return GiNaC::abs(number) * function_of(abs_serial(), x / number);
  return held(abs_serial(), x);
}
ex abs_evalf(const ex& x) { return is_number(x) ? GiNaC::abs(x) : held(abs_serial(), x); }
ex abs_derivative(const ex& x, unsigned) { return function_of(sign_serial(), x); }
ex abs_power(const ex& x, const ex& exponent) {
  if (exponent.info(GiNaC::info_flags::even)) return GiNaC::power(x, exponent);
  return GiNaC::power(held(abs_serial(), x), exponent).hold();
}

ex sign_eval(const ex& x) {
  if (is_number(x)) return sign_of(x);
  const ex number = number_in_front(x);
  if (!number.is_equal(1)) return sign_of(number) * function_of(sign_serial(), x / number);
  return held(sign_serial(), x);
}
ex sign_evalf(const ex& x) { return is_number(x) ? sign_of(x) : held(sign_serial(), x); }
ex sign_derivative(const ex&, unsigned) { return 0; }  // but at 0, where V has a kink

ex sech_eval(const ex& x) { return x.is_zero() ? ex(1) : held(sech_serial(), x); }
ex sech_evalf(const ex& x) { return is_number(x) ? ex(1 / GiNaC::cosh(x)) : held(sech_serial(), x); }
ex sech_derivative(const ex& x, unsigned) { return -function_of(sech_serial(), x) * GiNaC::tanh(x); }

unsigned abs_serial() {
  static const unsigned serial = GiNaC::function::register_new(GiNaC::function_options(own_abs, 1)
                                                                   .eval_func(abs_eval)
                                                                   .evalf_func(abs_evalf)
                                                                   .derivative_func(abs_derivative)
                                                                   .power_func(abs_power));
  return serial;
}

unsigned sign_serial() {
  static const unsigned serial = GiNaC::function::register_new(
      GiNaC::function_options("sign", 1).eval_func(sign_eval).evalf_func(sign_evalf).derivative_func(sign_derivative));
  return serial;
}

unsigned sech_serial() {
  static const unsigned serial = GiNaC::function::register_new(
      GiNaC::function_options("sech", 1).eval_func(sech_eval).evalf_func(sech_evalf).derivative_func(sech_derivative));
  return serial;
}

struct ToSech : GiNaC::map_function {
  ex operator()(const ex& e) override {
    const bool is_power_of_cosh = GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::negint) &&
                                  GiNaC::is_the_function<GiNaC::cosh_SERIAL>(e.op(0));
    return is_power_of_cosh ? GiNaC::power(function_of(sech_serial(), (*this)(e.op(0).op(0))), -e.op(1)) : e.map(*this);
  }
};

}  // namespace

Expression call_function(std::string_view name, const Expression& x) {
  using Apply = Expression (*)(const Expression&);
  static const std::map<std::string_view, Apply> functions = {
      {"sin", [](const Expression& a) -> Expression { return GiNaC::sin(a); }},
      {"cos", [](const Expression& a) -> Expression { return GiNaC::cos(a); }},
      {"tan", [](const Expression& a) -> Expression { return GiNaC::tan(a); }},
      {"asin", [](const Expression& a) -> Expression { return GiNaC::asin(a); }},
      {"acos", [](const Expression& a) -> Expression { return GiNaC::acos(a); }},
      {"atan", [](const Expression& a) -> Expression { return GiNaC::atan(a); }},
      {"sinh", [](const Expression& a) -> Expression { return GiNaC::sinh(a); }},
      {"cosh", [](const Expression& a) -> Expression { return GiNaC::cosh(a); }},
      {"tanh", [](const Expression& a) -> Expression { return GiNaC::tanh(a); }},
      {"asinh", [](const Expression& a) -> Expression { return GiNaC::asinh(a); }},
      {"acosh", [](const Expression& a) -> Expression { return GiNaC::acosh(a); }},
      {"atanh", [](const Expression& a) -> Expression { return GiNaC::atanh(a); }},
      {"exp", [](const Expression& a) -> Expression { return GiNaC::exp(a); }},
      {"log", [](const Expression& a) -> Expression { return GiNaC::log(a); }},
      {"expm1", [](const Expression& a) -> Expression { return GiNaC::exp(a) - 1; }},
      {"log1p", [](const Expression& a) -> Expression { return GiNaC::log(1 + a); }},
      {"sqrt", [](const Expression& a) -> Expression { return GiNaC::sqrt(a); }},
      {"abs", [](const Expression& a) -> Expression { return function_of(abs_serial(), a); }},
      {"sech", [](const Expression& a) -> Expression { return function_of(sech_serial(), a); }},
  };
  const auto found = functions.find(name);
  if (found == functions.end()) throw Error("{} has no derivative here", name);
  return found->second(x);
}

std::string name_of_function(const Expression& function) {
  const std::string name = GiNaC::ex_to<GiNaC::function>(function).get_name();
  return name == own_abs ? "abs" : name;
}

Expression with_sech(const Expression& expression) {
  ToSech map;
  return map(expression);
}

}  // namespace seiche
