// What is said of a run that has ended: steps without a solution, laws that were excused or broken, energies that
// parted.
#include <seiche/core/base/vector.hpp>
#include <seiche/loop/energy_book.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

namespace seiche {
namespace TEST_FILE {

using testing::HasSubstr;
using Status = RunReport::Status;

TEST(RunReport, StepsWithoutASolutionAreSaidAlwaysAndFailARunWhereTheyAreMany) {
  RunReport report;
  report.steps = 10'000;
  report.replaced = {.why = "the result of the scheme is not finite", .remedy = "a smaller h"};
  for (const auto& [replaced, is_said, fails] :
       {std::tuple(0, false, false), {1, true, false}, {5, true, false}, {50, true, false}, {2000, true, true}}) {
    report.replaced.count = replaced;
    report.message = "reached t = 1";
    report.status = Status::success;
    report.judge_replaced();
    EXPECT_EQ(report.message != "reached t = 1", is_said) << replaced;
    EXPECT_EQ(report.status == Status::failed, fails) << replaced;
    if (is_said) {
      EXPECT_THAT(report.message,
                  testing::AllOf(HasSubstr(fmt::format("{} of 10000 steps ", replaced)),
                                 HasSubstr("the result of the scheme is not finite"), HasSubstr("a smaller h")));
    }
  }
}

TEST(RunReport, OneStepThatLostMostOfTheStateFailsARun) {
  RunReport report;
  report.steps = 1'000'000;
  report.replaced = {.count = 1, .lost_state = true, .why = "sweeps did not converge", .remedy = "a smaller h"};
  report.judge_replaced();
  EXPECT_EQ(report.status, Status::failed);
  EXPECT_THAT(report.message, HasSubstr("has lost most of the state"));
}

TEST(RunReport, BriefIsOneLineAndFullHoldsTheMessage) {
  RunReport report;
  report.message = "reached t = 1";
  EXPECT_EQ(report.brief().find('\n'), std::string::npos);
  EXPECT_THAT(report.full(), HasSubstr("reached t = 1"));
  EXPECT_EQ(to_string(LawVerdict::not_promised), "not promised");
}

// H of a run whose terms have the size `terms`; a modified energy follows it down, and falls all the while.
RunReport booked(const LawPromise& promise, const std::vector<double>& H, bool has_modified, double terms = 1,
                 std::int64_t event_before = -1) {
  EnergyBook book(promise, has_modified);
  double lowest = H.front();
  for (std::size_t n = 0; n < H.size(); ++n) {
    const bool is_behind_event = static_cast<std::int64_t>(n) == event_before;
    if (is_behind_event) book.reopen();
    lowest = is_behind_event ? H[n] : std::min(lowest, H[n]);
    book.add({.H = H[n],
              .modified = lowest - 1e-9 * static_cast<double>(n),
              .round_off = 50 * epsilon * std::max(terms, std::abs(H[n])),
              .modified_round_off = 50 * epsilon,
              .size = std::max(terms, std::abs(H[n])) / 2},
             static_cast<double>(n), static_cast<std::int64_t>(n));
  }
  RunReport report;
  book.write_to(report);
  return report;
}

TEST(EnergyBook, DoesNotExcuseARiseByTheRoundOffThatCameWithIt) {
  const auto law_of = [](std::initializer_list<std::pair<double, double>> H_and_terms) {
    EnergyBook book({true, "damped", true, false}, false);
    int n = 0;
    for (const auto& [H, terms] : H_and_terms) {
      book.add({.H = H, .modified = H, .round_off = 50 * epsilon * terms, .modified_round_off = 50 * epsilon * terms},
               n, n);
      ++n;
    }
    RunReport report;
    book.write_to(report);
    return report.law;
  };
  EXPECT_EQ(law_of({{1, 1}, {1, 1}, {1e90, 1e120}}), LawVerdict::violated);
  EXPECT_EQ(law_of({{1, 1}, {1e90, 1e120}}), LawVerdict::violated) << "in the first step";
  EXPECT_EQ(law_of({{1, 1}, {1, 1e5}, {1 + 1e-10, 1e5}}), LawVerdict::holds);
  EXPECT_EQ(law_of({{0, 1e-16}, {1e-17, 1}, {2e-17, 1}}), LawVerdict::holds) << "from next to rest";
  EXPECT_EQ(law_of({{1e-16, 1e-16}, {1e-16, 1e-10}, {1e-16, 1e-5}, {3e-16, 1}}), LawVerdict::not_promised)
      << "the solution has grown";
  EXPECT_EQ(law_of({{1, 1}}), LawVerdict::not_tested);
}

// C may rise in one step beyond what any solution does, and H̃ is then a small difference of large numbers.
TEST(EnergyBook, SaysThatAModifiedEnergyHasLostItsDigitsToTheShift) {
  const auto booked_behind = [](double before, double terms, double modified, double shift) {
    EnergyBook book({true, "damped", true, false}, true);
    const auto add = [&](double energy, double size, int n) {
      book.add({.H = 1, .modified = energy, .round_off = 1e-14, .modified_round_off = 50 * epsilon * size}, n, n);
    };
    add(1, 2, 0);
    add(before, terms, 1);
    add(modified, shift, 2);
    RunReport report;
    book.write_to(report);
    return report;
  };
  const RunReport lost = booked_behind(1, 2, 1e5, 1e20), risen = booked_behind(1, 2, 1e9, 1e20);
  const RunReport small = booked_behind(1e-9, 1e-9, 1e-9 + 1e-16, 1e-2);
  EXPECT_EQ(small.law, LawVerdict::violated);
  EXPECT_THAT(small.law_reason, HasSubstr("round-off explains only")) << "less than there was at the start";
  EXPECT_EQ(lost.law, LawVerdict::violated);
  EXPECT_THAT(lost.law_reason, HasSubstr("can no longer be told from round-off: at t = 2"));
  EXPECT_EQ(risen.law, LawVerdict::violated);
  EXPECT_THAT(risen.law_reason, HasSubstr("round-off explains only"));
}

// H may fall, but not away from the energy that the law is about.
TEST(EnergyBook, SaysThatHAndItsModifiedEnergyHaveParted) {
  EnergyBook book({true, "damped", true, false}, true);
  int n = 0;
  for (const auto& [H, modified] : {std::pair(100.0, 100.0), {95.0, 99.9}, {5.0, 99.8}, {50.0, 99.7}}) {
    book.add({.H = H, .modified = modified, .round_off = 5e-13, .modified_round_off = 5e-13}, n, n);
    ++n;
  }
  RunReport report;
  book.write_to(report);
  EXPECT_THAT(report.remark_on_drift(), HasSubstr("at t = 2 that is 99.8 where H is 5: the two have parted"));
  EXPECT_EQ(report.drift->text(), "H is 5 where its modified energy is 99.8, at t = 2");
}

TEST(EnergyBook, SaysWhereHRoseThoughNoSolutionLetsItRise) {
  const LawPromise damped{true, "damped", true, false}, kept{true, "kept", true, true}, driven{false, "driven"};
  const RunReport risen = booked(damped, {1, 3, 300, 0.9}, true);
  EXPECT_EQ(risen.law, LawVerdict::holds);
  EXPECT_THAT(risen.remark_on_drift(),
              testing::StartsWith(
                  "the law holds for the modified energy, and H itself rose from 1 to 300 at t = 2, although no "
                  "solution of the equation lets it rise: the two have parted"));
  EXPECT_EQ(risen.remarks().size(), 1U);
  EXPECT_EQ(booked(damped, {1, 0.5, 0.1}, true).remark_on_drift(), "") << "damping takes it";
  EXPECT_EQ(booked(driven, {1, 3, 300}, true).remark_on_drift(), "");
  EXPECT_EQ(booked(driven, {1, 3, 300}, false).remarks().size(), 0U);
  EXPECT_EQ(booked(damped, {1, 1.05, 0.9}, true).remark_on_drift(), "") << "a little";
  EXPECT_EQ(booked(damped, {0, 0.01, 0.04}, true).remark_on_drift(), "") << "a little of its terms";
  EXPECT_EQ(booked(damped, {1, 0.9, 40, 39}, true, 1, 2).remark_on_drift(), "") << "by an event";
  EXPECT_THAT(booked(kept, {1, 0.95, 0.8}, true).remark_on_drift(),
              HasSubstr("H itself fell from 1 to 0.8 at t = 2, although nothing in the equation changes it"));
  EXPECT_EQ(booked(kept, {1, 0.96, 1.05}, true).remark_on_drift(), "");
  LawPromise withdrawn = kept;
  withdrawn.withdraw("law = \"none\"");
  EXPECT_THAT(booked(withdrawn, {1, 1, 2}, false).remark_on_drift(),
              testing::StartsWith("H itself rose from 1 to 2 at t = 2, although nothing"));
  EXPECT_EQ(booked(damped, {1, 2, 3}, false).remarks().size(), 0U) << "the law that is violated says it";
}

// A per cent in 10⁷ steps is no drift that calls for a change, and yet it should be known.
TEST(RunReport, TellsHowFarTheAuxiliaryHasTakenHFromItsModifiedEnergy) {
  RunReport report;
  report.has_modified_energy = true;
  report.energy = {.initial = 2.0, .final = 0.984};
  report.modified = {.initial = 2.0, .final = 1.0};
  EXPECT_EQ(report.remark_on_parting(),
            "at the end H is 0.016 below the modified energy that the law is about, 0.8 % of where H began");
  report.energy.final = 0.9995;
  EXPECT_EQ(report.remark_on_parting(), "");
  report.has_modified_energy = false;
  report.energy.final = 0.9;
  EXPECT_EQ(report.remark_on_parting(), "");
}

TEST(RunReport, OneReplacedStepIsSaidInWords) {
  RunReport report;
  report.steps = 12'801;
  report.replaced = {.count = 1, .why = "sweeps did not converge", .remedy = "a smaller h"};
  EXPECT_THAT(report.remark_on_replaced(),
              testing::StartsWith("1 of 12801 steps was replaced, because sweeps did not"));
  report.replaced.count = 2;
  EXPECT_THAT(report.remark_on_replaced(), testing::StartsWith("2 of 12801 steps were replaced, because "));
  report.steps = 0;
  EXPECT_THAT(report.remark_on_replaced(), testing::StartsWith("in 2 steps no solution was found, because "))
      << "taken back";
}

}  // namespace TEST_FILE
}  // namespace seiche
