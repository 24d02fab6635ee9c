#include <seiche/core/base/error.hpp>
#include <seiche/core/simd/thread_count.hpp>
#include <seiche/ensemble/ensemble.hpp>
#include <seiche/ensemble/panel_block.hpp>
#include <seiche/ensemble/parallel_for.hpp>
#include <seiche/loop/energy_book.hpp>
#include <seiche/loop/settle_report.hpp>
#include <seiche/loop/time_grid.hpp>

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
  bool is_full;  // no further record fits beside them
  std::vector<double> H, modified;

  Records(Index count, std::vector<std::int64_t> at, bool full = false)
      : members(count),
        steps(std::move(at)),
        is_full(full),
        H(steps.size() * static_cast<std::size_t>(count), not_running),
        modified(H) {}
  std::size_t place(std::size_t record, Index member) const {
    return record * static_cast<std::size_t>(members) + static_cast<std::size_t>(member);
  }
};

class Run {
 public:
  Run(std::span<const EnsembleMember> members, const EnsembleOptions& options)
      : members_(members), options_(options), grid_(options.t_start, options.h, options.t_end) {}

  EnsembleResult run() {
    require_thread_count(options_.threads);
    if (const std::string& name = options_.simulation.backend;
        options_.threads > 1 && name != "auto" && find_backend(name).takes_one_thread)
      throw Error(
          "the backend {} is for one thread of a program, and {} are to run members side by side: write --threads 1, or "
          "backend = \"sparse\"",
          name, options_.threads);
    require_one_size();
    make_blocks();
    if (options_.resumption.from != nullptr) archive(*options_.resumption.from);
    EnsembleResult result;
    try {
      advance_all();
    } catch (const Error& error) {
      if (!is_handing_over_) throw;
      result.failure = error.what();
    }
    result.members.resize(members_.size());
    result.side_by_side = dynamic_cast<const PanelBlock*>(blocks_.front().get()) != nullptr;
    for (Index m = 0; m < count(); ++m) result.members[static_cast<std::size_t>(m)] = member_result(m);
    result.wall_seconds = seconds();
    return result;
  }

 private:
  Index count() const { return static_cast<Index>(members_.size()); }
  Index block_count() const { return (count() + panel_members - 1) / panel_members; }
  MemberBlock& block_of(Index member) { return *blocks_[static_cast<std::size_t>(member / panel_members)]; }
  const MemberStatus& status(Index member) { return block_of(member).status(member % panel_members); }
  double seconds() const {
    return seconds_earlier_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  bool stopped() const { return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed); }

  void require_one_size() const {
    if (members_.empty()) throw Error("an ensemble has at least one member");
    const Index size = members_.front().problem->size();
    for (std::size_t m = 0; m < members_.size(); ++m) {
      if (members_[m].problem->size() != size)
        throw Error("member {} has {} unknowns and member 1 has {}; all members of an ensemble have the same number",
                    m + 1, members_[m].problem->size(), size);
      if (members_[m].initial.size() != size)
        throw Error("the initial state of member {} has {} values, and its problem has {} unknowns", m + 1,
                    members_[m].initial.size(), size);
    }
  }

  void make_blocks() {
    blocks_.resize(static_cast<std::size_t>(block_count()));
    books_.assign(members_.size(), EnergyBook({}, false));
    parallel_for(block_count(), options_.threads, [&](Index b) {
      if (stopped()) throw Error("stopped before the members were set up");
      const auto begin = static_cast<std::size_t>(b * panel_members);
      const std::size_t size = std::min(members_.size() - begin, static_cast<std::size_t>(panel_members));
      blocks_[static_cast<std::size_t>(b)] = make_block(members_.subspan(begin, size), options_.simulation);
      blocks_[static_cast<std::size_t>(b)]->set_time(options_.t_start);
      blocks_[static_cast<std::size_t>(b)]->set_streams(begin);
      for (std::size_t m = begin; m < begin + size; ++m) open_book(static_cast<Index>(m));
    });
    if (!any_runs()) throw Error(status(0).message);
  }

  void open_book(Index member) {
    const Simulation* simulation = block_of(member).simulation(member % panel_members);
    if (simulation == nullptr) return;
    LawPromise law{false, "no law was asked for"};
    if (options_.promise) law = options_.promise(*simulation);
    books_[static_cast<std::size_t>(member)] = EnergyBook(law, has_modified_energy(options_.simulation));
  }

  bool any_runs() {
    for (Index m = 0; m < count(); ++m)
      if (status(m).running) return true;
    return false;
  }

  // In batches: between two of them all members have done the same number of steps.
  void advance_all() {
    while (recorded_ < grid_.steps && any_runs()) {
      if (pauses()) {
        if (n_ > recorded_) record_at(n_);
        return;
      }
      const auto begin = std::chrono::steady_clock::now();
      Records records = next_records(recorded_, n_);
      const std::int64_t end = records.is_full ? records.steps.back() : std::min(n_ + batch_steps_, grid_.steps);
      advance_all(n_, end, records);
      n_ = end;
      if (!records.steps.empty()) recorded_ = records.steps.back();
      publish(records);
      set_batch_steps(std::chrono::steady_clock::now() - begin);
      if (options_.on_pause) options_.on_pause();
    }
  }

  // True if the run is to stop between two batches; it is saved before that, and whenever that is wanted.
  bool pauses() {
    Checkpoints* const keeper = options_.resumption.checkpoints;
    if (keeper == nullptr) return stopped();
    const Checkpoints::Wish wish = stopped() ? Checkpoints::Wish::save_and_stop : keeper->wish(n_);
    if (wish != Checkpoints::Wish::none)
      hand_over([&] { keeper->save(n_, grid_.time(n_), [this](Archive& a) { archive(a); }); });
    return wish == Checkpoints::Wish::save_and_stop;
  }

  void archive(Archive& a) {
    a.section("ensemble");
    Index members = count();
    double seconds_so_far = seconds();
    a(members, n_, recorded_, seconds_so_far);
    a.require(members == count() && recorded_ >= -1 && n_ >= recorded_ && n_ <= grid_.steps);
    for (const std::unique_ptr<MemberBlock>& block : blocks_) block->archive(a);
    for (EnergyBook& book : books_) a(book);
    if (!a.reads()) return;
    seconds_earlier_ = seconds_so_far;
    begin_ = std::chrono::steady_clock::now();
  }

  void advance_all(std::int64_t n, std::int64_t end, Records& records) {
    parallel_for(block_count(), options_.threads, [&](Index block) { advance(block, n, end, records); });
  }

  void record_at(std::int64_t n) {
    Records records(count(), {n});
    advance_all(n, n, records);
    publish(records);
  }

  // Short enough that a run ends soon after `stop`, long enough that threads start seldom; results do not depend on it.
  void set_batch_steps(std::chrono::duration<double> took) {
    constexpr double seconds = 0.1;
    if (took.count() < seconds / 2) batch_steps_ = std::min(2 * batch_steps_, std::max<std::int64_t>(1, grid_.steps));
    if (took.count() > 2 * seconds) batch_steps_ = std::max<std::int64_t>(1, batch_steps_ / 2);
  }

  // The steps of the next batch at which energies are recorded, after step `last` (−1: from the start); the batch
  // begins at n.
  Records next_records(std::int64_t last, std::int64_t n) const {
    constexpr Index most_values = 1 << 16;  // in memory at once
    const auto most = static_cast<std::size_t>(std::max<Index>(1, most_values / count()));
    std::vector<std::int64_t> steps;
    for (;;) {
      const std::int64_t before = steps.empty() ? last : steps.back();
      const std::int64_t next =
          before < 0 ? 0 : std::min(before - before % options_.energy_every + options_.energy_every, grid_.steps);
      if (next == before || next > n + batch_steps_) return {count(), std::move(steps)};
      steps.push_back(next);
      if (steps.size() == most) return {count(), std::move(steps), true};
    }
  }

  void advance(Index b, std::int64_t n, std::int64_t end, Records& records) {
    MemberBlock& block = *blocks_[static_cast<std::size_t>(b)];
    const auto step_to = [&](std::int64_t last) {
      for (; n < last; ++n) block.step(n + 1, grid_.time(n), grid_.step_size(n + 1), grid_.time(n + 1));
    };
    for (std::size_t record = 0; record < records.steps.size(); ++record) {
      step_to(records.steps[record]);
      read(b, n, record, records);
    }
    step_to(end);
  }

  void read(Index b, std::int64_t n, std::size_t record, Records& records) {
    MemberBlock& block = *blocks_[static_cast<std::size_t>(b)];
    std::array<EnergyReading, panel_members> readings;
    block.read(readings);
    for (Index l = 0; l < block.size(); ++l) {
      if (!block.status(l).running) continue;
      const EnergyReading& reading = readings[static_cast<std::size_t>(l)];
      const Index member = b * panel_members + l;
      books_[static_cast<std::size_t>(member)].add(reading, grid_.time(n), n);
      records.H[records.place(record, member)] = reading.H;
      records.modified[records.place(record, member)] = reading.modified;
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
    hand_over([&] {
      for (const EnsembleRecord& row : rows)
        if (row.running > 0) options_.on_record(row);
    });
  }

  // An Error of those who get rows and checkpoints ends the run, whose members are what they were.
  template <class Action>
  void hand_over(const Action& action) {
    is_handing_over_ = true;
    action();
    is_handing_over_ = false;
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
    report.steps = block_of(member).steps(member % panel_members);
    report.t = block_of(member).time(member % panel_members);
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
      report.message = seiche::stopped(report.t, report.steps, grid_.end);
    } else {
      report.message = seiche::reached(report.t, report.steps);
    }
    report.judge_replaced();
    const Simulation* simulation = block_of(member).simulation(member % panel_members);
    result.final = block_of(member).physical(member % panel_members);
    if (simulation != nullptr) {
      settle_report(
          report, simulation->system(), [&] { return result.final; },
          [&] { return at.fed.empty() && options_.objection ? options_.objection(simulation->problem()) : at.fed; });
    }
    report.say(report.remark_on_drift());
    if (result.final.size() == 0) {
      report.law = LawVerdict::not_promised;
      report.law_reason = "the member never started";
    }
    return result;
  }

  std::span<const EnsembleMember> members_;
  const EnsembleOptions& options_;
  TimeGrid grid_;
  std::vector<std::unique_ptr<MemberBlock>> blocks_;
  std::vector<EnergyBook> books_;       // one for every member
  std::int64_t n_ = 0, recorded_ = -1;  // steps that all have done; the last one with a record
  std::int64_t batch_steps_ = 1;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double seconds_earlier_ = 0.0;  // of the run that this one goes on from
  bool is_handing_over_ = false;
};

}  // namespace

EnsembleResult run_ensemble(std::span<const EnsembleMember> members, const EnsembleOptions& options) {
  if (options.energy_every < 1) throw Error("energy_every = {} must be ≥ 1", options.energy_every);
  return Run(members, options).run();
}

}  // namespace seiche
