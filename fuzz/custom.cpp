// Whatever formula stands at any place of a custom problem that takes one, the problem is made or refused with a
// sentence.
#include <seiche/config/case/case_file.hpp>
#include <seiche/config/data/case_value.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/law/law.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace seiche {
namespace {

const std::string wave = R"([problem]
name = "custom"
fields = ["u", "v"]
points = 4
length = 2.0
parameters = { kappa = 0.04 }
)";
const std::string energy = "H = \"v^2/2 + du^2/2 + u^4/4\"\n";
const std::string spectral = "discretisation = \"spectral\"\n";  // functions of k ask for it
const std::string start = "initial = { u = \"cos(pi*x)\", v = 0 }\n";

void make(const std::string& lines) {
  try {
    const Problem problem = make_problem(parse_case(wave + lines, "case.toml"));
    require_finite_rates(problem, 0, 1);
    if (!problem.friction) return;
    const std::vector<double> q = {0.3, -0.7, 0.0, 1e3}, v = {-0.2, 0.0, 1e-9, 40.0};
    std::vector<double> out(q.size());
    problem.friction->force(0.5, q, v, out);
    out = v;
    problem.friction->flow(0.5, 0.25, 1.0, q, out);
  } catch (const Error&) {
  }
}

}  // namespace
}  // namespace seiche

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seiche;
  const std::string formula = toml_string(std::string(reinterpret_cast<const char*>(data), size));
  make(energy + "initial = { u = " + formula + ", v = 0 }\n");
  make(energy + start + "force = " + formula + "\n");
  make(energy + start + "friction = { kind = \"formula\", r = " + formula + " }\n");
  make(energy + start + "friction = { kind = \"position\", coefficient = " + formula + " }\n");
  make(spectral + "H = \"v^2/2 + u_x^2/2 + u^4/4\"\n" + start + "D = { v = " + formula + " }\n");
  make(spectral + "M = [[" + formula + ", 0], [0, 1]]\nV = \"u^4/4\"\n" + start);
  return 0;
}
