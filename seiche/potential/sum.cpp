#include <seiche/potential/sum.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace seiche {
namespace {

class Sum final : public PointwisePotential {
 public:
  Sum(std::vector<PlacedPotential> parts, Index fields) : parts_(std::move(parts)), fields_(fields) {}

  Index fields() const override { return fields_; }
  bool is_local() const override {
    return fields_ == 1 && all_of([](const PointwisePotential& part) { return part.is_local(); });
  }

  bool is_pointwise() const override {
    return all_of([](const PointwisePotential& part) { return part.is_pointwise(); });
  }
  std::shared_ptr<const PointwisePotential> at_points(Index first, Index count) const override {
    std::vector<PlacedPotential> parts = parts_;
    bool are_alike = true;
    for (PlacedPotential& part : parts)
      if (auto there = part.potential->at_points(first, count)) {
        part.potential = std::move(there);
        are_alike = false;
      }
    return are_alike ? nullptr : std::make_shared<const Sum>(std::move(parts), fields_);
  }

  std::optional<std::vector<TermsOfPotential>> terms_at(Index first, Index count, Index of) const override {
    std::vector<TermsOfPotential> all;
    for (const PlacedPotential& part : parts_) {
      auto terms = part.potential->is_pointwise() ? terms_of_points(part.potential, first, count)
                                                  : part.potential->terms_at(first, count, of);
      if (!terms) return std::nullopt;
      for (TermsOfPotential& each : *terms) {
        each.first_field += part.first_field;
        all.push_back(std::move(each));
      }
    }
    return all;
  }

  double value(std::span<const double> u) const override {
    double sum = 0;
    for (const PlacedPotential& part : parts_) sum += part.potential->value(read_by(part, u));
    return sum;
  }

  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    ValueAndMagnitude sum;
    for (const PlacedPotential& part : parts_) {
      sum += part.potential->value_and_magnitude(read_by(part, u));
    }
    return sum;
  }

  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    double sum = 0;
    collect(gradient, [&](const PlacedPotential& part, std::span<double> out) {
      sum += part.potential->value_and_gradient(read_by(part, u), out);
    });
    return sum;
  }

  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    collect(mean, [&](const PlacedPotential& part, std::span<double> out) {
      part.potential->mean_gradient(read_by(part, a), read_by(part, b), out);
    });
  }

  void gradient_round_off(std::span<const double> u, std::span<double> bounds) const override {
    collect(bounds, [&](const PlacedPotential& part, std::span<double> out) {
      part.potential->gradient_round_off(read_by(part, u), out);
    });
  }

  int degree() const override {
    int highest = 0;
    for (const PlacedPotential& part : parts_) {
      const int degree = part.potential->degree();
      if (degree == 0) return 0;
      highest = std::max(highest, degree);
    }
    return highest;
  }

  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override {
    std::fill(coefficients.begin(), coefficients.end(), 0.0);
    std::array<double, most_coefficients> own{};
    for (const PlacedPotential& part : parts_) {
      const std::size_t length = std::min(coefficients.size(), static_cast<std::size_t>(part.potential->degree()) + 1);
      part.potential->along(read_by(part, p), read_by(part, q), std::span(own).first(length));
      for (std::size_t k = 0; k < length; ++k) coefficients[k] += own[k];
    }
  }

  int homogeneity() const override {
    const int d = parts_.front().potential->homogeneity();
    return all_of([d](const PointwisePotential& part) { return part.homogeneity() == d; }) ? d : 0;
  }

  bool grows_outward() const override {
    return all_of([](const PointwisePotential& part) { return part.grows_outward(); });
  }
  bool grows_outward_from(Index first) const override {
    return std::all_of(parts_.begin(), parts_.end(), [first](const PlacedPotential& p) {
      const Index behind = first - p.first_field;
      return behind >= p.potential->fields() || p.potential->grows_outward_from(std::max<Index>(behind, 0));
    });
  }

 private:
  static std::optional<std::vector<TermsOfPotential>> terms_of_points(
      const std::shared_ptr<const PointwisePotential>& V, Index first, Index count) {
    auto there = V->at_points(first, count);
    TermsOfPotential terms{.points = std::vector<Index>(static_cast<std::size_t>(count)),
                           .potential = there ? there : V};
    std::iota(terms.points.begin(), terms.points.end(), first);
    return std::vector{std::move(terms)};
  }

  static constexpr std::size_t most_coefficients = 65;  // formulas have degrees of at most 64

  template <class Claim>
  bool all_of(const Claim& claim) const {
    return std::all_of(parts_.begin(), parts_.end(), [&](const PlacedPotential& p) { return claim(*p.potential); });
  }

  template <class Span>
  Span read_by(const PlacedPotential& part, Span u) const {
    const std::size_t n = u.size() / static_cast<std::size_t>(fields_);
    return u.subspan(static_cast<std::size_t>(part.first_field) * n,
                     static_cast<std::size_t>(part.potential->fields()) * n);
  }

  // out ← the sum of what `write` makes of every part
  template <class Write>
  void collect(std::span<double> out, const Write& write) const {
    thread_local std::vector<double> memory;
    if (memory.size() < out.size()) memory.resize(out.size());
    std::fill(out.begin(), out.end(), 0.0);
    for (const PlacedPotential& part : parts_) {
      const std::span<double> own = read_by(part, std::span(memory).first(out.size()));
      const std::span<double> all = read_by(part, out);
      write(part, own);
      for (std::size_t j = 0; j < own.size(); ++j) all[j] += own[j];
    }
  }

  std::vector<PlacedPotential> parts_;
  Index fields_;
};

}  // namespace

std::shared_ptr<const PointwisePotential> sum_of(const std::vector<PlacedPotential>& parts, Index fields) {
  if (parts.empty()) return nullptr;
  if (parts.size() == 1 && parts.front().potential->fields() == fields) return parts.front().potential;
  return std::make_shared<Sum>(parts, fields);
}

}  // namespace seiche
