// What a run says at its end, behind its solution: the files that cannot be made later from others.
#pragma once

#include <seiche/core/observer.hpp>
#include <seiche/output/file/folder.hpp>
#include <seiche/simulation/simulation.hpp>

#include <functional>
#include <string>
#include <utility>

namespace seiche {

// Observers finish in their order: this one does something then.
class AtTheEnd : public Observer {
 public:
  explicit AtTheEnd(std::function<void(const RunReport&)> action) : action_(std::move(action)) {}
  bool is_due(const State&, bool) const override { return false; }
  void observe(const State&, const EnergyReading&) override {}
  void finish(const RunReport& report) override { action_(report); }

 private:
  std::function<void(const RunReport&)> action_;
};

// final.txt and summary.json.
class LastWords {
 public:
  using Summary = std::function<std::string(const RunReport&)>;

  LastWords(Folder folder, const Simulation& simulation, Summary summary);

  void write(const RunReport& report);
  // Once more where what came later has failed. A summary that does not tell of a failure must not stay.
  void correct(const RunReport& report);
  bool are_written() const { return !written_.empty(); }

 private:
  Folder folder_;
  const Simulation& simulation_;
  Summary summary_;
  std::string written_;
};

}  // namespace seiche
