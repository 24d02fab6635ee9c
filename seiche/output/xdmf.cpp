#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/xdmf.hpp>

#include <fmt/ranges.h>

#include <algorithm>

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
        "<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"1 1 {}\"/>\n"
        "        <Geometry GeometryType=\"ORIGIN_DXDYDZ\">{}{}</Geometry>",
        count, numbers("3", fmt::format("0 0 {:.17g}", x.values.front())),
        numbers("3", fmt::format("1 1 {:.17g}", x.spacing)));
  }
  Hdf5Shape listed = shape;
  listed.push_back(3);
  const std::string geometry =
      fmt::format("<Geometry GeometryType=\"XYZ\">{}</Geometry>",
                  layout.mesh().empty() ? numbers("1 3", "0 0 0") : stored(file, layout.mesh(), listed));
  const std::string topology = layout.on_grid()
                                   ? fmt::format("{}DSMesh\" Dimensions=\"{}", shape.size(), list(shape))
                                   : fmt::format("Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1", count);
  return fmt::format("<Topology TopologyType=\"{}\"/>\n        {}", topology, geometry);
}

// Row k of a data set with `rows` rows.
std::string field(const SolutionLayout& layout, const std::string& file, const std::string& name, std::uint64_t k,
                  std::uint64_t rows) {
  Hdf5Shape shape = layout.shape();
  if (shape.empty()) shape = {1};
  Hdf5Shape start(layout.axes.size() + 1, 0), stride(start.size(), 1), count = layout.shape(), all = count;
  start.front() = k;
  count.insert(count.begin(), 1);
  all.insert(all.begin(), rows);
  // XDMF counts a uniform line as a plane of planes.
  if (layout.on_grid() && shape.size() == 1) shape.insert(shape.begin(), {1, 1});
  return fmt::format(
      "        <Attribute Name=\"{0}\" AttributeType=\"Scalar\" Center=\"Node\"><DataItem ItemType=\"HyperSlab\" "
      "Dimensions=\"{1}\" Type=\"HyperSlab\"><DataItem Dimensions=\"3 {2}\" Format=\"XML\">{3} {4} {5}</DataItem>{6}"
      "</DataItem></Attribute>\n",
      name, list(shape), start.size(), list(start), list(stride), list(count), stored(file, name, all));
}

std::string global(const std::string& file, const std::string& name, std::uint64_t k, std::uint64_t rows) {
  return fmt::format(
      "        <Attribute Name=\"{0}\" AttributeType=\"Scalar\" Center=\"Grid\"><DataItem ItemType=\"HyperSlab\" "
      "Dimensions=\"1\" Type=\"HyperSlab\"><DataItem Dimensions=\"3 1\" Format=\"XML\">{1} 1 1</DataItem>{2}"
      "</DataItem></Attribute>\n",
      name, k, stored(file, name, {rows}));
}

}  // namespace

void write_xdmf(const Folder& folder, const std::string& name, const SolutionLayout& layout, bool has_modified_energy,
                const std::atomic<bool>* stop) {
  const Hdf5File file = Hdf5File::open(folder, name);
  const Hdf5Dataset t = file.dataset("t");
  const std::string where = points(layout, name);
  AtomicFile xdmf(folder, std::filesystem::path(name).stem().string() + ".xdmf");
  xdmf.write(
      "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf Version=\"2.0\">\n  <Domain>\n"
      "    <Grid Name=\"solution\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
  std::vector<double> times;
  for (std::uint64_t k = 0; k < t.rows(); ++k) {
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) return;
    constexpr std::uint64_t block = 4096;
    if (k % block == 0) {
      times.resize(std::min(block, t.rows() - k));
      t.read(k, times);
    }
    xdmf.write(
        fmt::format("      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{:.17g}\"/>\n        {}\n", k,
                    times[k % block], where));
    for (const std::string& one : layout.fields) xdmf.write(field(layout, name, one, k, t.rows()));
    xdmf.write(global(name, "H", k, t.rows()));
    if (has_modified_energy) xdmf.write(global(name, "H_modified", k, t.rows()));
    xdmf.write("      </Grid>\n");
  }
  xdmf.write("    </Grid>\n  </Domain>\n</Xdmf>\n");
  xdmf.commit();
}

}  // namespace seiche
