#include <seiche/backend/grid/halo_potential.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace seiche {
namespace {

// Values of points that other processes hold, of all fields.
class Halo {
 public:
  // `wanted`: points of the whole, in rising order, which are not here.
  Halo(const std::vector<Index>& wanted, const FieldPart& part, Index fields, const Ranks& ranks)
      : ranks_(ranks), fields_(fields), size_(part.size), received_(ranks.here().count, 0), sent_(received_) {
    const auto processes = static_cast<std::size_t>(ranks.here().count);
    const auto all_of = [&](const std::vector<double>& mine, std::vector<Index>& counts) {
      const double count = static_cast<double>(mine.size());
      std::vector<double> sizes(processes);
      ranks.gather({&count, 1}, std::vector<Index>(processes, 1), sizes);
      counts.assign(sizes.begin(), sizes.end());
      std::vector<double> all(static_cast<std::size_t>(std::accumulate(counts.begin(), counts.end(), Index{0})));
      ranks.gather(mine, counts, all);
      return all;
    };
    std::vector<Index> counts, two;
    const std::vector<double> parts =
        all_of({static_cast<double>(part.first), static_cast<double>(part.first + part.size)}, two);
    const std::vector<double> all = all_of(std::vector<double>(wanted.begin(), wanted.end()), counts);
    const auto holder = [&](double point) {
      std::size_t rank = 0;
      while (point < parts[2 * rank] || point >= parts[2 * rank + 1]) ++rank;
      return rank;
    };
    for (const Index point : wanted) received_[holder(static_cast<double>(point))] += fields;
    std::size_t at = 0;
    for (std::size_t rank = 0; rank < processes; ++rank)
      for (Index k = 0; k < counts[rank]; ++k, ++at) {
        const auto point = static_cast<Index>(all[at]);
        if (point < part.first || point >= part.first + part.size) continue;
        to_send_.push_back(point - part.first);
        sent_[rank] += fields;
      }
    packed_.resize(to_send_.size() * static_cast<std::size_t>(fields));
  }

  // beside ← the values of the wanted points, of all fields of one after those of the point before.
  void exchange(std::span<const double> u, std::span<double> beside) const {
    auto to = packed_.begin();
    for (const Index point : to_send_)
      for (Index f = 0; f < fields_; ++f) *to++ = u[static_cast<std::size_t>(f * size_ + point)];
    ranks_.exchange(packed_, sent_, beside, received_);
  }

 private:
  const Ranks& ranks_;
  Index fields_, size_;
  std::vector<Index> received_, sent_;  // numbers, from and to each process
  std::vector<Index> to_send_;          // points here, those for each process side by side
  mutable std::vector<double> packed_;
};

class HaloPotential final : public PointwisePotential {
 public:
  HaloPotential(const PointwisePotential& whole, std::vector<TermsOfPotential> terms, const FieldPart& part,
                const Ranks& ranks)
      : fields_(whole.fields()),
        degree_(whole.degree()),
        homogeneity_(whole.homogeneity()),
        size_(part.size),
        points_beside_(points_beside(terms, part)),
        halo_(points_beside_, part, fields_, ranks) {
    for (Index first = 0; first < fields_; ++first) grows_outward_from_.push_back(whole.grows_outward_from(first));
    const auto beside = fields_ * std::ssize(points_beside_);
    for (auto* memory : {&a_, &b_}) memory->assign(static_cast<std::size_t>(fields_ * size_ + beside + 1), 0.0);
    for (TermsOfPotential& each : terms) terms_.emplace_back(std::move(each), *this, part);
  }

  Index fields() const override { return fields_; }
  double value(std::span<const double> u) const override {
    const std::span<const double> all = with_halo(u, a_);
    double sum = 0;
    for (const Terms& terms : terms_)
      if (terms.is_counted) sum += terms.V->value(terms.read(all, terms.u));
    return sum;
  }
  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    const std::span<const double> all = with_halo(u, a_);
    ValueAndMagnitude sum;
    for (const Terms& terms : terms_) {
      if (!terms.is_counted) continue;
      sum += terms.V->value_and_magnitude(terms.read(all, terms.u));
    }
    return sum;
  }
  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    const std::span<const double> all = with_halo(u, a_);
    double sum = 0;
    add_up(gradient, [&](const Terms& terms, std::span<double> slopes) {
      const double v = terms.V->value_and_gradient(terms.read(all, terms.u), slopes);
      if (terms.is_counted) sum += v;
    });
    return sum;
  }
  void gradient_round_off(std::span<const double> u, std::span<double> bounds) const override {
    const std::span<const double> all = with_halo(u, a_);
    add_up(bounds, [&](const Terms& terms, std::span<double> of_terms) {
      terms.V->gradient_round_off(terms.read(all, terms.u), of_terms);
    });
  }
  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    const std::span<const double> from = with_halo(a, a_), to = with_halo(b, b_);
    add_up(mean, [&](const Terms& terms, std::span<double> slopes) {
      terms.V->mean_gradient(terms.read(from, terms.u), terms.read(to, terms.w), slopes);
    });
  }
  int degree() const override { return degree_; }
  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override {
    const std::span<const double> from = with_halo(p, a_), direction = with_halo(q, b_);
    std::fill(coefficients.begin(), coefficients.end(), 0.0);
    std::vector<double>& own = own_coefficients_;
    for (const Terms& terms : terms_) {
      if (!terms.is_counted) continue;
      own.assign(std::min(coefficients.size(), static_cast<std::size_t>(terms.V->degree()) + 1), 0.0);
      terms.V->along(terms.read(from, terms.u), terms.read(direction, terms.w), own);
      for (std::size_t k = 0; k < own.size(); ++k) coefficients[k] += own[k];
    }
  }
  int homogeneity() const override { return homogeneity_; }
  bool grows_outward() const override { return grows_outward_from_.front(); }
  bool grows_outward_from(Index first) const override { return grows_outward_from_[static_cast<std::size_t>(first)]; }

 private:
  struct Terms {
    Terms(TermsOfPotential terms, const HaloPotential& of, const FieldPart& part)
        : V(std::move(terms.potential)), is_counted(terms.is_counted) {
      for (Index f = terms.first_field; f < terms.first_field + V->fields(); ++f)
        for (const Index point : terms.points) places.push_back(of.place(f, point, part));
      for (auto* memory : {&u, &w, &slopes}) memory->resize(places.size());
    }
    std::span<const double> read(std::span<const double> all, std::vector<double>& values) const {
      for (std::size_t k = 0; k < places.size(); ++k) values[k] = all[places[k]];
      return values;
    }
    std::shared_ptr<const PointwisePotential> V;
    bool is_counted;
    std::vector<std::size_t> places;  // of what it reads, in the values with the halo
    mutable std::vector<double> u, w, slopes;
  };

  static std::vector<Index> points_beside(const std::vector<TermsOfPotential>& terms, const FieldPart& part) {
    std::vector<Index> points;
    for (const TermsOfPotential& each : terms)
      for (const Index point : each.points)
        if (point != TermsOfPotential::held && (point < part.first || point >= part.first + part.size))
          points.push_back(point);
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  }

  // In what lies here, field after field, then beside, point after point, and a 0 at the end.
  std::size_t place(Index field, Index point, const FieldPart& part) const {
    if (point == TermsOfPotential::held) return a_.size() - 1;
    if (point >= part.first && point < part.first + part.size)
      return static_cast<std::size_t>(field * size_ + point - part.first);
    const auto found = std::lower_bound(points_beside_.begin(), points_beside_.end(), point);
    return static_cast<std::size_t>(fields_ * (size_ + (found - points_beside_.begin())) + field);
  }

  std::span<const double> with_halo(std::span<const double> u, std::vector<double>& all) const {
    std::copy(u.begin(), u.end(), all.begin());
    halo_.exchange(u, std::span(all).subspan(u.size(), all.size() - u.size() - 1));
    return all;
  }

  // out ← the sums of what `take` makes of every term, at the points that are here.
  template <class Take>
  void add_up(std::span<double> out, const Take& take) const {
    std::fill(out.begin(), out.end(), 0.0);
    for (const Terms& terms : terms_) {
      take(terms, std::span(terms.slopes));
      for (std::size_t k = 0; k < terms.places.size(); ++k)
        if (terms.places[k] < out.size()) out[terms.places[k]] += terms.slopes[k];
    }
  }

  Index fields_;
  int degree_, homogeneity_;
  std::vector<bool> grows_outward_from_;
  Index size_;
  std::vector<Index> points_beside_;
  Halo halo_;
  std::vector<Terms> terms_;
  mutable std::vector<double> a_, b_, own_coefficients_;
};

}  // namespace

std::shared_ptr<const PointwisePotential> halo_potential(const PointwisePotential& whole, const FieldPart& part,
                                                         const Ranks& ranks) {
  std::optional<std::vector<TermsOfPotential>> terms = whole.terms_at(part.first, part.size, part.of);
  if (!terms) return nullptr;
  return std::make_shared<HaloPotential>(whole, std::move(*terms), part, ranks);
}

}  // namespace seiche
