#include <seiche/config/data/initial_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/commuting_damping.hpp>
#include <seiche/core/text/input_file.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

namespace seiche {
namespace {

// Not by a stream, whose numbers depend on the locale and end silently at the first bad one.
double read_token(const std::string& token, const std::filesystem::path& file, std::size_t line) {
  const char* begin = token.data() + (token.starts_with('+') ? 1 : 0);
  const char* end = token.data() + token.size();
  double value = 0.0;
  const auto [rest, status] = std::from_chars(begin, end, value);
  if (!token.starts_with("+-") && status == std::errc() && rest == end && std::isfinite(value)) return value;
  throw Error("{}:{}: '{}' is not a finite number", shortened_path(file.string()), line, shortened(token));
}

bool depends_on_time(const Problem& problem) {
  const auto changes = [](const FieldRatePointer& force) { return force && !force->is_constant(); };
  return !has_constant_rates(problem.damping) || std::any_of(problem.forces.begin(), problem.forces.end(), changes);
}

}  // namespace

Vector read_initial_file(const std::filesystem::path& file, const Problem& problem) {
  const std::string name = shortened_path(file.string());
  if (const std::string complaint = complaint_about_file(file); !complaint.empty())
    throw Error("{} {}{}", name, complaint, complaint == "is not a file" ? " of numbers" : "");
  std::ifstream input(file);
  if (!input) throw Error("{} cannot be read", name);
  const FieldPart field = problem.grid.field();
  const Index all = problem.field_count() * field.of;
  Vector z(problem.size());
  const auto put = [&](Index i, double value) {
    const Index at = i % field.of - field.first;
    if (i < all && at >= 0 && at < field.size) z[i / field.of * field.size + at] = value;
  };
  Index count = 0;
  std::string text;
  for (std::size_t line = 1; std::getline(input, text); ++line) {
    std::istringstream words(text);
    for (std::string token; words >> token; ++count) {
      const double value = read_token(token, file, line);
      put(count, value);
    }
  }
  if (input.bad()) throw Error("{} cannot be read to its end", name);
  if (count != all)
    throw Error("{} holds {} number{} but the state has {} ({})", name, count, count == 1 ? "" : "s", all,
                field.of == 1 ? fmt::format("{}", fmt::join(problem.fields, ", "))
                              : fmt::format("{} field{} × {} unknowns", problem.field_count(),
                                            problem.field_count() == 1 ? "" : "s", field.of));
  return z;
}

std::string lost_between_runs(Simulation& simulation, double t_start, double written_at) {
  const std::string auxiliaries =
      simulation.stepper().has_modified_energy()
          ? fmt::format("the auxiliary variables of {} begin anew", simulation.method().name)
          : "";
  std::string time;
  if (written_at != t_start && depends_on_time(simulation.problem())) {
    time = fmt::format("damping and forces are those from t = {:.9g} on", t_start);
    if (!std::isnan(written_at))
      time += fmt::format(", not from [time] start = {}, where the file was written", written_at);
  }
  if (auxiliaries.empty() && time.empty()) return "";
  const std::string both = auxiliaries.empty() || time.empty() ? "" : ", and ";
  return fmt::format("a file holds z alone: {}{}{}; a run that this is to continue would go on a little differently",
                     auxiliaries, both, time);
}

}  // namespace seiche
