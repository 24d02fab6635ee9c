#include <seiche/backend/fft/fftw_plan.hpp>
#include <seiche/backend/fft/grid_columns.hpp>
#include <seiche/backend/fft/grid_rows.hpp>
#include <seiche/backend/fft/line_kinds.hpp>
#include <seiche/backend/fft/transform.hpp>
#include <seiche/core/simd/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace seiche {
namespace {

// Physical values as coordinates.
class IdentityTransform final : public FieldTransform {
 public:
  explicit IdentityTransform(Index n) : n_(n) {}
  Index unknowns() const override { return n_; }
  Index slots() const override { return n_; }
  bool is_identity() const override { return true; }
  void to_slots(std::span<const double> values, std::span<double> slots) const override {
    std::copy(values.begin(), values.end(), slots.begin());
  }
  void to_values(std::span<double> slots, std::span<double> values) const override {
    std::copy(slots.begin(), slots.end(), values.begin());
  }
  double through_values(std::span<const double> from, std::span<double> slots, const Pointwise& f) const override {
    if (from.data() != slots.data()) std::copy(from.begin(), from.end(), slots.begin());
    return f(slots);
  }

 private:
  Index n_;
};

// Rows along the last axis, then columns along the others: the same small transforms whatever the number of threads.
class ModalTransform final : public FieldTransform {
 public:
  ModalTransform(const Grid& grid, const TransformOptions& options)
      : n_(grid.unknowns()), threads_(options.threads), row_count_(n_ / grid.axes.back().unknowns()) {
    const Index last = grid.dimension() - 1;
    const bool pairs = grid.is_periodic();
    rows_ = pairs ? fourier_rows(grid.axis(last).intervals, row_count_, grid.dimension() == 1, options.measure_plans)
                  : real_rows(grid.axis(last), row_count_, options.measure_plans);
    slots_ = row_count_ * rows_->slots();
    Index inner = pairs ? rows_->slots() / 2 : rows_->slots();
    for (Index a = last; a >= 0; --a) {
      const GridAxis& axis = grid.axis(a);
      const auto n = static_cast<double>(axis.intervals);
      // Pairs stand for a mode and its conjugate once, along the last axis; other axes hold both.
      const bool unitary = pairs && a != last;
      slot_scale_ *= unitary ? 1 / std::sqrt(n) : seiche::slot_scale(axis);
      value_scale_ *= unitary ? 1 / std::sqrt(n) : seiche::value_scale(axis);
      if (a == last) continue;
      const Index length = axis.unknowns();
      Index outer = 1;
      for (Index b = 0; b < a; ++b) outer *= grid.axis(b).unknowns();
      const Lines lines{outer, length, inner};
      columns_.push_back(pairs ? fourier_columns(lines, options.measure_plans)
                               : real_columns(axis, lines, options.measure_plans));
      inner *= length;
    }
    batch_count_ = (row_count_ + rows_->batch() - 1) / rows_->batch();
    sums_.resize(static_cast<std::size_t>(batch_count_));
    const auto batch_size = static_cast<std::size_t>(rows_->batch() * rows_->values());
    for (int thread = 0; thread < threads_; ++thread) values_.push_back(fftw_buffer(batch_size));
  }

  Index unknowns() const override { return n_; }
  Index slots() const override { return slots_; }
  double slot_scale() const override { return slot_scale_; }
  double value_scale() const override { return value_scale_; }

  void to_slots(std::span<const double> values, std::span<double> slots) const override {
    for_blocks(batch_count_, threads_, [&](Index batch) {
      rows_->to_slots(values.data() + row(batch) * rows_->values(), slots.data() + row(batch) * rows_->slots(),
                      rows_in(batch));
    });
    columns_to_slots(slots);
  }

  void to_values(std::span<double> slots, std::span<double> values) const override {
    columns_to_values(slots);
    for_blocks(batch_count_, threads_, [&](Index batch) {
      rows_->to_values(slots.data() + row(batch) * rows_->slots(), values.data() + row(batch) * rows_->values(),
                       rows_in(batch));
    });
  }

  double through_values(std::span<const double> from, std::span<double> slots, const Pointwise& f) const override {
    if (from.data() != slots.data()) {
      // On all threads: one alone would draw into its cache what the passes over the modes have left in those of
      // others.
      for_blocks(batch_count_, threads_, [&](Index batch) {
        const Index begin = row(batch) * rows_->slots();
        std::copy_n(from.data() + begin, rows_in(batch) * rows_->slots(), slots.data() + begin);
      });
    }
    columns_to_values(slots);
    for_blocks_by_thread(batch_count_, threads_, [&](Index batch, int thread) {
      double* at = slots.data() + row(batch) * rows_->slots();
      double* values = values_[static_cast<std::size_t>(thread)].get();
      rows_->to_values(at, values, rows_in(batch));
      sums_[static_cast<std::size_t>(batch)] = f({values, static_cast<std::size_t>(rows_in(batch) * rows_->values())});
      rows_->to_slots(values, at, rows_in(batch));
    });
    columns_to_slots(slots);
    double sum = 0;
    for (const double part : sums_) sum += part;
    return sum;
  }

 private:
  Index row(Index batch) const { return batch * rows_->batch(); }
  Index rows_in(Index batch) const { return std::min(rows_->batch(), row_count_ - row(batch)); }

  void columns_to_slots(std::span<double> slots) const {
    for (const auto& columns : columns_)
      for_blocks(columns->blocks(), threads_, [&](Index block) { columns->to_slots(slots.data(), block); });
  }
  void columns_to_values(std::span<double> slots) const {
    for (std::size_t i = columns_.size(); i-- > 0;) {
      const ColumnTransform& columns = *columns_[i];
      for_blocks(columns.blocks(), threads_, [&](Index block) { columns.to_values(slots.data(), block); });
    }
  }

  Index n_;
  int threads_;
  Index row_count_;
  Index slots_ = 0;
  Index batch_count_ = 0;
  double slot_scale_ = 1, value_scale_ = 1;
  std::unique_ptr<RowTransform> rows_;
  std::vector<std::unique_ptr<ColumnTransform>> columns_;  // from the last axis but one to the first
  std::vector<FftwBuffer> values_;                         // of one batch, for each thread
  mutable std::vector<double> sums_;
};

}  // namespace

void FieldTransform::forward(std::span<const double> values, std::span<double> slots) const {
  to_slots(values, slots);
  const double scale = slot_scale();
  if (scale != 1)
    for (double& slot : slots) slot *= scale;
}

void FieldTransform::inverse(std::span<const double> slots, std::span<double> values) const {
  const double scale = value_scale();
  thread_local std::vector<double> scaled;  // to_values overwrites what it is given
  scaled.resize(slots.size());
  for (std::size_t i = 0; i < slots.size(); ++i) scaled[i] = scale * slots[i];
  to_values(scaled, values);
}

std::unique_ptr<FieldTransform> identity_transform(Index unknowns) {
  return std::make_unique<IdentityTransform>(unknowns);
}

std::unique_ptr<FieldTransform> modal_transform(const Grid& grid, const TransformOptions& options) {
  return std::make_unique<ModalTransform>(grid, options);
}

}  // namespace seiche
