// A linear map that is diagonal over the modes of a grid: one m × m block per mode.
#pragma once

#include <seiche/core/grid/modes.hpp>
#include <seiche/core/numerics/linear_map.hpp>

#include <Eigen/Dense>

#include <functional>
#include <vector>

namespace seiche {

// Blocks are complex where a mode is a pair of slots, and real otherwise. Entries that vanish for
// every mode are not stored, and those that are real for every mode multiply slot by slot.
class ModeMap final : public LinearMap {
 public:
  using Block = std::function<Eigen::MatrixXcd(Index index)>;  // of the mode with this index in Modes
  ModeMap(const Modes& modes, Index fields, const Block& block);

  void apply(const Vector& in, Vector& out) const override;
  void add(const Vector& in, Vector& out) const;  // out += A in

 private:
  struct Entry {
    Index row;
    Index column;
    bool real;
    Vector factors;  // per slot if real, else (Re, Im) per pair of slots
  };
  void add_entry(const Entry& entry, const Vector& in, Vector& out) const;

  Index slots_;
  std::vector<Entry> entries_;
};

}  // namespace seiche
