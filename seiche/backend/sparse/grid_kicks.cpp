#include <seiche/backend/fft/fftw_plan.hpp>
#include <seiche/backend/sparse/equal_rows.hpp>
#include <seiche/backend/sparse/grid_kicks.hpp>
#include <seiche/core/simd/lanes.hpp>

#include <algorithm>
#include <array>

namespace seiche {
namespace {

constexpr Index block_length = 512;  // points whose slopes, where V is local, stay in the first cache until their kick

// A ring takes two more copies of the state: nothing beside the ends of a short line, which are rows one by one.
constexpr Index longest_ring = 64;

class GridKicks final : public Kicks {
 public:
  GridKicks(EqualRows K, std::shared_ptr<const PointwisePotential> V, const Potential& potential)
      : K_(std::move(K)),
        V_(std::move(V)),
        potential_(potential),
        slope_length_(!V_              ? 0
                      : V_->is_local() ? std::min(n(), block_length)
                                       : n()),
        ring_(n() <= longest_ring ? K_.ring() : nullptr),
        ghosts_(ring_ ? reach_of(*ring_) : 0),
        memory_(fftw_buffer(static_cast<std::size_t>(whole_lanes(slope_length_) + 3 * part_length()))) {
    if (ring_) {
      whole_ = {0, n(), ring_};
      blocks_.push_back({0, n(), {&whole_, 1}});
      return;
    }
    K_.cut_runs(block_length);
    const std::span<const EqualRows::Run> runs = K_.runs();
    std::size_t next = 0;
    for (Index begin = 0; begin < n(); begin += block_length) {
      const std::size_t first = next;
      while (next < runs.size() && runs[next].begin < begin + block_length) ++next;
      blocks_.push_back({begin, std::min(n(), begin + block_length), runs.subspan(first, next - first)});
    }
  }

  Report split(std::span<const KickAndDrift> stages, double last_kick, const Vector& z, Vector& out) const override {
    double* const p = part(0);
    std::array<double*, 2> others = {part(1), part(2)};
    const double* q = z.data();
    if (ring_) {
      std::copy_n(q, n(), others[1]);
      q = closed(others[1]);
    }
    const double* p_before = z.data() + n();
    Report report;
    for (std::size_t i = 0; i < stages.size(); ++i) {
      double* const q_after = ring_ || i + 1 < stages.size() ? others[i % 2] : out.data();
      const double squares = for_blocks(q, [&](const Block& block, const double* g, Index g_begin) {
        return kick_and_drift(block.runs, stages[i], {q, g, p_before, g_begin}, q_after, p);
      });
      report.taken += squares * (1 - square(stages[i].decay)) / 2;
      if (i == 0) report.kicked = squares;
      q = ring_ ? closed(q_after) : q_after;
      p_before = p;
    }
    for_blocks(q, [&](const Block& block, const double* g, Index g_begin) {
      subtract_rows(block.runs, last_kick, {q, g, p_before, g_begin}, out.data() + n());
      return 0.0;
    });
    if (ring_) std::copy_n(q, n(), out.data());
    return report;
  }

 private:
  struct Block {  // points begin … end − 1, and the runs of K in them
    Index begin, end;
    std::span<const EqualRows::Run> runs;
  };

  Index n() const { return K_.size(); }

  // Slopes of V, and three arrays of a number per point, with room for the copies of a ring at both ends.
  double* slope() const { return memory_.get(); }
  Index part_length() const { return whole_lanes(n()) + 2 * whole_lanes(ghosts_); }
  double* part(Index i) const {
    return slope() + whole_lanes(slope_length_) + i * part_length() + whole_lanes(ghosts_);
  }

  static Index reach_of(const EqualRows::Kind& row) {
    return row.offsets.empty() ? 0 : std::max({Index{0}, -row.offsets.front(), row.offsets.back()});
  }

  // With copies of both ends beyond the other one, where the row of the ring then finds its neighbours.
  const double* closed(double* q) const {
    for (Index i = 0; i < ghosts_; ++i) {
      q[n() + i] = q[i];
      q[-1 - i] = q[n() - 1 - i];
    }
    return q;
  }

  // Σ visit(block, slopes of V at q, the point that the first of them belongs to).
  template <class Visit>
  double for_blocks(const double* q, const Visit& visit) const {
    const auto slopes_at = [&](Index begin, Index end) {
      const auto length = static_cast<std::size_t>(end - begin);
      V_->gradient({q + begin, length}, {slope(), length});
    };
    if (V_) potential_.count_gradient();
    const bool is_local = V_ && V_->is_local();
    if (V_ && !is_local) slopes_at(0, n());
    double sum = 0;
    for (const Block& block : blocks_) {
      if (is_local) slopes_at(block.begin, block.end);
      sum += visit(block, V_ ? slope() : nullptr, is_local ? block.begin : 0);
    }
    return sum;
  }

  EqualRows K_;
  std::shared_ptr<const PointwisePotential> V_;
  const Potential& potential_;
  Index slope_length_;
  const EqualRows::Kind* ring_;  // the row of a short ring; null: rows differ
  Index ghosts_;                 // points copied beyond each end of the ring
  EqualRows::Run whole_ = {};
  std::vector<Block> blocks_;
  FftwBuffer memory_;  // every part begins a line of the cache
};

}  // namespace

std::unique_ptr<Kicks> grid_kicks(const SparseMatrix& K, std::shared_ptr<const PointwisePotential> V,
                                  const Potential& potential) {
  std::optional<EqualRows> rows = EqualRows::of(K, EqualRows::Limit::none);
  return std::make_unique<GridKicks>(std::move(*rows), std::move(V), potential);
}

}  // namespace seiche
