// How the fields of a problem lie in solution.h5: their names, the axes of an instant, and where its points are.
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/output/hdf5/hdf5.hpp>

#include <array>
#include <string>
#include <vector>

namespace seiche {

struct SolutionAxis {
  std::string name;  // "x", "y", "z" along a grid; "point" where points are only numbered
  std::string meaning;
  std::vector<double> values;
  double spacing = 1.0;
};

struct SolutionLayout {
  std::vector<std::string> fields;  // names of their data sets: those of the problem, unless one is taken: "x_field"
  std::vector<SolutionAxis> axes;   // of one field at one time; none for a single point: u[t]
  std::vector<Place> nodes;         // of numbered points that lie somewhere
  std::vector<Place> supports;      // the rest of Grid that pictures want
  std::vector<std::array<Index, 2>> bars;

  bool on_grid() const { return !axes.empty() && axes.front().name != "point"; }
  Hdf5Shape shape() const;  // of one field at one time, in the order of C
  std::uint64_t points() const;
  // The data set that lists the points one by one: "mesh/points", or "mesh/numbers" where they lie nowhere and stand in
  // a row; "" where a line or a single point needs none.
  std::string mesh() const;
  // Chunks of t and space: rows of 128 kB together and at most 1024; where one is larger it is a chunk, or where it is
  // larger than half a megabyte several.
  Hdf5Shape chunk() const;
};

SolutionLayout solution_layout(const Problem& problem);

}  // namespace seiche
