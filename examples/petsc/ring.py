"""A Klein–Gordon ring with friction by petsc4py: u̇ = S∇F(u) − Du, F(u) = ½uᵀMu + V(u).

    python3 ring.py -dll_append $SEICHE_TS -ts_type egc4 -ts_view
    mpiexec -n 2 python3 ring.py -dll_append $SEICHE_TS -ts_type seisav -ts_seiche_monitor

with SEICHE_TS=$(pkg-config --variable=module seiche-ts), or build/release/libseiche_ts.so.

ü = ∂²u − u − u³ − γu̇ at n points, all u before all v = u̇.
"""

import sys

import petsc4py

petsc4py.init(sys.argv)
from petsc4py import PETSc  # noqa: E402


def matrix(size, entries):
    a = PETSc.Mat().createAIJ([size, size], nnz=3)
    first, last = a.getOwnershipRange()
    for row, column, value in entries:
        if first <= row < last:
            a.setValue(row, column, value)
    a.assemble()
    return a


def main():
    options = PETSc.Options()
    n, length, gamma = options.getInt("n", 128), 20.0, options.getReal("gamma", 0.1)
    w = (n / length) ** 2
    second = [(i, (i + k) % n, value) for i in range(n) for k, value in ((-1, -w), (0, 1 + 2 * w), (1, -w))]
    M = matrix(2 * n, second + [(n + i, n + i, 1.0) for i in range(n)])
    S = matrix(2 * n, [e for i in range(n) for e in ((i, n + i, 1.0), (n + i, i, -1.0))])
    D = matrix(2 * n, [(n + i, n + i, gamma) for i in range(n)])
    u = M.createVecRight()
    first, last = u.getOwnershipRange()
    positions = slice(0, max(min(last, n) - first, 0))  # of the numbers that are here

    # V and its gradient in a Tao, the object by which PETSc knows such functions.
    V = PETSc.TAO().create()

    def objective(tao, u):
        return u.comm.tompi4py().allreduce(float((u.array_r[positions] ** 4).sum() / 4))

    def gradient(tao, u, g):
        g.array[:] = 0
        g.array[positions] = u.array_r[positions] ** 3

    V.setObjective(objective)
    V.setGradient(gradient, None)

    for i in range(first, min(last, n)):
        at = length * (i + 0.5) / n - length / 2
        u.setValue(i, 2.718281828459045 ** (-at * at))
    u.assemble()

    ts = PETSc.TS().create()
    for name, part in (("S", S), ("M", M), ("D", D), ("V", V)):
        ts.compose(name, part)
    ts.setTimeStep(0.05)
    ts.setMaxTime(20.0)
    ts.setExactFinalTime(PETSc.TS.ExactFinalTime.MATCHSTEP)
    ts.setFromOptions()

    def energy():
        Mu = u.duplicate()
        M.mult(u, Mu)
        return u.dot(Mu) / 2 + V.computeObjective(u)

    before = energy()
    ts.solve(u)
    PETSc.Sys.Print(
        f"t = {ts.getTime():g} after {ts.getStepNumber()} steps, H/dx from {before:.12g} to {energy():.12g}, "
        f"|u| = {u.norm():.12g}"
    )


main()
