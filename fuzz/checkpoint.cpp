// Whatever has happened to a checkpoint and to the files beside it, `seiche resume` goes on or refuses with a sentence.
// Where the last byte of the input is odd, damage to a checkpoint is followed by a checksum that fits, so that all that
// reads it meets it.
#include "bars.hpp"
#include "edits.hpp"
#include "own_folder.hpp"

#include <seiche/config/case/case_file.hpp>
#include <seiche/driver/going_on.hpp>
#include <seiche/output/file/checksum.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <ctime>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace seiche::fuzz {
namespace {

namespace fs = std::filesystem;

// Ends a run after some steps or a while: a checkpoint may say that it has 10¹⁸ of them to go.
class Stop : public Observer {
 public:
  explicit Stop(std::int64_t steps) : left_(steps) {}
  bool is_due(const State&, bool) const override {
    if (--left_ <= 0 || std::clock() - begin_ > CLOCKS_PER_SEC / 2) asked = true;
    return false;
  }
  void observe(const State&, const EnergyReading&) override {}
  void finish(const RunReport&) override {}
  mutable std::atomic<bool> asked = false;

 private:
  mutable std::int64_t left_;
  std::clock_t begin_ = std::clock();
};

RunCaseOptions ended_by(Stop& stop) {
  RunCaseOptions options;
  options.begins = [&stop] { return &stop.asked; };
  options.observers = {&stop};
  return options;
}

// The files of a run that was stopped.
class StoppedRun {
 public:
  explicit StoppedRun(const std::string& method) {
    Stop stop(5);
    run_case(parse_case("[problem]\nname = \"klein_gordon\"\npoints = 4\n[method]\n" + method +
                            "[time]\nend = 2\n[output]\nledger = \"on\"\nsnapshot_every = 4\nreport = \"off\"\n",
                        "case.toml"),
             folder_.path, ended_by(stop));
    for (const auto& entry : fs::directory_iterator(folder_.path))
      files_[entry.path().filename().string()] = bytes_of(entry.path());
    if (!files_.contains(checkpoint_name)) std::abort();
  }

  void resume_damaged(const Edits& edits, bool checksum_fits) const {
    for (const auto& entry : fs::directory_iterator(folder_.path)) fs::remove_all(entry.path());
    unsigned number = 0;
    for (const auto& [name, bytes] : files_) {
      const bool is_checkpoint = name == checkpoint_name;
      // Every other edit is of the checkpoint.
      const std::string damaged =
          is_checkpoint ? checkpoint(edits, bytes, checksum_fits) : edits.applied(bytes, 2 * number++ + 1, 2 * files());
      write(folder_.path / name, damaged);
    }
    within_bars([&] {
      Stop stop(40);
      const RunCaseOptions options = ended_by(stop);
      resume_case(going_on(folder_.path, {}, options), options);
    });
  }

 private:
  unsigned files() const { return static_cast<unsigned>(files_.size()); }

  std::string checkpoint(const Edits& edits, const std::string& bytes, bool checksum_fits) const {
    // A line that names the format, what is kept, and at the end its length and checksum.
    const std::size_t head = bytes.find('\n') + 1;
    std::array<std::uint64_t, 2> tail = {};
    std::string body = checksum_fits ? bytes.substr(head, bytes.size() - head - sizeof(tail)) : bytes;
    for (unsigned number = 0; number < files(); ++number) body = edits.applied(body, 2 * number, 2 * files());
    if (!checksum_fits) return body;
    tail = {body.size(), checksum(body)};
    return bytes.substr(0, head) + body + std::string(reinterpret_cast<const char*>(tail.data()), sizeof(tail));
  }

  OwnFolder folder_;
  std::map<std::string, std::string> files_;
};

}  // namespace
}  // namespace seiche::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seiche::fuzz;
  // A history of forces, an auxiliary variable, steps of variable size.
  static const std::array<StoppedRun, 3> runs = {StoppedRun("name = \"egc4\"\nh = \"1/16\"\n"),
                                                 StoppedRun("name = \"seisav\"\nh = \"1/16\"\n"),
                                                 StoppedRun("name = \"egc6\"\ntolerance = 1e-9\n")};
  const unsigned last = size == 0 ? 0 : data[size - 1];
  runs[last / 2 % runs.size()].resume_damaged(Edits({data, size}), last % 2 == 1);
  return 0;
}
