// Chunks that several processes compress are those of one, in their order.
#include <test/support/thread_ranks.hpp>

#include <seiche/core/base/error.hpp>
#include <seiche/record/joint_row.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

SolutionLayout layout_of(const std::vector<std::size_t>& sizes) {
  SolutionLayout layout;
  layout.fields = {"u", "v"};
  for (const std::size_t size : sizes)
    layout.axes.push_back({.name = "x", .meaning = "x", .values = std::vector<double>(size)});
  return layout;
}

FieldPart part_of_field(const SolutionLayout& layout, Index unit, const Rank& rank) {
  const auto planes = static_cast<Index>(layout.shape().front()), plane = static_cast<Index>(layout.points()) / planes;
  const Units whole{.planes = planes, .size = unit, .of = planes};
  const Slab slab = slab_of(whole, rank);
  return {.size = slab.planes * plane,
          .units = units_of(whole, rank),
          .first = slab.first * plane,
          .of = static_cast<Index>(layout.points())};
}

double value(Index field, Index point) {
  return static_cast<double>(field) + std::sin(0.01 * static_cast<double>(point));
}

struct Received {
  std::size_t field;
  Hdf5Chunk chunk;
  bool operator==(const Received& other) const {
    return field == other.field && chunk.corner == other.chunk.corner && chunk.filters == other.chunk.filters &&
           chunk.bytes == other.chunk.bytes;
  }
};

std::vector<Received> of_one_process(const SolutionLayout& layout) {
  std::vector<Received> all;
  const auto points = static_cast<Index>(layout.points());
  for (std::size_t field = 0; field < layout.fields.size(); ++field) {
    std::vector<double> values;
    for (Index i = 0; i < points; ++i) values.push_back(value(static_cast<Index>(field), i));
    Hdf5File file = Hdf5File::in_memory();
    Hdf5Dataset data = file.make_dataset("u", {.row = layout.shape(), .chunk = layout.chunk()});
    data.append(values);
    data.for_chunks(0, 0, layout.shape().front(), [&](const Hdf5Shape& corner) {
      all.push_back({field, data.read_chunk(corner)});
    });
  }
  return all;
}

// Chunks that end inside a slab, that span several, and pieces of one plane; processes without a plane.
TEST(JointRow, HasTheChunksOfOneProcess) {
  for (const auto& sizes : {std::vector<std::size_t>{600, 160}, {9, 40000}, {40, 2100, 1}, {5, 300, 260}}) {
    const SolutionLayout layout = layout_of(sizes);
    const std::vector<Received> expected = of_one_process(layout);
    ASSERT_GT(expected.size(), 2);
    for (const int count : {1, 2, 3, 7}) {
      on_ranks(count, [&](const Ranks& ranks) {
        const FieldPart part = part_of_field(layout, 2, ranks.here());
        ASSERT_TRUE(JointRow::suits(layout, part));
        std::vector<double> values;
        for (Index field = 0; field < 2; ++field)
          for (Index i = 0; i < part.size; ++i) values.push_back(value(field, part.first + i));
        std::vector<Received> found;
        JointRow row(layout, part, ranks);
        const auto take = [&](std::size_t field, const Hdf5Chunk& chunk) { found.push_back({field, chunk}); };
        row.join(values, take);
        EXPECT_TRUE(found == (ranks.here().index == 0 ? expected : std::vector<Received>()))
            << sizes[1] << " on " << count;
        const auto no_room = [&](std::size_t, const Hdf5Chunk&) { throw Error("no room"); };
        if (ranks.here().index == 0) {
          EXPECT_THROW(row.join(values, no_room), Error);
        } else {
          EXPECT_NO_THROW(row.join(values, no_room));
        }
        found.clear();
        row.join(values, take);
        EXPECT_EQ(found.size(), ranks.here().index == 0 ? expected.size() : 0) << "what failed left no one waiting";
      });
    }
  }
}

// One chunk for all, rows of several times in a chunk, and parts that are no planes of the grid.
TEST(JointRow, IsNotForSmallRows) {
  for (const auto& sizes : {std::vector<std::size_t>{200, 200}, {20, 20}, {1000}}) {
    const SolutionLayout layout = layout_of(sizes);
    EXPECT_FALSE(JointRow::suits(layout, part_of_field(layout, 2, {}))) << sizes.front();
  }
  const SolutionLayout layout = layout_of({600, 160});
  EXPECT_FALSE(JointRow::suits(layout, {.size = 96000, .units = {.planes = 96000, .size = 2, .of = 96000}}));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
