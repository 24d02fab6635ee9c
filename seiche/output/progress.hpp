// The progress of a run on a terminal: share done, time reached, steps per second, time left.
#pragma once

#include <seiche/core/observer.hpp>
#include <seiche/output/progress_bar.hpp>

namespace seiche {

// A bar that asked for readings would make the record depend on the clock, so it is never due: it draws while the
// time loop asks whether it is.
class Progress : public Observer {
 public:
  Progress(std::FILE* terminal, double t_end);
  void end_at(double t_end) { t_end_ = t_end; }  // before the first step

  bool is_due(const State& state, bool last) const override;
  void observe(const State&, const EnergyReading&) override {}
  void finish(const RunReport& report) override;  // removes the bar

 private:
  void draw(const State& state) const;

  double t_end_;
  mutable ProgressBar bar_;
  mutable std::int64_t first_n_ = -1;
  mutable double first_t_ = 0;
  mutable std::int64_t last_n_ = 0;     // when it was drawn
  mutable std::int64_t next_look_ = 0;  // reading the clock at every step would cost more than a small step
};

}  // namespace seiche
