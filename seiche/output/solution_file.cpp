#include <seiche/core/error.hpp>
#include <seiche/output/solution_file.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/output/xdmf.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <utility>

namespace seiche {
namespace {

constexpr const char* file_name = "solution.h5";
constexpr std::uintmax_t most_settled = 1U << 28U;                // bytes, in a few seconds
constexpr const char* of_each_time[] = {"H", "H_modified", "t"};  // a number each

// The checksum of some rows of a data set, behind what has the checksum `before`.
std::uint32_t checksum_of_rows(const Hdf5Dataset& numbers, std::uint64_t begin, std::uint64_t end,
                               std::uint32_t before) {
  std::vector<double> values(static_cast<std::size_t>((end - begin) * numbers.row_size()));
  numbers.read(begin, values);
  return checksum({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)}, before);
}

std::uint32_t checksum_of_times(const Hdf5File& file, std::uint64_t rows) {
  std::uint32_t found = checksum_of_nothing;
  for (const char* name : of_each_time)
    if (file.has(name)) found = checksum_of_rows(file.dataset(name), 0, rows, found);
  return found;
}

std::uint32_t with_checksum_of_field(std::uint32_t before, std::uint32_t of_field) {
  return checksum({reinterpret_cast<const char*>(&of_field), sizeof(of_field)}, before);
}

}  // namespace

SolutionFile::SolutionFile(const Folder& folder, const Problem& problem, const Space& space, const SnapshotTimes& times,
                           bool has_modified_energy, const SolutionDescription& description)
    : path_(folder, file_name),
      layout_(solution_layout(problem)),
      description_(description),
      file_(Hdf5File::create(path_.open(), path_.temporary())),
      space_(space),
      times_(times),
      has_modified_(has_modified_energy),
      most_waiting_(layout_.chunk().front()),
      values_(space.physical_size()) {
  begin();
}

SolutionFile::SolutionFile(const SolutionFile* settling)
    : path_(settling->path_.folder(), file_name, settling_name),
      layout_(settling->layout_),
      description_(settling->description_),
      file_(Hdf5File::create(path_.open(), path_.temporary())),
      space_(settling->space_),
      times_(settling->times_),
      has_modified_(settling->has_modified_),
      is_copy_(true),
      most_waiting_(settling->most_waiting_) {
  begin();
}

void SolutionFile::begin() {
  for (Hdf5Dataset& data : make_columns(file_, layout_, description_, has_modified_))
    columns_.push_back({std::move(data)});
}

// What the checkpoint vouches for stays untouched until a copy of it is on the disk: to cut a chunk in place, HDF5
// would write it again over itself.
SolutionFile::SolutionFile(const Folder& folder, const Mark& mark, const Problem& problem, const Space& space,
                           const SnapshotTimes& times, bool has_modified_energy, const SolutionDescription& description)
    : path_(folder, file_name, settling_name),
      layout_(solution_layout(problem)),
      description_(description),
      file_(Hdf5File::create(path_.open(), path_.temporary())),
      space_(space),
      times_(times),
      shown_(mark.shown),
      last_t_(mark.last_t),
      has_modified_(has_modified_energy),
      is_copy_(true),
      is_settled_(false),
      broken_(true),
      most_waiting_(layout_.chunk().front()),
      values_(space.physical_size()) {
  const Hdf5File from = Hdf5File::open(folder, name_left_behind(folder, file_name));
  for (auto& [name, text] : description_.texts)
    if (std::string begun = text_attribute(from.id(), name); !begun.empty() && name != "case")  // of a new end
      text = std::move(begun);
  begin();
  copy_rows(from, mark.rows);
  if (waiting_ > 0) write_rows(false);
  path_.sync();
  path_.take_place();
  is_copy_ = broken_ = false;
}

std::string SolutionFile::complaint(const Folder& folder, const Mark& mark) {
  const std::string left = name_left_behind(folder, file_name);
  require_readable(folder.path() / left);
  const Hdf5File file = Hdf5File::open(folder, left);
  for (const char* name : of_each_time) {
    const std::uint64_t rows = file.has(name) ? file.dataset(name).rows() : mark.rows;
    if (rows < mark.rows)
      return fmt::format("{} of {} has {} rows, and had {} at the checkpoint", name, left, rows, mark.rows);
  }
  std::uint32_t found = checksum_of_times(file, mark.rows);
  std::istringstream fields(text_attribute(file.id(), "fields"));
  for (std::string field; fields >> field;) {
    const std::uint32_t of_field =
        checksum_of_rows(file.dataset(field), mark.rows - mark.in_last, mark.rows, checksum_of_nothing);
    found = with_checksum_of_field(found, of_field);
  }
  return found == mark.checksum ? "" : fmt::format("{} is not what it was at the checkpoint", left);
}

SolutionFile::Mark SolutionFile::mark() {
  if (broken_) throw Error("{} could not be written", path_.path().string());
  broken_ = true;  // until all of it succeeded
  if (waiting_ > written_) write_rows(false);
  path_.keep();
  file_.flush();
  broken_ = false;
  is_settled_ = false;
  const std::uint64_t rows = columns_.back().data.rows();
  Mark mark{.rows = rows,
            .in_last = std::min<std::uint64_t>(rows, waiting_ > 0 ? waiting_ : most_waiting_),
            .shown = shown_,
            .last_t = last_t_};
  mark.checksum = checksum_of_times(file_, rows);
  for (std::size_t f = 0; f < layout_.fields.size(); ++f)
    mark.checksum = with_checksum_of_field(mark.checksum, columns_[f].last_chunk);
  path_.sync();
  return mark;
}

bool SolutionFile::is_due(const State& state, bool last) const {
  if (times_.interval > 0) return (last || state.n == 0) && state.t > last_t_;
  return times_.schedule.is_due(state.n, last);
}

double SolutionFile::next_time() const {
  return times_.interval > 0 ? static_cast<double>(shown_ + 1) * times_.interval
                             : std::numeric_limits<double>::infinity();
}

void SolutionFile::observe(const State& state, const EnergyReading& energy) {
  broken_ = true;  // until all of it succeeded
  last_t_ = state.t;
  while (next_time() <= state.t) ++shown_;
  space_.to_physical(state.z, values_);
  const std::span<const double> all{values_.data(), static_cast<std::size_t>(values_.size())};
  const std::size_t fields = layout_.fields.size();
  if (waiting_ == 0) begin_chunk();
  for (std::size_t f = 0; f < fields; ++f) add(columns_[f], all.subspan(f * layout_.points(), layout_.points()));
  add(columns_[fields], {&energy.H, 1});
  if (has_modified_) add(columns_[fields + 1], {&energy.modified, 1});
  add(columns_.back(), {&state.t, 1});
  ++waiting_;
  clock_.waits(state.n);
  if (waiting_ >= most_waiting_ || clock_.is_overdue()) write_rows(false);
  broken_ = false;
}

void SolutionFile::pass(const State& state) {
  if (waiting_ == written_ || !clock_.is_overdue(state.n)) return;
  broken_ = true;
  write_rows(false);
  broken_ = false;
}

void SolutionFile::begin_chunk() {
  for (Column& column : columns_) column.last_chunk = checksum_of_nothing;
}

// Checksums are made as rows come: HDF5 1.10 does not read again what was written past its filters.
void SolutionFile::add(Column& column, std::span<const double> row) const {
  column.last_chunk = checksum({reinterpret_cast<const char*>(row.data()), row.size_bytes()}, column.last_chunk);
  if (most_waiting_ == 1) return column.data.append(row);  // large ones are kept once only
  column.rows.insert(column.rows.end(), row.begin(), row.end());
}

// A chunk that is full at once is compressed. One that has to be written before it is full stays as it is, since HDF5
// would let a longer one overwrite it before anything knows of that.
void SolutionFile::write_rows(bool last) {
  if (before_writing_) before_writing_();
  const bool is_full = waiting_ == most_waiting_;
  is_settled_ = is_settled_ && (is_full || last);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    Hdf5Dataset& data = columns_[i].data;
    std::vector<double>& rows = columns_[i].rows;
    const bool is_field = i < layout_.fields.size();
    if (!is_field || (written_ == 0 && (is_full || last))) {
      data.append(rows);
    } else if (!rows.empty()) {
      data.write_in_place(data.rows() - written_, rows);
    }
    if (!is_field || is_full) rows.clear();
  }
  written_ = is_full ? 0 : waiting_;
  if (is_full) waiting_ = 0;
  file_.flush();
  if (!is_copy_) path_.keep();
  clock_.flushed();
}

void SolutionFile::close(const RunReport& report) {
  if (waiting_ > written_) write_rows(true);
  describe_end(file_, description_, report);
  columns_.clear();
  file_.close();
}

void SolutionFile::finish(const RunReport& report) {
  report_ = report;
  std::string failure;
  try {
    if (!broken_) close(report);  // else the disk is full, and the run has said so
  } catch (const Error& error) {
    failure = error.what();
  }
  columns_.clear();
  file_.abandon();
  path_.commit();
  if (!failure.empty()) throw Error("{}", failure);
}

void SolutionFile::settle(const std::atomic<bool>* stop) const {
  if (is_settled_ || report_.status != RunReport::Status::success) return;
  std::error_code not_there;
  if (std::filesystem::file_size(path_.path(), not_there) > most_settled || not_there) return;
  const Hdf5File from = Hdf5File::open(path_.folder(), file_name);
  SolutionFile to(this);
  to.broken_ = true;  // until all of it is there
  if (!to.copy_rows(from, from.dataset("t").rows(), stop)) return;
  to.close(report_);
  to.file_.abandon();
  to.path_.commit();
}

// Those of a chunk that is not full are kept, as if they had just been observed. False where `stop` is set meanwhile.
bool SolutionFile::copy_rows(const Hdf5File& from, std::uint64_t rows, const std::atomic<bool>* stop) {
  std::vector<Hdf5Dataset> columns;
  for (const Column& column : columns_) columns.push_back(from.dataset(column.data.name()));
  for (std::uint64_t first = 0; first < rows; first += most_waiting_) {
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) return false;
    waiting_ = std::min<std::uint64_t>(most_waiting_, rows - first);
    begin_chunk();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      std::vector<double> values(static_cast<std::size_t>(waiting_ * columns[i].row_size()));
      columns[i].read(first, values);
      add(columns_[i], values);
    }
    if (waiting_ == most_waiting_) write_rows(false);
  }
  return true;
}

SolutionFile::~SolutionFile() {
  try {
    if (!broken_ && !columns_.empty() && waiting_ > written_) write_rows(true);
  } catch (const std::exception&) {  // what is in the file stays
    broken_ = true;
  }
  columns_.clear();
  file_.abandon();
}

std::uint64_t SolutionFile::describe(const std::atomic<bool>* stop) const {
  return write_xdmf(path_.folder(), path_.path().filename().string(), layout_, {.stop = stop});
}

}  // namespace seiche
