#include <seiche/core/base/error.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/common/second_order.hpp>
#include <seiche/problem/common/wave.hpp>
#include <seiche/problem/rigid_body.hpp>

namespace seiche {
namespace {

// S(L)w = L × w
class Rotation final : public PointwiseStructure {
 public:
  void apply(std::span<const double> L, std::span<const double> w, Derivative, std::span<double> out) const override {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      out[i] = L[j] * w[k] - L[k] * w[j];
    }
  }
  bool keeps_means() const override { return false; }
  std::string text() const override { return "S(L)w = L × w"; }
};

}  // namespace

Problem rigid_body(const RigidBody& options) {
  Problem p;
  p.name = "rigid_body";
  p.grid = points_without_place(1);
  p.fields = {"l1", "l2", "l3"};
  p.S = p.M = BlockStencil(3);
  for (Index i = 0; i < 3; ++i) {
    const double inertia = options.inertia[static_cast<std::size_t>(i)];
    if (!(inertia > 0)) throw Error("the moment of inertia {} = {} must be > 0", i + 1, inertia);
    p.M(i, i) = Stencil::identity(1 / inertia);
  }
  p.damping = rate_damping(options.gamma, p.grid, {true, true, true});
  p.structure = std::make_shared<Rotation>();
  p.initial = (Vector(3) << 0.1, 1.0, 0.1).finished();
  return p;
}

ProblemEntry rigid_body_entry() {
  using P = RigidBody;
  const auto moment = [](const char* name, const char* value, const char* meaning) {
    return Parameter{.name = name, .default_value = value, .meaning = meaning, .minimum = 0, .minimum_excluded = true};
  };
  const auto of_axis = [](std::size_t axis, const char* name) {
    return [axis, name](P& p, const ParameterValues& v) { p.inertia[axis] = v.real(name); };
  };
  return ProblemRows<P>({.name = "rigid_body",
                         .title = "Free rigid body",
                         .equation = "L̇ = L × I⁻¹L − γL",
                         .reference = "Euler (1765)",
                         .fields = {"l1", "l2", "l3"},
                         .meanings = {"angular momentum, axis 1", "angular momentum, axis 2",
                                      "angular momentum, axis 3"},
                         .default_h = "1/16",
                         .default_end = 100.0,
                         .default_method = "egc6"},
                        rigid_body)
      .row(moment("inertia_1", "1.0", "I₁, moment of inertia about the first axis"), of_axis(0, "inertia_1"))
      .row(moment("inertia_2", "2.0", "I₂"), of_axis(1, "inertia_2"))
      .row(moment("inertia_3", "3.0", "I₃"), of_axis(2, "inertia_3"))
      .row(&P::gamma, {.name = "gamma", .default_value = "0.02", .meaning = "γ, damping rate, 1/time"})
      .preset("tumbling");
}

}  // namespace seiche
