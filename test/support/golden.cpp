#include <test/support/golden.hpp>

#include <test/support/paths.hpp>

#include <algorithm>
#include <fstream>

namespace seiche::test {
namespace {

const nlohmann::json& golden() {
  static const nlohmann::json document = [] {
    std::ifstream file(test::test_data_directory() + "/golden.json");
    return nlohmann::json::parse(file);
  }();
  return document;
}

}  // namespace

const nlohmann::json& golden_case(const std::string& name) { return golden().at("cases").at(name); }

Vector golden_vector(const nlohmann::json& numbers) {
  const auto values = numbers.get<std::vector<double>>();
  return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

const nlohmann::json& GoldenMethod::result(double h) const {
  for (const auto& [key, value] : results.items())
    if (std::stod(key) == h) return value;
  throw std::out_of_range("no golden result for this step size");
}

SimulationOptions GoldenMethod::options(std::string_view backend, ScalarSolver solver) const {
  SimulationOptions options{.method = method, .backend = std::string(backend)};
  options.method_options =
      MethodOptions{.C = C, .scalar_solver = solver, .predictor = Predictor::gradient}.meant_for(find_method(method));
  if (literal) options.method_options.auxiliary = AuxiliaryMode::frozen;
  return options;
}

std::vector<GoldenMethod> golden_methods(const std::string& case_name) {
  const nlohmann::json& data = golden_case(case_name);
  std::vector<GoldenMethod> list;
  for (const auto& [golden_name, results] : data.at("methods").items()) {
    GoldenMethod method{.golden_name = golden_name, .method = {}, .step_sizes = {}, .results = results};
    std::string name = golden_name.substr(0, golden_name.find('_'));
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    method.method = golden_name == "SEILM_dir" ? "seidm" : name;
    method.literal = golden_name.ends_with("_literal");
    method.step_sizes = data.at("hs").get<std::vector<double>>();
    method.C = data.at("C").get<double>();
    list.push_back(std::move(method));
  }
  return list;
}

}  // namespace seiche::test
