#include <seiche/core/error.hpp>
#include <seiche/output/solution_reader.hpp>

#include <iterator>
#include <sstream>

namespace seiche {
namespace {

std::vector<std::string> words(const std::string& text) {
  std::istringstream input(text);
  return {std::istream_iterator<std::string>(input), {}};
}

}  // namespace

SolutionReader::SolutionReader(const std::filesystem::path& path)
    : file_(Hdf5File::open(path)),
      t_(file_.dataset("t")),
      H_(file_.dataset("H")),
      fields_(words(text_attribute(file_.id(), "fields"))) {
  for (const std::string& name : fields_) {
    data_.push_back(file_.dataset(name));
    meanings_.push_back(text_attribute(data_.back().id(), "long_name"));
    if (data_.back().rows() < t_.rows() || data_.back().shape() != data_.front().shape())
      throw Error("{} is damaged: {} does not fit to t and {}", path.string(), name, fields_.front());
  }
  if (data_.empty()) throw Error("{} holds no field", path.string());
  const Hdf5Shape& shape = data_.front().shape();
  const bool numbered = file_.has("point");
  for (std::size_t a = 1; a < shape.size(); ++a) {
    const std::string name = numbered ? "point" : std::string(1, static_cast<char>('x' + (a - 1)));
    axes_.push_back({name, all_of(file_.dataset(name))});
    if (axes_.back().values.size() != shape[a])
      throw Error("{} is damaged: {} has {} values for {} points", path.string(), name, axes_.back().values.size(),
                  shape[a]);
  }
  points_ = static_cast<Index>(data_.front().row_size());
}

std::vector<double> SolutionReader::all_of(const Hdf5Dataset& data) {
  std::vector<double> values(data.rows() * data.row_size());
  data.read(0, values);
  return values;
}

std::vector<Place> SolutionReader::places(const std::string& name) const {
  std::vector<Place> all;
  if (!on_points() || !file_.has(name)) return all;
  const std::vector<double> values = all_of(file_.dataset(name));
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) all.push_back({values[i], values[i + 1], values[i + 2]});
  return all;
}

std::vector<Place> SolutionReader::nodes() const { return places("mesh/points"); }
std::vector<Place> SolutionReader::supports() const { return places("mesh/supports"); }

std::vector<std::array<Index, 2>> SolutionReader::bars() const {
  std::vector<std::array<Index, 2>> all;
  if (!on_points() || !file_.has("mesh/bars")) return all;
  const Hdf5Dataset data = file_.dataset("mesh/bars");
  const std::vector<double> values = all_of(data);
  const double ends = static_cast<double>(nodes().size() + supports().size());
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    for (const double end : {values[i], values[i + 1]})
      if (!(end >= 0 && end < ends)) throw Error("mesh/bars is damaged: {} is the number of no point", end);
    all.push_back({static_cast<Index>(values[i]), static_cast<Index>(values[i + 1])});
  }
  return all;
}

double SolutionReader::time(Index k) const {
  double t = 0;
  t_.read(static_cast<std::uint64_t>(k), {&t, 1});
  return t;
}

void SolutionReader::state(Index k, Vector& values) const {
  values.resize(static_cast<Index>(data_.size()) * points_);
  for (std::size_t f = 0; f < data_.size(); ++f)
    data_[f].read(static_cast<std::uint64_t>(k),
                  {values.data() + static_cast<Index>(f) * points_, static_cast<std::size_t>(points_)});
}

void SolutionReader::field(Index field, Index k, Vector& values) const {
  values.resize(points_);
  data_[static_cast<std::size_t>(field)].read(static_cast<std::uint64_t>(k),
                                              {values.data(), static_cast<std::size_t>(points_)});
}

}  // namespace seiche
