#include <seiche/core/error.hpp>
#include <seiche/ensemble/ensemble.hpp>
#include <seiche/ensemble/lane_block.hpp>
#include <seiche/ensemble/parallel_for.hpp>
#include <seiche/run/energy_book.hpp>
#include <seiche/run/time_grid.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace seiche {
namespace {

constexpr double not_running = std::numeric_limits<double>::quiet_NaN();

// The records of some members, one row for each record.
struct Records {
  Index members = 0;
  std::vector<std::int64_t> steps;
  std::vector<double> H, modified;

  Records(Index count, std::vector<std::int64_t> at)
      : members(count),
        steps(std::move(at)),
        H(steps.size() * static_cast<std::size_t>(count), not_running),
        modified(H) {}
  std::size_t place(std::size_t record, Index member) const {
    return record * static_cast<std::size_t>(members) + static_cast<std::size_t>(member);
  }
};

class Run {
 public:
  Run(std::span<const EnsembleMember> members, const EnsembleOptions& options)
      : members_(members), options_(options), grid_(0.0, options.h, options.t_end) {}

  EnsembleResult run() {
    const auto begin = std::chrono::steady_clock::now();
    make_blocks();
    std::int64_t n = 0;
    for (std::int64_t next = -1; n < grid_.steps || next < 0;) {
      Records records(count(), next_records(next));
      parallel_for(block_count(), options_.threads, [&](Index block) { advance(block, next < 0 ? 0 : n, records); });
      n = next = records.steps.back();
      publish(records);
      if (stopped()) break;
    }
    EnsembleResult result;
    result.members.resize(members_.size());
    result.in_lanes = dynamic_cast<const LaneBlock*>(blocks_.front().get()) != nullptr;
    for (Index m = 0; m < count(); ++m) result.members[static_cast<std::size_t>(m)] = member_result(m);
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
  }

 private:
  Index count() const { return static_cast<Index>(members_.size()); }
  Index block_count() const { return (count() + lanes - 1) / lanes; }
  MemberBlock& block_of(Index member) { return *blocks_[static_cast<std::size_t>(member / lanes)]; }
  const MemberStatus& status(Index member) { return block_of(member).status(member % lanes); }
  bool stopped() const { return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed); }

  void make_blocks() {
    if (members_.empty()) throw Error("an ensemble has at least one member");
    blocks_.resize(static_cast<std::size_t>(block_count()));
    books_.assign(members_.size(), EnergyBook({}, false));
    parallel_for(block_count(), options_.threads, [&](Index b) {
      const auto begin = static_cast<std::size_t>(b * lanes);
      const std::size_t size = std::min(members_.size() - begin, static_cast<std::size_t>(lanes));
      blocks_[static_cast<std::size_t>(b)] = make_block(members_.subspan(begin, size), options_.simulation);
      for (std::size_t m = begin; m < begin + size; ++m) open_book(static_cast<Index>(m));
    });
    for (Index m = 0; m < count(); ++m)
      if (status(m).running) return;
    throw Error(status(0).message);
  }

  void open_book(Index member) {
    const Simulation* simulation = block_of(member).simulation(member % lanes);
    if (simulation == nullptr) return;
    LawPromise law{false, "no law was asked for"};
    if (options_.promise) law = options_.promise(*simulation);
    books_[static_cast<std::size_t>(member)] =
        EnergyBook(law, find_method(options_.simulation.method).law == "H_modified");
  }

  // The next few steps at which energies are recorded, after step `last` (−1: from the start).
  std::vector<std::int64_t> next_records(std::int64_t last) const {
    constexpr Index most_values = 1 << 16;  // in memory at once, and between two looks at `stop`
    const auto most = static_cast<std::size_t>(std::max<Index>(1, most_values / count()));
    std::vector<std::int64_t> steps;
    while (steps.size() < most && (steps.empty() || steps.back() < grid_.steps)) {
      const std::int64_t before = steps.empty() ? last : steps.back();
      steps.push_back(
          before < 0 ? 0 : std::min(before - before % options_.energy_every + options_.energy_every, grid_.steps));
    }
    return steps;
  }

  void advance(Index b, std::int64_t n, Records& records) {
    MemberBlock& block = *blocks_[static_cast<std::size_t>(b)];
    std::array<EnergyReading, lanes> readings;
    for (std::size_t record = 0; record < records.steps.size(); ++record) {
      for (; n < records.steps[record]; ++n)
        block.step(n + 1, grid_.time(n), grid_.step_size(n + 1), grid_.time(n + 1));
      block.read(readings);
      for (Index l = 0; l < block.size(); ++l) {
        if (!block.status(l).running) continue;
        const EnergyReading& reading = readings[static_cast<std::size_t>(l)];
        const Index member = b * lanes + l;
        books_[static_cast<std::size_t>(member)].add(reading, grid_.time(n), n);
        records.H[records.place(record, member)] = reading.H;
        records.modified[records.place(record, member)] = reading.modified;
      }
    }
  }

  void publish(const Records& records) {
    if (!options_.on_record) return;
    std::vector<EnsembleRecord> rows(records.steps.size());
    parallel_for(static_cast<Index>(rows.size()), options_.threads, [&](Index r) {
      EnsembleRecord& row = rows[static_cast<std::size_t>(r)];
      std::vector<double> H = of_running(records.H, records, static_cast<std::size_t>(r));
      std::vector<double> modified = of_running(records.modified, records, static_cast<std::size_t>(r));
      row.t = grid_.time(records.steps[static_cast<std::size_t>(r)]);
      row.running = static_cast<Index>(H.size());
      row.H = statistics(H);
      row.modified = statistics(modified);
    });
    for (const EnsembleRecord& row : rows) options_.on_record(row);
  }

  static std::vector<double> of_running(const std::vector<double>& all, const Records& records, std::size_t record) {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(records.members));
    for (Index m = 0; m < records.members; ++m) {
      const double value = all[records.place(record, m)];
      if (!std::isnan(value)) values.push_back(value);
    }
    return values;
  }

  MemberResult member_result(Index member) {
    const MemberStatus& at = status(member);
    MemberResult result;
    RunReport& report = result.report;
    report.steps = block_of(member).steps(member % lanes);
    report.t = block_of(member).time(member % lanes);
    report.scalar_iterations = at.scalar_iterations;
    report.fallbacks = at.fallbacks;
    report.unresolved = at.unresolved;
    report.replaced = at.replaced;
    books_[static_cast<std::size_t>(member)].write_to(report);
    if (!at.running) {
      report.status = RunReport::Status::failed;
      report.message = at.message;
    } else if (report.steps < grid_.steps) {
      report.status = RunReport::Status::interrupted;
      report.message = fmt::format("stopped at t = {:.9g} (step {}) of {:.9g}", report.t, report.steps, grid_.end);
    } else {
      report.message = fmt::format("reached t = {:.9g} in {}", report.t, counted_steps(report.steps));
    }
    report.judge_replaced();
    const Simulation* simulation = block_of(member).simulation(member % lanes);
    if (report.law != LawVerdict::not_promised && options_.objection && simulation != nullptr) {
      const std::string reason = at.fed.empty() ? options_.objection(simulation->problem()) : at.fed;
      if (!reason.empty()) report.law = LawVerdict::not_promised;
      if (!reason.empty()) report.law_reason = reason;
    }
    result.final = block_of(member).physical(member % lanes);
    return result;
  }

  std::span<const EnsembleMember> members_;
  const EnsembleOptions& options_;
  TimeGrid grid_;
  std::vector<std::unique_ptr<MemberBlock>> blocks_;
  std::vector<EnergyBook> books_;  // one for every member
};

}  // namespace

EnsembleResult run_ensemble(std::span<const EnsembleMember> members, const EnsembleOptions& options) {
  if (options.energy_every < 1) throw Error("energy_every = {} must be ≥ 1", options.energy_every);
  return Run(members, options).run();
}

}  // namespace seiche
