"""Steps of every method on several processes, by PETSc's solvers, are those on one by Seiche's own.

    mpiexec -n 3 python3 -m mpi4py ts_on_processes.py libseiche_ts.so SEICHE

The components of the ring lie side by side. Of two processes the first holds one more than half; of more the last holds
nothing.
"""

import sys

sys.argv, arguments = [sys.argv[0], *sys.argv[1:3], "-q"], sys.argv
import ts_types_test as one  # noqa: E402
from petsc4py import PETSc  # noqa: E402

np, WORLD, SELF = one.np, PETSc.COMM_WORLD, PETSc.COMM_SELF
rank, count = WORLD.getRank(), WORLD.getSize()


class RingOfAll:
    """The same ring, shared; its Tao adds up what each process knows."""

    def __init__(self, ring):
        self.ring = ring
        n = 2 * ring.n
        sizes = {1: [n], 2: [n // 2 + 1, n - n // 2 - 1]}.get(count)
        sizes = sizes or [n // 2, *np.diff(np.linspace(n // 2, n, count - 1).astype(int)), 0]
        self.first = sum(sizes[:rank])
        self.here = slice(self.first, self.first + sizes[rank])
        self.is_position = ring.order[self.here] < ring.n

    def matrix(self, a):
        local = self.here.stop - self.here.start
        mat = PETSc.Mat().createAIJ(((local, None), (local, None)), nnz=a.shape[1], comm=WORLD)
        mat.setUp()
        for i in range(self.here.start, self.here.stop):
            for j in np.nonzero(a[i])[0]:
                mat.setValue(i, j, a[i, j])
        mat.assemble()
        return mat

    def ts(self, method, h, end, damping="D"):
        tao = PETSc.TAO().create(comm=WORLD)
        mpi = WORLD.tompi4py()
        tao.setObjective(lambda _, u: mpi.allreduce(float((u.array_r[self.is_position] ** 4).sum() / 4)))

        def gradient(_, u, g):
            g.array[:] = np.where(self.is_position, u.array_r**3, 0)

        tao.setGradient(gradient, None)
        parts = {"S": self.ring.S, "M": self.ring.M, "D": self.ring.D}
        if damping == "S":
            parts = {"S": self.ring.S - self.ring.D, "M": self.ring.M}
        shared = {name: self.matrix(part) for name, part in parts.items()}
        return one.stepper(method, h, end, shared | {"V": tao}, WORLD)

    def vector(self):
        return PETSc.Vec().createWithArray(self.ring.start[self.here].copy(), comm=WORLD)

    def solve(self, method, h, end, **how):
        u = self.vector()
        ts = self.ts(method, h, end, **how)
        one.with_options(ts, ts_seiche_ksp=True)  # which matters on one process
        ts.solve(u)
        return u

    def miss(self, u, expected):
        local = np.abs(u.array_r - expected[self.here])
        return WORLD.tompi4py().allreduce(local.max() if local.size else 0.0, op=one_max)


from mpi4py.MPI import MAX as one_max  # noqa: E402

n = 12
ring = one.Ring(n=n, order=np.arange(2 * n).reshape(2, n).T.ravel())
shared = RingOfAll(ring)
for method in one.methods:
    name = method["name"]
    expected = ring.solve(name, 0.05, 1.0)
    miss = shared.miss(shared.solve(name, 0.05, 1.0), expected)
    # The multiplier of the lm family is found to a tolerance, from which round-off starts anew.
    assert miss < (1e-7 if name.endswith("lm") else 1e-12), f"{name}: {miss}"

# Friction in S, adaptivity, events, a change of the solution on one process alone, and interpolation.
exact = ring.exact(2.0)
assert shared.miss(shared.solve("egc6", 0.05, 2.0, damping="S"), exact) < 1e-8
steps = []
for tolerance in (1e-5, 1e-8):
    ts = shared.ts("egc4", 0.5, 2.0)
    one.with_options(ts, ts_adapt_type="basic", ts_rtol=0.0, ts_atol=tolerance)
    u = shared.vector()
    ts.solve(u)
    assert shared.miss(u, exact) < 100 * tolerance
    steps.append(ts.getStepNumber())
assert steps[1] > 2 * steps[0], steps


def kick(ts):
    if ts.getStepNumber() == 10 and rank == 0:
        ts.getSolution().array[0] += 1


def kick_alone(ts):
    if ts.getStepNumber() == 10:
        ts.getSolution().array[0] += 1


ts, alone = shared.ts("seisav", 0.125, 2.0), ring.ts("seisav", 0.125, 2.0)
ts.setPostStep(kick)
alone.setPostStep(kick_alone)
u, v = shared.vector(), ring.vector()
ts.solve(u)
alone.solve(v)
assert shared.miss(u, v.array_r) < 1e-12
ts, alone = shared.ts("egc4", 0.05, 1.03), ring.ts("egc4", 0.05, 1.03)
u, v = shared.vector(), ring.vector()
for stepper, solution in ((ts, u), (alone, v)):
    stepper.setExactFinalTime(PETSc.TS.ExactFinalTime.INTERPOLATE)
    stepper.solve(solution)
assert shared.miss(u, v.array_r) < 1e-12
assert shared.miss(u, ring.exact(1.03)) < 1e-5

mpi, middle = WORLD.tompi4py(), n  # u of the point in the middle, side by side with its velocity
times = []
for stepper, solution, first in ((shared.ts("egc6", 0.1, 3.0), shared.vector(), shared.here), (ring.ts("egc6", 0.1, 3.0), ring.vector(), slice(0, 2 * n))):
    found, communicator = [], mpi if first is shared.here else None

    def crossing(ts, t, u, values, first=first, communicator=communicator):
        here = float(u.array_r[middle - first.start]) if first.start <= middle < first.stop else 0.0
        values[0] = here if communicator is None else communicator.allreduce(here)

    stepper.setEventHandler([0], [False], crossing, lambda ts, events, t, u, forward, found=found: found.append(t))
    stepper.setEventTolerances(1e-10)
    stepper.solve(solution)
    times.append(found)
assert times[0] and np.allclose(times[0], times[1], rtol=0, atol=1e-9), times

PETSc.Sys.Print(f"the same steps on {count} processes")
