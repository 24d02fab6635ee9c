// Detects that a run with variable steps will not come to its end.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/base/vector.hpp>
#include <seiche/core/control/archive.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace seiche {

// Where a solution blows up, or a method cannot have the error it is asked for, steps shrink or stay so short that a
// run never ends, and none of them fails. Three signs, looked at whenever the number of attempts has doubled, so that
// layers, pulses and near collisions, which are over in a share of the run, show none
// (docs/decisions/0004-when-a-run-ends.md):
//   runaway    doublings of the work lead less and less far, to a sum that ends before t_end;
//   collapse   three quarters of the work led nowhere beside the first quarter;
//   endless    steps do not grow, and what is left takes most of a day.
class RunPace {
 public:
  RunPace(double t_start, double t_end, Index unknowns);
  // After every attempt, accepted or not, with the length of the last step and a way to ask for |z|, which is rarely
  // taken: why the run will not come to its end; "" else.
  std::string objection(double t, double h, FunctionRef<double()> size);
  void archive(Archive& a);

 private:
  struct Mark {
    double t, size;
    void archive(Archive& a) { a(t, size); }
  };
  std::string judge(double h) const;
  double way(std::size_t ago, std::size_t doublings) const;  // in t, up to so many marks ago
  bool shrinks(double& limit) const;

  double t_end_;
  double weight_;  // of an attempt: the work of small systems is not in their unknowns
  std::int64_t attempts_ = 0, next_ = 1;
  std::vector<Mark> marks_;  // at 0, 1, 2, 4, 8, … attempts
  double usual_size_ = 0;    // |z| in the beginning
};

}  // namespace seiche
