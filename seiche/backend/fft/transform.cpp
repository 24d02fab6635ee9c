#include <seiche/backend/fft/crossing.hpp>
#include <seiche/backend/fft/fftw_plan.hpp>
#include <seiche/backend/fft/grid_columns.hpp>
#include <seiche/backend/fft/grid_rows.hpp>
#include <seiche/backend/fft/line_kinds.hpp>
#include <seiche/backend/fft/transform.hpp>
#include <seiche/core/simd/add_scaled.hpp>
#include <seiche/core/simd/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace seiche {
namespace {

// Physical values as coordinates.
class IdentityTransform final : public FieldTransform {
 public:
  explicit IdentityTransform(const FieldPart& part)
      : part_(part), sums_(static_cast<std::size_t>(part.units.count())) {}
  Index unknowns() const override { return part_.size; }
  Index slots() const override { return part_.size; }
  FieldPart value_field() const override { return part_; }
  FieldPart slot_field() const override { return part_; }
  bool is_identity() const override { return true; }
  void to_slots(std::span<const double> values, std::span<double> slots) const override {
    std::copy(values.begin(), values.end(), slots.begin());
  }
  void to_values(std::span<double> slots, std::span<double> values) const override {
    std::copy(slots.begin(), slots.end(), values.begin());
  }
  std::span<const double> through_values(std::span<const double> from, std::span<double> slots,
                                         const Pointwise& f) const override {
    if (from.data() != slots.data()) std::copy(from.begin(), from.end(), slots.begin());
    std::fill(sums_.begin(), sums_.end(), 0.0);
    for (Index unit = 0; unit < part_.units.count(); ++unit)
      part_.for_parts(std::ssize(slots), unit, [&](Index begin, Index length) {
        sums_[static_cast<std::size_t>(unit)] +=
            f(slots.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(length)));
      });
    return sums_;
  }

 private:
  FieldPart part_;
  mutable std::vector<double> sums_;  // of units
};

// Rows along the last axis, then columns along the others, axis 0 last, which turns the planes: the same small
// transforms whatever the number of threads.
class ModalTransform final : public FieldTransform {
 public:
  ModalTransform(const Grid& grid, const TransformOptions& options)
      : n_(grid.unknowns()),
        field_(grid.field()),
        threads_(options.threads),
        row_count_(n_ / grid.axes.back().unknowns()),
        pairs_(grid.is_periodic()),
        modes_(grid),
        units_(field_.units),
        rows_of_plane_(grid.dimension() == 3 ? grid.axis(1).unknowns() : 1),
        batches_(rows_of_plane_ == 1 ? row_count_ : rows_of_plane_, rows_of_batch(grid.axes.back().unknowns())),
        batch_count_(rows_of_plane_ == 1 ? batches_.count() : units_.planes * batches_.count()) {
    const Index last = grid.dimension() - 1;
    rows_ = pairs_ ? fourier_rows(grid.axis(last).intervals, batches_, grid.dimension() == 1, options.measure_plans)
                   : real_rows(grid.axis(last), batches_, last == 0, options.measure_plans);
    slots_ = modes_.slots();
    for (Index a = 0; a <= last; ++a) {
      const GridAxis& axis = grid.axis(a);
      const auto n = static_cast<double>(axis.intervals);
      // Pairs stand for a mode and its conjugate once, along the last axis; other axes hold both.
      const bool unitary = pairs_ && a != last;
      slot_scale_ *= unitary ? 1 / std::sqrt(n) : seiche::slot_scale(axis);
      value_scale_ *= unitary ? 1 / std::sqrt(n) : seiche::value_scale(axis);
    }
    const Index inner = pairs_ ? rows_->slots() / 2 : rows_->slots();
    if (last == 2) {
      const Lines lines{units_.planes, grid.axis(1).unknowns(), inner};
      columns_ = pairs_ ? fourier_columns(lines, options.measure_plans)
                        : real_columns(grid.axis(1), lines, options.measure_plans);
    }
    if (last > 0) {
      between_ = fftw_buffer(static_cast<std::size_t>(row_count_ * rows_->slots()));
      if (options.ranks != nullptr && grid.here.count > 1)
        crossing_.emplace(*options.ranks, grid, modes_, row_count_ * rows_->slots(), threads_);
      Turned lines{grid.axis(0).unknowns(), modes_.units().planes, last == 2 ? inner : 1};
      if (crossing_) lines.stride = crossing_->stride() / (pairs_ ? 2 : 1);
      turned_ = pairs_ ? turned_fourier_columns(lines, options.measure_plans)
                       : turned_real_columns(grid.axis(0), lines, options.measure_plans);
    }
    parts_.resize(static_cast<std::size_t>(batch_count_));
    sums_.resize(static_cast<std::size_t>(units_.count()));
    const auto batch_size = static_cast<std::size_t>(batches_.most() * rows_->values());
    for (int thread = 0; thread < threads_; ++thread) values_.push_back(fftw_buffer(batch_size));
  }

  Index unknowns() const override { return n_; }
  Index slots() const override { return slots_; }
  double slot_scale() const override { return slot_scale_; }
  double value_scale() const override { return value_scale_; }
  FieldPart value_field() const override { return field_; }
  FieldPart slot_field() const override { return modes_.field(); }

  void to_slots(std::span<const double> values, std::span<double> slots) const override {
    double* const rows = turned_ ? between_.get() : slots.data();
    for_blocks(batch_count_, threads_, [&](Index batch) {
      rows_->to_slots(values.data() + row(batch) * rows_->values(), rows + row(batch) * rows_->slots(), size(batch));
    });
    columns_to_slots(slots.data());
  }

  void to_values(std::span<double> slots, std::span<double> values) const override {
    double* const rows = columns_to_values(slots.data());
    for_blocks(batch_count_, threads_, [&](Index batch) {
      rows_->to_values(rows + row(batch) * rows_->slots(), values.data() + row(batch) * rows_->values(), size(batch));
    });
  }

  std::span<const double> through_values(std::span<const double> from, std::span<double> slots,
                                         const Pointwise& f) const override {
    if (row_count_ == 1 && !turned_) return through_one_row(from, slots, f);
    const bool is_kept = turned_ && pairs_;  // by the transform that is read from it
    if (from.data() != slots.data() && !is_kept) copy(from.data(), slots.data());
    double* const rows = columns_to_values(is_kept ? const_cast<double*>(from.data()) : slots.data());
    for_blocks_by_thread(batch_count_, threads_, [&](Index batch, int thread) {
      double* const at = rows + row(batch) * rows_->slots();
      double* const values = values_[static_cast<std::size_t>(thread)].get();
      rows_->to_values(at, values, size(batch));
      apply(f, batch, values);
      rows_->to_slots(values, at, size(batch));
    });
    columns_to_slots(slots.data());
    add_parts();
    return sums_;
  }

 private:
  std::span<const double> through_one_row(std::span<const double> from, std::span<double> slots,
                                          const Pointwise& f) const {
    if (from.data() != slots.data()) copy(from.data(), slots.data());
    double* const values = values_.front().get();
    rows_->to_values(slots.data(), values, 1);
    sums_.front() = f({values, static_cast<std::size_t>(n_)});
    rows_->to_slots(values, slots.data(), 1);
    return sums_;
  }

  Index row(Index batch) const {
    if (rows_of_plane_ == 1) return batches_.begin(batch);
    return batch / batches_.count() * rows_of_plane_ + batches_.begin(batch % batches_.count());
  }
  Index size(Index batch) const { return batches_.size(rows_of_plane_ == 1 ? batch : batch % batches_.count()); }

  // Where planes are rows, a batch holds whole units, but for one row that is too long for others; else it is a part of
  // a plane.
  void apply(const Pointwise& f, Index batch, double* values) const {
    const auto count = [&](Index rows) { return static_cast<std::size_t>(rows * rows_->values()); };
    if (rows_of_plane_ > 1 || size(batch) == 1) {
      parts_[static_cast<std::size_t>(batch)] = f({values, count(size(batch))});
      return;
    }
    const Index first = row(batch), end = first + size(batch);
    for (Index unit = first / units_.size; unit < units_.count() && units_.begin(unit) < end; ++unit)
      sums_[static_cast<std::size_t>(unit)] =
          f({values + (units_.begin(unit) - first) * rows_->values(), count(units_.end(unit) - units_.begin(unit))});
  }
  void add_parts() const {
    if (rows_of_plane_ == 1 && batches_.width() > 1) return;
    const Index per_plane = rows_of_plane_ == 1 ? 1 : batches_.count();
    for (Index unit = 0; unit < units_.count(); ++unit) {
      double& sum = sums_[static_cast<std::size_t>(unit)];
      sum = 0;
      for (Index part = units_.begin(unit) * per_plane; part < units_.end(unit) * per_plane; ++part)
        sum += parts_[static_cast<std::size_t>(part)];
    }
  }

  // On all threads: one alone would draw into its cache what the passes over the modes have left in those of others.
  void copy(const double* from, double* to) const {
    constexpr Index block_slots = 8192;
    for_blocks((slots_ + block_slots - 1) / block_slots, threads_, [&](Index block) {
      const Index begin = block * block_slots;
      std::copy_n(from + begin, std::min(block_slots, slots_ - begin), to + begin);
    });
  }

  void columns_to_slots(double* slots) const {
    if (columns_)
      for_blocks(columns_->blocks(), threads_,
                 [&](Index block) { columns_->to_slots(between_.get(), between_.get(), block); });
    if (!turned_) return;
    double* const columns = crossing_ ? crossing_->to_modes(between_.get()) : between_.get();
    for_blocks(turned_->blocks(), threads_, [&](Index block) { turned_->to_slots(columns, slots, block); });
  }
  double* columns_to_values(double* slots) const {  // the rows
    if (!turned_) return slots;
    double* const columns = crossing_ ? crossing_->columns() : between_.get();
    for_blocks(turned_->blocks(), threads_, [&](Index block) { turned_->to_values(slots, columns, block); });
    if (crossing_) crossing_->to_values(between_.get());
    if (columns_)
      for_blocks(columns_->blocks(), threads_,
                 [&](Index block) { columns_->to_values(between_.get(), between_.get(), block); });
    return between_.get();
  }

  Index n_;  // values
  FieldPart field_;
  int threads_;
  Index row_count_;
  bool pairs_;
  Modes modes_;
  Units units_;  // of the values
  Index rows_of_plane_;
  Batches batches_;  // of all rows where each is a plane, else of those of one plane
  Index batch_count_;
  Index slots_ = 0;
  double slot_scale_ = 1, value_scale_ = 1;
  std::unique_ptr<RowTransform> rows_;
  std::unique_ptr<ColumnTransform> columns_;  // along axis 1 of three
  std::unique_ptr<ColumnTransform> turned_;   // along axis 0, where it is not the last
  FftwBuffer between_;                        // the rows, where they are not the slots
  std::vector<FftwBuffer> values_;            // of one batch, for each thread
  std::optional<Crossing> crossing_;          // to the other processes
  mutable std::vector<double> parts_, sums_;  // of batches, where they are parts of planes; of units
};

}  // namespace

void FieldTransform::forward(std::span<const double> values, std::span<double> slots) const {
  to_slots(values, slots);
  if (const double factor = slot_scale(); factor != 1) scale(slots.data(), factor, std::ssize(slots), slots.data());
}

void FieldTransform::inverse(std::span<const double> slots, std::span<double> values) const {
  thread_local std::vector<double> scaled;  // to_values overwrites what it is given
  scaled.resize(slots.size());
  scale(slots.data(), value_scale(), std::ssize(slots), scaled.data());
  to_values(scaled, values);
}

std::unique_ptr<FieldTransform> identity_transform(Index unknowns) { return identity_transform(FieldPart{unknowns}); }

std::unique_ptr<FieldTransform> identity_transform(const FieldPart& part) {
  return std::make_unique<IdentityTransform>(part);
}

std::unique_ptr<FieldTransform> modal_transform(const Grid& grid, const TransformOptions& options) {
  return std::make_unique<ModalTransform>(grid, options);
}

}  // namespace seiche
