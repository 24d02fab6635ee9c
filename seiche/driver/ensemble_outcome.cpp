#include <seiche/driver/ensemble_outcome.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace seiche {
namespace {

template <class Is>
std::int64_t count(const EnsembleResult& result, const Is& is) {
  return std::count_if(result.members.begin(), result.members.end(),
                       [&](const MemberResult& member) { return is(member.report); });
}

auto has_status(RunReport::Status status) {
  return [status](const RunReport& r) { return r.status == status; };
}
auto has_law(LawVerdict law) {
  return [law](const RunReport& r) { return r.law == law; };
}

// Of members that failed their message says these.
bool holds_replaced(const RunReport& r) { return r.replaced.count > 0 && r.status != RunReport::Status::failed; }
bool has_drifted(const RunReport& r) { return r.drift && r.status != RunReport::Status::failed; }
bool holds_law(const RunReport& r) { return r.law == LawVerdict::holds && r.status != RunReport::Status::failed; }

// "3 failed, the first of them member 2: …"
template <class Is, class Reason>
std::string first_of(const EnsembleResult& result, std::int64_t how_many, const char* what, const Is& is,
                     const Reason& reason) {
  if (how_many == 0) return "";
  const auto first = std::find_if(result.members.begin(), result.members.end(),
                                  [&](const MemberResult& member) { return is(member.report); });
  return fmt::format("{} {}, the first of them member {}: {}", how_many, what, first - result.members.begin() + 1,
                     std::invoke(reason, first->report));
}

}  // namespace

EnsembleOutcome::EnsembleOutcome(const EnsembleResult& result)
    : succeeded(count(result, has_status(RunReport::Status::success))),
      failed(count(result, has_status(RunReport::Status::failed))),
      interrupted(count(result, has_status(RunReport::Status::interrupted))),
      replaced(count(result, holds_replaced)),
      drifted(count(result, has_drifted)),
      holds(count(result, holds_law)),
      violated(count(result, has_law(LawVerdict::violated))),
      not_promised(count(result, has_law(LawVerdict::not_promised))),
      message(fmt::format("{} of {} members reached the end", succeeded, result.members.size())) {
  add_to(message, first_of(result, failed, "failed", has_status(RunReport::Status::failed), &RunReport::message));
  add_to(message, first_of(result, replaced, "hold replaced steps", holds_replaced, &RunReport::remark_on_replaced));
  add_to(message,
         first_of(result, drifted, "have an energy that no solution has", has_drifted, &RunReport::remark_on_drift));
  if (interrupted > 0) add_to(message, fmt::format("{} were interrupted", interrupted));
  add_to(message, first_of(result, violated, "violated the promised energy law", has_law(LawVerdict::violated),
                           &RunReport::law_reason));
  add_to(message, first_of(result, not_promised, "promise no energy law", has_law(LawVerdict::not_promised),
                           &RunReport::law_reason));
  if (!result.failure.empty()) fail_to_write(result.failure);
}

void EnsembleOutcome::fail_to_write(const std::string& reason) {
  add_to(message, reason);
  is_written = false;
}

RunReport::Status EnsembleOutcome::status() const {
  if (failed > 0 || !is_written) return RunReport::Status::failed;
  return interrupted > 0 ? RunReport::Status::interrupted : RunReport::Status::success;
}

bool EnsembleOutcome::is_remarkable() const {
  return failed > 0 || !is_written || violated > 0 || replaced > 0 || drifted > 0;
}

std::string EnsembleOutcome::law() const {
  if (violated > 0) return to_string(LawVerdict::violated);
  if (not_promised > 0) return to_string(LawVerdict::not_promised);
  return holds > 0 ? to_string(LawVerdict::holds) : "";
}

}  // namespace seiche
