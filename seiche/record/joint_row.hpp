// A row of solution.h5 whose fields several processes hold: each compresses what it has.
#pragma once

#include <seiche/core/grid/ranks.hpp>
#include <seiche/core/grid/units.hpp>
#include <seiche/output/hdf5/hdf5.hpp>
#include <seiche/output/solution_layout.hpp>

#include <span>
#include <string>
#include <vector>

namespace seiche {

// A chunk belongs to the process that has its first plane, which gets the other planes of it, compresses it, and sends
// the bytes to the first process.
class JointRow {
 public:
  JointRow(SolutionLayout layout, const FieldPart& field, const Ranks& ranks);
  // Whether there is something to be gained: rows of several chunks, and processes that hold whole planes of the grid.
  static bool suits(const SolutionLayout& layout, const FieldPart& field);

  // The chunks of all fields, in their order in the file: on the first process. What `take` throws, and what keeps a
  // process from compressing, is thrown when all have passed.
  using Take = FunctionRef<void(std::size_t field, const Hdf5Chunk& chunk)>;
  void join(std::span<const double> values, Take take) const;

 private:
  struct Compressed {
    std::vector<double> chunks;  // packed
    std::string complaint;       // why they are not all there
  };
  Compressed compress(std::span<const double> mine, std::span<const double> from_others) const;

  SolutionLayout layout_;
  const Ranks& ranks_;
  Index plane_, size_;                  // numbers of a plane, and of a field here
  Index first_, end_, begin_own_;       // planes that are here, and where the first chunk of ours begins
  std::vector<Index> sent_, received_;  // numbers, to and from each process
};

}  // namespace seiche
