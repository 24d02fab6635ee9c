#include <seiche/backend/grid/grid_space.hpp>
#include <seiche/backend/krylov/balance.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/commuting_damping.hpp>
#include <seiche/core/grid/modes.hpp>
#include <seiche/core/numerics/eigenpairs.hpp>
#include <seiche/study/one_step.hpp>
#include <seiche/study/spectrum.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

namespace seiche {
namespace {

using Block = Eigen::MatrixXcd;
using Complex = std::complex<double>;

constexpr double noise_of_step = 50 * epsilon;    // of an entry of R, relative to the largest of its kind
constexpr double noise_of_symbol = 10 * epsilon;  // of an entry of L

struct Pair {
  Complex lambda, rho;
  double uncertainty = 0;  // of λ and of ln ρ / h
};

SpectrumRow row_of(std::string mode, const Pair& pair, double h) {
  SpectrumRow row{.mode = std::move(mode)};
  row.exact_decay = 0.0 - pair.lambda.real();
  row.numerical_decay = 0.0 - std::log(std::abs(pair.rho)) / h;
  row.round_off = pair.uncertainty;
  const bool turns = std::abs(pair.lambda.imag()) > pair.uncertainty;
  row.exact_frequency = turns ? std::abs(pair.lambda.imag()) : 0.0;
  const double angle = std::copysign(1.0, pair.lambda.imag()) * std::arg(pair.rho);
  const double whole_turns = std::round((row.exact_frequency * h - angle) / (2 * std::numbers::pi));
  row.numerical_frequency = (angle + 2 * std::numbers::pi * whole_turns) / h;
  if (!turns) row.numerical_frequency = std::abs(row.numerical_frequency);
  row.resolved = std::isfinite(row.numerical_decay) && pair.uncertainty <= 1e-3 * std::max(row.exact_decay, 1 / h);
  row.aliased = row.exact_frequency * h > std::numbers::pi;
  return row;
}

bool coincide(Complex a, Complex b, double uncertainty) { return std::abs(a - b) <= uncertainty; }

// Without the lower one of two conjugate eigenvalues to which the step gives conjugate factors.
std::vector<Pair> without_conjugates(const std::vector<Pair>& all, double h) {
  std::vector<Pair> kept;
  for (const Pair& pair : all) {
    const bool repeats = pair.lambda.imag() < 0 && std::any_of(all.begin(), all.end(), [&](const Pair& other) {
                           const double apart =
                               2 * (pair.uncertainty + other.uncertainty) + 1e-12 * std::abs(pair.lambda);
                           return other.lambda.imag() > 0 && coincide(other.lambda, std::conj(pair.lambda), apart) &&
                                  coincide(other.rho, std::conj(pair.rho), h * apart * std::abs(pair.rho) + 1e-12);
                         });
    if (!repeats) kept.push_back(pair);
  }
  return kept;
}

double uncertainty_of(double of_lambda, double of_rho, Complex rho, double h) {
  return of_lambda + (rho == 0.0 ? 0.0 : of_rho / (h * std::abs(rho)));
}

// The eigenvalues of L beside those of R whose vectors are theirs.
std::vector<Pair> compared(const EigenPairs& L, const EigenPairs& R, double h) {
  const std::vector<Index> partner = partners(L, R, (h * L.values).array().exp());
  std::vector<Pair> pairs;
  for (Index i = 0; i < L.values.size(); ++i) {
    const Index j = partner[static_cast<std::size_t>(i)];
    pairs.push_back({L.values[i], R.values[j], uncertainty_of(L.uncertainty[i], R.uncertainty[j], R.values[j], h)});
  }
  return pairs;
}

Vector random_state(Index size, unsigned seed) {
  std::mt19937 generator(seed);
  Vector z(size);
  for (double& x : z) x = 2 * static_cast<double>(generator()) / static_cast<double>(std::mt19937::max()) - 1;
  return z;
}

// ---- Grids: S, M and D are one small block per mode

std::string name_of(const Mode& mode, const Grid& grid) {
  std::vector<Index> k;
  for (Index a = 0; a < grid.dimension(); ++a) {
    const auto i = static_cast<std::size_t>(a);
    const bool folds = grid.axis(a).boundary == Boundary::periodic && 2 * mode.k[i] > mode.period[i];
    k.push_back(folds ? mode.k[i] - mode.period[i] : mode.k[i]);
  }
  return k.size() == 1 ? fmt::format("{}", k[0]) : fmt::format("({})", fmt::join(k, ", "));
}

class GridSpectrum {
 public:
  GridSpectrum(const Problem& linear, OneStep& step, double h)
      : problem_(linear),
        step_(step),
        h_(h),
        modes_(linear.grid),
        fields_(linear.field_count()),
        space_(fields_, modal_transform(linear.grid)),
        D_(constant_damping(linear)) {}

  std::vector<SpectrumRow> rows(bool is_linear) {
    if (is_linear) measure_all();
    std::vector<SpectrumRow> rows;
    for (Index k = 0; k < modes_.count(); ++k) {
      step_.go_on();
      Block L = problem_.S.symbol(modes_[k]) * problem_.M.symbol(modes_[k]) - D_.symbol(modes_[k]);
      if (!modes_.are_pairs()) L.imag().setZero();
      const EigenPairs of_L = eigenpairs(L, noise_of_symbol * L.cwiseAbs());
      const auto pairs = is_linear ? compared(of_L, of_step(k, L), h_) : measured_alone(of_L, k);
      for (const Pair& pair : without_conjugates(pairs, h_))
        rows.push_back(row_of(name_of(modes_[k], problem_.grid), pair, h_));
    }
    return rows;
  }

 private:
  Index slot(Index field, Index k) const { return field * modes_.slots() + (modes_.are_pairs() ? 2 * k : k); }
  Complex amplitude(const Vector& slots, Index field, Index k) const {
    const Index at = slot(field, k);
    return modes_.are_pairs() ? Complex(slots[at], slots[at + 1]) : Complex(slots[at]);
  }

  struct Response {
    Vector before, after;  // slots
  };
  Response response(const Vector& slots) {
    Response r{slots, slots};
    const Vector z = space_.physical(slots);
    space_.from_physical(z, r.before);  // half of two slots that stand for one mode
    space_.from_physical(step_(z), r.after);
    return r;
  }

  // Modes do not meet: one step of all of them, with the same real amplitude in one field, is a column of every block.
  void measure_all() {
    for (Index j = 0; j < fields_; ++j) {
      Vector slots = Vector::Zero(space_.size());
      for (Index k = 0; k < modes_.count(); ++k) slots[slot(j, k)] = 1;
      responses_.push_back(response(slots));
    }
    noise_.setZero(fields_, fields_);
    for (Index k = 0; k < modes_.count(); ++k) noise_ = noise_.cwiseMax(block(k).cwiseAbs());
    noise_ *= noise_of_step;
  }

  Block block(Index k) const {
    Block R(fields_, fields_);
    for (Index j = 0; j < fields_; ++j) {
      const Response& r = responses_[static_cast<std::size_t>(j)];
      const double start = amplitude(r.before, j, k).real();
      for (Index i = 0; i < fields_; ++i) R(i, j) = amplitude(r.after, i, k) / start;
    }
    return R;
  }

  EigenPairs of_step(Index k, const Block& L) const {
    Block R = block(k);
    if (L.imag().isZero(0)) R.imag().setZero();  // real symbols make a real step
    return eigenpairs(R, noise_);
  }

  // ρ = ℓ(R Re x + i R Im x) for ℓx = 1: eigenvalues where R is linear.
  std::vector<Pair> measured_alone(const EigenPairs& of_L, Index k) {
    std::vector<Pair> pairs;
    for (Index e = 0; e < fields_; ++e) {
      if (!of_L.has_basis())
        throw Error("mode {} has no basis of eigenvectors, and the step is not linear: nothing can be told of it",
                    name_of(modes_[k], problem_.grid));
      Complex rho = 0;
      double size = 0;
      for (const Complex part : {Complex(1, 0), Complex(0, 1)}) {
        Vector slots = Vector::Zero(space_.size());
        for (Index f = 0; f < fields_; ++f) {
          const Complex x = of_L.vectors(f, e);
          slots[slot(f, k)] = part.real() != 0 ? x.real() : x.imag();
        }
        const double largest = slots.lpNorm<Eigen::Infinity>();
        if (largest == 0) continue;
        const Response r = response(slots);
        const double share = r.before.lpNorm<Eigen::Infinity>() / largest;
        for (Index f = 0; f < fields_; ++f) {
          const Complex term = of_L.dual(e, f) * part * amplitude(r.after, f, k) / share;
          rho += term;
          size += std::abs(term);
        }
      }
      pairs.push_back({of_L.values[e], rho, uncertainty_of(of_L.uncertainty[e], noise_of_step * size, rho, h_)});
    }
    return pairs;
  }

  const Problem& problem_;
  OneStep& step_;
  double h_;
  Modes modes_;
  Index fields_;
  GridSpace space_;
  BlockStencil D_;
  std::vector<Response> responses_;  // to each field
  Eigen::MatrixXd noise_;
};

// ---- Matrices: the eigenvectors of all unknowns together

template <class Map>
Eigen::MatrixXd matrix_of(Index n, const Map& map) {
  Eigen::MatrixXd A(n, n);
  for (Index j = 0; j < n; ++j) A.col(j) = map(Vector::Unit(n, j));
  return A;
}

std::vector<Pair> stepped_alone(const EigenPairs& of_L, const Vector& scales, OneStep& step, double h) {
  if (!of_L.has_basis())
    throw Error("L has no basis of eigenvectors, and the step is not linear: nothing can be told of its modes");
  std::vector<Pair> pairs;
  const auto image = [&](const Vector& z) -> Vector { return step(scales.cwiseProduct(z)).cwiseQuotient(scales); };
  for (Index e = 0; e < of_L.values.size(); ++e) {
    Eigen::VectorXcd after = image(of_L.vectors.col(e).real()).cast<Complex>();
    if (!of_L.vectors.col(e).imag().isZero(0)) after += Complex(0, 1) * image(of_L.vectors.col(e).imag());
    const Complex rho = (of_L.dual.row(e) * after)(0);
    const double size = of_L.dual.row(e).cwiseAbs().dot(after.cwiseAbs());
    pairs.push_back({of_L.values[e], rho, uncertainty_of(of_L.uncertainty[e], noise_of_step * size, rho, h)});
  }
  return pairs;
}

std::vector<SpectrumRow> rows_of_matrix(const Problem& linear, OneStep& step, double h, bool is_linear) {
  const Index n = linear.size();
  // D⁻¹LD and D⁻¹RD: the round-off of a wave system is then that of its largest frequency.
  Eigen::MatrixXd L = matrix_of(n, [&](const Vector& z) { return step.derivative(z); });
  const Vector scales = balancing_scales(L.sparseView());
  const auto balanced = [&](const Eigen::MatrixXd& A) -> Eigen::MatrixXd {
    return scales.cwiseInverse().asDiagonal() * A * scales.asDiagonal();
  };
  const auto pairs_of = [&](const Eigen::MatrixXd& A, double relative) {
    return eigenpairs(A.cast<Complex>(), Eigen::MatrixXd::Constant(n, n, relative * A.cwiseAbs().maxCoeff()));
  };
  step.go_on();
  const EigenPairs of_L = pairs_of(balanced(L), noise_of_symbol);
  std::vector<Pair> pairs;
  if (is_linear) {
    const Eigen::MatrixXd R = matrix_of(n, [&](const Vector& z) { return step(z); });
    pairs = compared(of_L, pairs_of(balanced(R), noise_of_symbol), h);
  } else {
    pairs = stepped_alone(of_L, scales, step, h);
  }
  pairs = without_conjugates(pairs, h);
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return std::abs(a.lambda.imag()) < std::abs(b.lambda.imag()); });
  std::vector<SpectrumRow> rows;
  for (const Pair& pair : pairs) rows.push_back(row_of(fmt::format("{}", rows.size() + 1), pair, h));
  return rows;
}

}  // namespace

Spectrum spectrum(const Problem& problem, const SimulationOptions& options, double h, const std::atomic<bool>* stop) {
  const Problem linear = linear_part_of(problem);
  const bool has_modes = !linear.matrices && !linear.damping.field_rate;
  if (!has_modes && problem.size() > spectrum_matrix_limit)
    throw Error(
        "{} has {} unknowns {}: its modes are the eigenvectors of a full matrix, and at most {} unknowns are taken; "
        "choose fewer points",
        problem.name, problem.size(),
        problem.matrices ? "and is stated by matrices" : "and a rate that changes from point to point",
        spectrum_matrix_limit);
  const Simulation applies(problem, options);  // throws where it does not: without V more would seem to
  SimulationOptions plain = options;
  plain.method_options = {};  // most of them speak of V
  plain.method_options.linear = options.method_options.linear;
  plain.variable_steps = false;
  OneStep step(linear, plain, h, stop);

  Spectrum result;
  result.problem = problem.name;
  result.method = options.method;
  result.backend = step.simulation().backend().name;
  result.h = h;
  result.rates_at_start = !has_constant_rates(problem.damping);
  result.has_potential = problem.potential != nullptr;
  result.has_drives = problem.friction || problem.has_forces() || problem.structure;
  const Linearity seen = linearity_of(step, random_state(problem.size(), 1), random_state(problem.size(), 2));
  result.is_homogeneous = seen.is_homogeneous;
  result.is_linear = seen.is_linear;
  if (!seen.is_linear && problem.size() > spectrum_single_mode_limit)
    throw Error(
        "the step of {} at h = {} is not linear, so that modes are stepped one at a time, and {} unknowns are too many for "
        "that; at most {}",
        options.method, h, problem.size(), spectrum_single_mode_limit);
  result.rows =
      has_modes ? GridSpectrum(linear, step, h).rows(seen.is_linear) : rows_of_matrix(linear, step, h, seen.is_linear);
  return result;
}

bool SpectrumRow::damping_differs() const { return !(std::abs(damping_error()) <= round_off); }

std::optional<double> SpectrumRow::phase_error() const {
  if (exact_frequency == 0) return std::nullopt;
  return (numerical_frequency - exact_frequency) / exact_frequency;
}

SpectrumVerdict judge(const Spectrum& spectrum) {
  SpectrumVerdict verdict;
  for (const SpectrumRow& row : spectrum.rows) {
    if (!row.resolved) {
      ++verdict.unresolved;
      continue;
    }
    verdict.round_off = std::max(verdict.round_off, row.round_off);
    verdict.aliased += row.aliased ? 1 : 0;
    const auto farther = [](const SpectrumRow* than, double error) {
      return than == nullptr || std::abs(error) > std::abs(than->damping_error());
    };
    if (const auto phase = row.phase_error();
        phase && (!verdict.worst_phase || std::abs(*phase) > std::abs(*verdict.worst_phase->phase_error())))
      verdict.worst_phase = &row;
    if (!row.damping_differs()) continue;
    const double error = row.damping_error();
    if (error > 0 && farther(verdict.most_spurious, error)) verdict.most_spurious = &row;
    if (error < 0 && farther(verdict.most_missing, error)) verdict.most_missing = &row;
    if (row.exact_decay <= row.round_off) continue;
    const double relative = std::abs(error) / row.exact_decay;
    if (verdict.worst_relative == nullptr || relative > verdict.relative) {
      verdict.worst_relative = &row;
      verdict.relative = relative;
    }
  }
  return verdict;
}

}  // namespace seiche
