#include <bench/work_precision/options.hpp>
#include <bench/work_precision/seiche_peers.hpp>
#include <bench/work_precision/test_problems.hpp>
#include <seiche/core/base/error.hpp>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>

namespace seiche::bench {
namespace {

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    parts.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

double positive(const std::string& option, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value > 0)) throw Error("{} {}: a positive number is needed", option, text);
  return value;
}

}  // namespace

const char* const usage =
    "seiche_work_precision: error against CPU time, Seiche's methods beside other integrators\n"
    "  --out DIR         where work_precision.csv, index.html and figures/ go (out/work_precision)\n"
    "  --problem LIST    of kg20,kg4096,kgs,kg2d,fpu,gkdv,ac2d,ch2d (all)\n"
    "  --method LIST     of Seiche's methods (all that apply), as egc6, \"crkn6 explicit\", \"auto by tolerance\"\n"
    "  --peer LIST       of the other integrators (all), as \"CVODE BDF\"\n"
    "  --no-peers        Seiche's methods alone\n"
    "  --quick           every second step size, short runs only: for trying\n"
    "  --repeats N       timed runs of which the median is taken (5)\n"
    "  --cap SECONDS     runs expected to take longer are skipped, and the table says so (1; quick 0.05)\n"
    "  --budget SECONDS  per problem, shared equally among its integrators (100; quick 6)\n";

Options Options::parse(const std::vector<std::string>& arguments) {
  Options options;
  options.quick = std::find(arguments.begin(), arguments.end(), "--quick") != arguments.end();
  if (options.quick) {
    options.repeats = 3;
    options.cap_seconds = 0.05;
    options.problem_seconds = 6;
  }
  std::string option;
  const std::map<std::string, std::function<void(const std::string&)>> with_value = {
      {"--out", [&](const std::string& text) { options.out = text; }},
      {"--problem", [&](const std::string& text) { options.problems = split(text); }},
      {"--method", [&](const std::string& text) { options.methods = split(text); }},
      {"--peer", [&](const std::string& text) { options.peer_names = split(text); }},
      {"--repeats",
       [&](const std::string& text) { options.repeats = std::max(1, static_cast<int>(positive(option, text))); }},
      {"--cap", [&](const std::string& text) { options.cap_seconds = positive(option, text); }},
      {"--budget", [&](const std::string& text) { options.problem_seconds = positive(option, text); }},
  };
  std::vector<std::string> names = {"--quick", "--no-peers", "--help"};
  for (const auto& [name, set] : with_value) names.push_back(name);
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    option = arguments[i];
    if (option == "--quick") continue;
    if (option == "--no-peers") {
      options.peers = false;
      continue;
    }
    if (option == "--help") {
      options.help = true;
      continue;
    }
    const auto found = with_value.find(option);
    if (found == with_value.end()) throw unknown_name("option", option, names);
    if (++i == arguments.size()) throw Error("{} needs a value", option);
    found->second(arguments[i]);
  }
  const std::vector<std::string> keys = test_problem_keys();
  for (const std::string& key : options.problems) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) throw unknown_name("problem", key, keys);
  }
  const std::vector<std::string> of_seiche = seiche_peer_names();
  for (const std::string& method : options.methods) {
    if (std::find(of_seiche.begin(), of_seiche.end(), method) == of_seiche.end())
      throw unknown_name("method", method, of_seiche);
  }
  if (options.problems.empty()) options.problems = keys;
  return options;
}

}  // namespace seiche::bench
