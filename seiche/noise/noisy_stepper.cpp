#include <seiche/noise/noisy_stepper.hpp>

#include <utility>

namespace seiche {
namespace {

class NoisyStepper final : public Stepper {
 public:
  NoisyStepper(std::unique_ptr<Bath> bath, std::unique_ptr<Stepper> inner)
      : bath_(std::move(bath)), inner_(std::move(inner)) {}

  void begin(State& s) override {
    inner_->begin(s);
    before_ = s.z;
  }

  StepReport step(State& s, double h) override {
    const double t = s.t;
    RandomRow place{.stream = s.stream, .step = static_cast<std::uint64_t>(s.n)};
    before_ = s.z;  // all else starts anew with the next step
    StepLedger of_bath;
    bathe(s, t, h / 2, place, of_bath.damping_left, of_bath.heat);
    inner_->restart(s);
    StepReport report = inner_->step(s, h);
    if (!report.solved()) {
      s.z = before_;
      return report;
    }
    place.part = 1;
    bathe(s, t + h / 2, h / 2, place, of_bath.damping_right, of_bath.heat);
    s.history_h = 0;  // which is of another z
    report.ledger += of_bath;
    return report;
  }

  EnergyReading energy(const State& s) const override {
    EnergyReading reading = inner_->energy(s);
    reading.modified = reading.H;
    reading.modified_round_off = reading.round_off;
    return reading;
  }
  bool has_modified_energy() const override { return false; }
  void keep_ledger() override {
    keeps_ledger_ = true;
    inner_->keep_ledger();
  }

 private:
  void bathe(State& s, double t, double h, const RandomRow& place, double& damping, double& heat) {
    const double before = H(s);
    bath_->damp(t, h, s.z);
    const double between = H(s);
    bath_->kick(t, h, place, s.z);
    damping = between - before;
    heat += H(s) - between;
  }
  double H(const State& s) const { return keeps_ledger_ ? inner_->energy(s).H : 0; }

  std::unique_ptr<Bath> bath_;
  std::unique_ptr<Stepper> inner_;
  Vector before_;
  bool keeps_ledger_ = false;
};

}  // namespace

std::unique_ptr<Stepper> with_noise(std::unique_ptr<Bath> bath, std::unique_ptr<Stepper> inner) {
  return std::make_unique<NoisyStepper>(std::move(bath), std::move(inner));
}

}  // namespace seiche
