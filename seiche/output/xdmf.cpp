#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/xdmf.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace seiche {
namespace {

std::string list(const Hdf5Shape& shape) { return fmt::format("{}", fmt::join(shape, " ")); }

std::string numbers(const std::string& dimensions, const std::string& content) {
  return fmt::format("<DataItem Dimensions=\"{}\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">{}</DataItem>",
                     dimensions, content);
}

std::string stored(const std::string& file, const std::string& name, const Hdf5Shape& shape) {
  return fmt::format(
      "<DataItem Dimensions=\"{}\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">{}:/{}</DataItem>", list(shape),
      file, name);
}

// Topology and geometry, the same at all times.
std::string points(const SolutionLayout& layout, const std::string& file) {
  const Hdf5Shape shape = layout.shape();
  const std::uint64_t count = layout.points();
  if (layout.on_grid() && shape.size() == 1) {
    const SolutionAxis& x = layout.axes.front();
    return fmt::format(
        "<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"1 1 {}\"/>"
        "<Geometry GeometryType=\"ORIGIN_DXDYDZ\">{}{}</Geometry>",
        count, numbers("3", fmt::format("0 0 {}", x.values.front())), numbers("3", fmt::format("1 1 {}", x.spacing)));
  }
  Hdf5Shape listed = shape;
  listed.push_back(3);
  const std::string geometry =
      fmt::format("<Geometry GeometryType=\"XYZ\">{}</Geometry>",
                  layout.mesh().empty() ? numbers("1 3", "0 0 0") : stored(file, layout.mesh(), listed));
  const std::string topology = layout.on_grid()
                                   ? fmt::format("{}DSMesh\" Dimensions=\"{}", shape.size(), list(shape))
                                   : fmt::format("Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1", count);
  return fmt::format("<Topology TopologyType=\"{}\"/>{}", topology, geometry);
}

// What is the same at all times stands once, under a name that the parser of XML puts in.
std::string entity(const std::string& name, const std::string& content) {
  return fmt::format("<!ENTITY {} \'{}\'>\n", name, content);
}

class Instants {
 public:
  Instants(const SolutionLayout& layout, std::string file, std::uint64_t rows, bool has_modified_energy)
      : layout_(layout), file_(std::move(file)), rows_(rows) {
    if (has_modified_energy) energies_.emplace_back("H_modified");
  }

  std::string entities() const {
    Hdf5Shape all = layout_.shape();
    all.insert(all.begin(), rows_);
    std::string text = entity("points", points(layout_, file_));
    for (std::size_t f = 0; f < layout_.fields.size(); ++f)
      text += entity(fmt::format("field{}", f), stored(file_, layout_.fields[f], all));
    for (const std::string& energy : energies_) text += entity(energy, stored(file_, energy, {rows_}));
    return text;
  }

  std::string at(std::uint64_t k, double t) const {
    std::string text = fmt::format("<Grid Name=\"{}\" GridType=\"Uniform\"><Time Value=\"{}\"/>&points;\n", k, t);
    for (std::size_t f = 0; f < layout_.fields.size(); ++f) text += field(f, k);
    for (const std::string& energy : energies_) text += global(energy, k);
    return text + "</Grid>\n";
  }

  // Without a filter.
  std::uint64_t bytes_of_rows() const {
    const std::uint64_t numbers = layout_.fields.size() * layout_.points() + energies_.size() + 1;
    return rows_ * numbers * sizeof(double);
  }

 private:
  // Row k of a data set.
  std::string field(std::size_t f, std::uint64_t k) const {
    Hdf5Shape shape = layout_.shape();
    if (shape.empty()) shape = {1};
    Hdf5Shape start(layout_.axes.size() + 1, 0), stride(start.size(), 1), count = layout_.shape();
    start.front() = k;
    count.insert(count.begin(), 1);
    // XDMF counts a uniform line as a plane of planes.
    if (layout_.on_grid() && shape.size() == 1) shape.insert(shape.begin(), {1, 1});
    return fmt::format(
        "<Attribute Name=\"{0}\" AttributeType=\"Scalar\" Center=\"Node\"><DataItem ItemType=\"HyperSlab\" "
        "Dimensions=\"{1}\" Type=\"HyperSlab\"><DataItem Dimensions=\"3 {2}\" Format=\"XML\">{3} {4} {5}</DataItem>"
        "&field{6};</DataItem></Attribute>\n",
        layout_.fields[f], list(shape), start.size(), list(start), list(stride), list(count), f);
  }

  static std::string global(const std::string& name, std::uint64_t k) {
    return fmt::format(
        "<Attribute Name=\"{0}\" AttributeType=\"Scalar\" Center=\"Grid\"><DataItem ItemType=\"HyperSlab\" "
        "Dimensions=\"1\" Type=\"HyperSlab\"><DataItem Dimensions=\"3 1\" Format=\"XML\">{1} 1 1</DataItem>&{0};"
        "</DataItem></Attribute>\n",
        name, k);
  }

  const SolutionLayout& layout_;
  std::string file_;
  std::uint64_t rows_;
  std::vector<std::string> energies_ = {"H"};
};

// Fields are stored in about half of what their numbers take, so that a twentieth of that is a tenth of the file. The
// size of the file itself is no measure: it depends on when its rows were written.
std::uint64_t every_that_fits(const Instants& instants, std::uint64_t rows) {
  constexpr std::uint64_t share = 20, small = 1000;
  const std::uint64_t fit = instants.bytes_of_rows() / share / instants.at(rows, 0.1).size();
  const std::uint64_t most = std::max(small, fit);
  return std::max<std::uint64_t>((rows + most - 1) / most, 1);
}

}  // namespace

std::uint64_t write_xdmf(const Folder& folder, const std::string& solution, const SolutionLayout& layout,
                         const XdmfOptions& options) {
  const Hdf5File file = Hdf5File::open(folder, solution);
  const Hdf5Dataset t = file.dataset("t");
  const std::uint64_t rows = t.rows();
  const Instants instants(layout, solution, rows, file.has("H_modified"));
  const std::uint64_t every = options.all_times ? 1 : every_that_fits(instants, rows);
  AtomicFile xdmf(folder, std::filesystem::path(solution).stem().string() + ".xdmf");
  xdmf.write(
      fmt::format("<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" [\n{}]>\n", instants.entities()));
  xdmf.write(
      "<Xdmf Version=\"2.0\"><Domain><Grid Name=\"solution\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
  std::vector<double> times;
  std::uint64_t first = 0;  // of `times`
  for (std::uint64_t k = 0; k < rows; k = k + 1 == rows ? rows : std::min(k + every, rows - 1)) {
    if (options.stop != nullptr && options.stop->load(std::memory_order_relaxed)) return every;
    if (k >= first + times.size()) {
      constexpr std::uint64_t block = 4096;
      first = k;
      times.resize(std::min(block, rows - k));
      t.read(k, times);
    }
    xdmf.write(instants.at(k, times[k - first]));
  }
  xdmf.write("</Grid></Domain></Xdmf>\n");
  xdmf.commit();
  return every;
}

}  // namespace seiche
