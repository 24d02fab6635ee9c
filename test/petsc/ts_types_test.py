"""PETSc's time steppers by the names of Seiche's methods, from petsc4py.

    ts_types_test.py libseiche_ts.so SEICHE [unittest options]

Exits with 77 where petsc4py or SciPy is missing.
"""

import gc
import json
import subprocess
import sys
import unittest

try:
    import numpy as np
    import petsc4py
    from scipy.integrate import solve_ivp
except ImportError as missing:
    print(f"ts_types_test: skipped for want of {missing.name}")
    sys.exit(77)

library, program = sys.argv[1:3]
petsc4py.init(["-dll_append", library])
from petsc4py import PETSc  # noqa: E402

SELF = PETSc.COMM_SELF
methods = [m for m in json.loads(subprocess.check_output([program, "list", "methods", "--json"])) if m["order"] and m["name"] != "chin4"]


def sparse(a):
    a = np.asarray(a, dtype=float)
    mat = PETSc.Mat().createAIJ(a.shape, nnz=a.shape[1], comm=SELF)
    for i, j in zip(*np.nonzero(a)):
        mat.setValue(i, j, a[i, j])
    mat.assemble()
    return mat


def stepper(method, h, end, parts, comm=SELF):
    ts = PETSc.TS().create(comm=comm)
    ts.setType(method)
    for name, part in parts.items():
        if part is not None:
            ts.compose(name, part)
    ts.setTimeStep(h)
    ts.setMaxTime(end)
    ts.setMaxSteps(100000)
    ts.setExactFinalTime(PETSc.TS.ExactFinalTime.MATCHSTEP)
    return ts


class Ring:
    """ü = ∂²u − u − ∇V − γu̇ on a ring, with its components in any order."""

    def __init__(self, n=16, gamma=0.2, order=None, V=None, slope=None):
        one, zero = np.eye(n), np.zeros((n, n))
        w = (n / 8.0) ** 2
        K = (1 + 2 * w) * one - w * (np.roll(one, 1, 0) + np.roll(one, -1, 0))
        self.n = n
        self.order = np.arange(2 * n) if order is None else np.asarray(order)  # of u in (q, p)
        at = np.ix_(self.order, self.order)
        self.S = np.block([[zero, one], [-one, zero]])[at]
        self.M = np.block([[K, zero], [zero, one]])[at]
        self.D = np.diag(np.r_[np.zeros(n), np.full(n, gamma)])[at]
        self.V = V or (lambda z: (z[:n] ** 4).sum() / 4)
        self.slope = slope or (lambda z: np.r_[z[:n] ** 3, np.zeros(n)])
        x = 8 * (np.arange(n) + 0.5) / n - 4
        self.start = np.r_[1.5 * np.exp(-(x**2)), 0.3 * np.sin(np.pi * x / 4)][self.order]

    def plain(self, u):
        z = np.empty(2 * self.n)
        z[self.order] = u
        return z

    def energy(self, u):
        return u @ self.M @ u / 2 + self.V(self.plain(u))

    def right_hand_side(self, u):
        return self.S @ (self.M @ u + self.slope(self.plain(u))[self.order]) - self.D @ u

    def ts(self, method, h=0.05, end=2.0, **parts):
        tao = PETSc.TAO().create(comm=SELF)
        tao.setObjective(lambda _, u: self.V(self.plain(u.array_r)))

        def gradient(_, u, g):
            g.array[:] = self.slope(self.plain(u.array_r))[self.order]

        tao.setGradient(gradient, None)
        return stepper(method, h, end, {"S": sparse(self.S), "M": sparse(self.M), "D": sparse(self.D), "V": tao} | parts)

    def vector(self):
        return PETSc.Vec().createWithArray(self.start.copy(), comm=SELF)

    def solve(self, method, h=0.05, end=2.0):
        u = self.vector()
        self.ts(method, h, end).solve(u)
        return u.array.copy()

    def exact(self, end=2.0):
        return solve_ivp(lambda _, u: self.right_hand_side(u), (0, end), self.start, method="DOP853", rtol=1e-13, atol=1e-13).y[:, -1]


def with_options(ts, **options):
    for name, value in options.items():
        PETSc.Options()[name] = value
    try:
        ts.setFromOptions()
    finally:
        for name in options:
            PETSc.Options().delValue(name)


class Types(unittest.TestCase):
    def test_every_method_has_its_order(self):
        ring = Ring()
        exact = ring.exact()
        for method in methods:
            with self.subTest(method["name"]):
                steps = np.array([0.1, 0.05, 0.025]) if method["order"] < 6 else np.array([0.4, 0.2, 0.1])
                errors = [np.abs(ring.solve(method["name"], h) - exact).max() for h in steps]
                self.assertLess(errors[-1], 2e-2)
                if errors[-1] > 1e-12:
                    order = np.polyfit(np.log(steps), np.log(errors), 1)[0]
                    self.assertGreater(order, method["order"] - 0.35)

    def test_no_step_raises_the_energy(self):
        ring = Ring(gamma=0.01)
        for method in methods:
            if method["law"] != "H":
                continue
            with self.subTest(method["name"]):
                energies = []
                ts = ring.ts(method["name"], 0.25, 20.0)
                ts.setMonitor(lambda ts, n, t, u: energies.append(ring.energy(u.array_r)))
                ts.solve(ring.vector())
                self.assertEqual(len(energies), 81)
                self.assertLess(np.diff(energies).max(), 1e-13 * energies[0])

    def test_any_order_of_components_gives_the_same_solution(self):
        n = 16
        there = {method: Ring().solve(method) for method in ("seisav", "egc4", "crkn4")}
        side_by_side = np.arange(2 * n).reshape(2, n).T.ravel()
        for order in (side_by_side, np.random.default_rng(3).permutation(2 * n)):
            for method, expected in there.items():
                found = Ring(order=order)
                np.testing.assert_allclose(found.plain(found.solve(method)), expected, rtol=0, atol=1e-13)

    def test_tolerances_are_kept_by_choosing_steps(self):
        ring = Ring()
        exact = ring.exact(10.0)
        for method in ("seisav", "seilm", "egc4", "egc6"):
            errors, steps = [], []
            for tolerance in (1e-4, 1e-7):
                ts = ring.ts(method, 0.5, 10.0)
                with_options(ts, ts_adapt_type="basic")
                ts.setTolerances(rtol=0, atol=tolerance)
                u = ring.vector()
                ts.solve(u)
                self.assertEqual(ts.getConvergedReason(), PETSc.TS.ConvergedReason.CONVERGED_TIME)
                self.assertGreater(ts.getStepRejections(), 0)  # the first is too long
                errors.append(np.abs(u.array - exact).max())
                steps.append(ts.getStepNumber())
            self.assertLess(errors[0], 100 * 1e-4)
            self.assertLess(errors[1], 100 * 1e-7)
            self.assertGreater(steps[1], 1.5 * steps[0])

    def test_an_event_is_found_by_going_back(self):
        ring = Ring(gamma=0.05)
        middle = ring.n // 2
        solution = solve_ivp(
            lambda _, u: ring.right_hand_side(u), (0, 3), ring.start, method="DOP853", rtol=1e-12, atol=1e-12,
            events=lambda _, u: u[middle],
        )
        crossing = solution.t_events[0][0]
        for adaptive in (False, True):
            found = []
            ts = ring.ts("egc6", 0.1, 3.0)
            ts.setEventHandler(
                [0], [False],
                lambda ts, t, u, values: values.__setitem__(0, u.array_r[middle]),
                lambda ts, events, t, u, forward: found.append(t),
            )
            ts.setEventTolerances(1e-10)
            if adaptive:
                with_options(ts, ts_adapt_type="basic", ts_rtol=1e-9, ts_atol=1e-9)
            u = ring.vector()
            ts.solve(u)
            self.assertAlmostEqual(found[0], crossing, delta=1e-7)
            np.testing.assert_allclose(u.array, ring.exact(3.0), atol=1e-6)

    def test_what_changes_the_solution_starts_anew(self):
        ring = Ring()
        for method in ("seisav", "seilm", "egc4"):
            for adaptive in (False, True):
                kicked = {}

                def kick(ts):
                    if ts.getStepNumber() == 10:
                        u = ts.getSolution()
                        u.array[ring.n] += 1.0
                        kicked.update(t=ts.getTime(), u=u.array.copy(), h=ts.getTimeStep())

                def choose(ts):
                    if adaptive:
                        with_options(ts, ts_adapt_type="basic", ts_rtol=1e-6, ts_atol=1e-6)

                ts = ring.ts(method, 0.125, 2.0)
                choose(ts)
                ts.setPostStep(kick)
                u = ring.vector()
                ts.solve(u)
                fresh = ring.ts(method, kicked["h"], 2.0)
                choose(fresh)
                fresh.setTime(kicked["t"])
                other = PETSc.Vec().createWithArray(kicked["u"], comm=SELF)
                fresh.solve(other)
                np.testing.assert_allclose(u.array, other.array, rtol=0, atol=3e-5 if adaptive else 0)

    def test_the_solution_inside_a_step_is_known(self):
        ring = Ring()
        exact = ring.exact(1.03)
        for adaptive in (False, True):
            ts = ring.ts("egc4", 0.05, 1.03)
            if adaptive:
                with_options(ts, ts_adapt_type="basic", ts_rtol=1e-8, ts_atol=1e-8)
            ts.setExactFinalTime(PETSc.TS.ExactFinalTime.INTERPOLATE)
            u = ring.vector()
            ts.solve(u)
            self.assertGreaterEqual(ts.getTime(), 1.03)
            np.testing.assert_allclose(u.array, exact, rtol=0, atol=2e-6)

    def test_momenta_that_V_turns_out_to_depend_on_are_seen(self):
        n = 16  # a wall for velocities below −0.9, which the start does not know of

        def wall(z):
            return np.minimum(z[n:] + 0.9, 0)

        ring = Ring(
            V=lambda z: (z[:n] ** 4).sum() / 4 - (wall(z) ** 3).sum() / 3,
            slope=lambda z: np.r_[z[:n] ** 3, -(wall(z) ** 2)],
        )
        found = ring.solve("egc4", 0.02)
        np.testing.assert_allclose(found, ring.exact(), rtol=0, atol=1e-5)

    def test_they_are_seen_whatever_the_steps(self):
        n = 16

        def at(c):  # V that p₈ enters once q₈ has fallen below c
            def below(z):
                return np.maximum(0, c - z[8]) ** 2

            def slope(z):
                g = np.r_[z[:n] ** 3, np.zeros(n)]
                g[8] -= np.maximum(0, c - z[8]) * z[n + 8] ** 2
                g[n + 8] += below(z) * z[n + 8]
                return g

            return Ring(gamma=0, V=lambda z: (z[:n] ** 4).sum() / 4 + below(z) * z[n + 8] ** 2 / 2, slope=slope)

        for c in np.linspace(-0.5, 1.2, 7):
            ring = at(c)
            ts = ring.ts("seisav", 0.05, 2.0)
            with_options(ts, ts_adapt_type="basic", ts_rtol=1e-6, ts_atol=1e-6)
            u = ring.vector()
            ts.solve(u)
            np.testing.assert_allclose(u.array, ring.exact(), rtol=0, atol=2e-2)

    def test_without_V_the_solution_is_that_of_the_linear_equation(self):
        n = 16
        ring = Ring(V=lambda z: 0.0, slope=lambda z: np.zeros(2 * n))
        u = ring.vector()
        ring.ts("eisav", 0.5, V=None, D=None, S=sparse(ring.S - np.diag(np.r_[np.zeros(n), np.full(n, 0.2)]))).solve(u)
        np.testing.assert_allclose(u.array, ring.exact(), rtol=0, atol=1e-11)


class Reuse(unittest.TestCase):
    """A TS that solves again, with something changed in between, does what a fresh one does."""

    def again(self, change, ring=None, changed=None, method="seisav", **options):
        ring = ring or Ring()
        ts = ring.ts(method, 0.1, 1.0)
        with_options(ts, **options)
        u = ring.vector()
        ts.solve(u)
        between = u.array.copy()
        change(ts)
        gc.collect()
        ts.setMaxTime(2.0)
        ts.solve(u)
        fresh = (changed or ring).ts(method, 0.1, 1.0)
        with_options(fresh, **options)
        change(fresh)
        other = PETSc.Vec().createWithArray(between, comm=SELF)
        fresh.solve(other)
        return ts, fresh, np.abs(u.array - other.array).max(), np.abs(other.array - ring.exact()).max()

    def test_another_potential(self):
        n = 16
        changed = Ring(V=lambda z: 0.0, slope=lambda z: np.zeros(2 * n))

        def change(ts):
            tao = PETSc.TAO().create(comm=SELF)
            tao.setObjective(lambda _, u: 0.0)
            tao.setGradient(lambda _, u, g: g.set(0), None)
            ts.compose("V", tao)

        _, _, miss, effect = self.again(change)
        self.assertLess(miss, 1e-12)
        self.assertGreater(effect, 1e-2)

    def test_other_matrices_and_matrices_that_change(self):
        ring = Ring()
        other = sparse(1.5 * ring.M)
        _, _, miss, effect = self.again(lambda ts: ts.compose("M", other))
        self.assertLess(miss, 1e-12)
        self.assertGreater(effect, 1e-2)
        for ksp in (False, True):
            _, _, miss, effect = self.again(lambda ts: ts.query("M").scale(1.5), ts_seiche_ksp=ksp)
            self.assertLess(miss, 1e-12)
            self.assertGreater(effect, 1e-2)

    def test_other_options(self):
        def choose(ts):
            with_options(ts, ts_adapt_type="basic", ts_rtol=0.0, ts_atol=1e-9)

        ts, fresh, miss, _ = self.again(choose, method="egc4")
        self.assertLess(miss, 1e-7)
        self.assertGreater(fresh.getStepNumber(), 20)
        self.assertGreater(ts.getStepNumber(), 10 + 20)

    def test_another_type_beside_our_monitor(self):
        ring = Ring()
        ts = ring.ts("seisav", 0.1, 0.5)
        with_options(ts, ts_seiche_monitor=True)
        u = ring.vector()
        ts.solve(u)
        ts.setType("rk")
        ts.setRHSFunction(lambda ts, t, u, f: f.setArray(ring.right_hand_side(u.array_r)))
        ts.setMaxTime(1.0)
        ts.setTimeStep(0.01)
        ts.solve(u)
        np.testing.assert_allclose(u.array, ring.exact(1.0), rtol=0, atol=2e-2)


class Refusals(unittest.TestCase):
    def refused(self, message, ring=None, method="seisav", **parts):
        ring = ring or Ring()
        with self.assertRaises(PETSc.Error) as refused:
            ring.ts(method, **parts).solve(ring.vector())
        self.assertIn(message, str(refused.exception))

    def test_parts_that_are_missing_or_wrong(self):
        self.refused("compose M of F(u)", M=None)
        self.refused("the structure matrix S of u̇ = S∇F(u) − Du is not known", S=None)
        self.refused('the object "M" that is composed with the TS is not a Mat', M=Ring().vector())
        self.refused("D is 30 × 30, and u has 32 components", D=sparse(np.eye(30)))
        self.refused("M must be symmetric", M=sparse(Ring().M + np.eye(32, k=1)))
        self.refused("the time step -0.1 must be > 0", h=-0.1, end=1.0)
        self.refused("chin4 does not apply", method="chin4", D=sparse(np.eye(32)))

    def test_a_gradient_that_is_not_that_of_V(self):
        n = 16
        self.refused("the gradient is not that of V", Ring(slope=lambda z: np.r_[2 * z[:n] ** 3, np.zeros(n)]))

    def test_an_exception_of_the_users_function_comes_out(self):
        def broken(z):
            raise KeyError("mine")

        ring = Ring(V=broken)
        with self.assertRaises(KeyError):
            ring.ts("seisav").solve(ring.vector())

    def test_a_step_that_fails_says_why(self):
        n = 16
        ring = Ring(V=lambda z: np.inf if z[n // 2] < 0.5 else 0.0, slope=lambda z: np.zeros(2 * n))
        self.refused("no longer finite", ring)

    def test_what_only_some_solvers_do(self):
        ring = Ring()
        for options, message in (
            ({"ts_seiche_exponential": "lanczos", "ts_seiche_ksp": True, "seiche_pc_type": "none",
              "seiche_ksp_max_it": 1, "seiche_ksp_rtol": 1e-12}, "stopped after 1 iterations"),
            ({"ts_seiche_ksp": True, "seiche_ksp_type": "preonly", "seiche_pc_type": "jacobi"}, "solves nothing"),
        ):
            for name, value in options.items():
                PETSc.Options()[name] = value
            try:
                ts = ring.ts("seisav")
                ts.setFromOptions()
                with self.assertRaises(PETSc.Error) as refused:
                    ts.solve(ring.vector())
                self.assertIn(message, str(refused.exception))
            finally:
                for name in options:
                    PETSc.Options().delValue(name)

    def test_a_metric_that_is_not_semidefinite(self):
        n = 400
        indefinite = np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
        semidefinite = 2 * np.eye(n) - np.roll(np.eye(n), 1, 0) - np.roll(np.eye(n), -1, 0)  # of a free ring
        for ksp in (False, True):
            for K, is_allowed in ((indefinite, False), (semidefinite, True)):
                ring = Ring(n=n)
                ring.M[:n, :n] = K
                ts = ring.ts("seisav", 0.01, 0.02)
                with_options(ts, ts_seiche_ksp=ksp)
                if is_allowed:
                    ts.solve(ring.vector())
                    continue
                with self.assertRaises(PETSc.Error) as refused:
                    ts.solve(ring.vector())
                self.assertIn("M must be positive semidefinite", str(refused.exception))

    def test_options_have_the_prefix_of_their_ts(self):
        ring = Ring()
        ts = ring.ts("seisav", 0.1, 0.2)
        ts.setOptionsPrefix("mine_")
        with_options(ts, mine_ts_seiche_ksp=True)
        PETSc.Options()["mine_seiche_ksp_type"] = "nonsense"
        try:
            with self.assertRaises(PETSc.Error) as refused:
                ts.solve(ring.vector())
            self.assertIn("nonsense", str(refused.exception))
        finally:
            PETSc.Options().delValue("mine_seiche_ksp_type")

    def test_an_option_that_is_wrong(self):
        ts = Ring().ts("seilm")
        with self.assertRaises(PETSc.Error) as refused:
            with_options(ts, ts_seiche_C=1.0)
        self.assertIn("C belongs to the sav family", str(refused.exception))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
