"""seiche.solve with comm: on several processes the numbers of one, to the last bit.

    PYTHONPATH=build/release/python mpiexec -n 3 python3 -m mpi4py solve_on_processes.py
"""

import numpy as np
import seiche
from mpi4py import MPI

comm = MPI.COMM_WORLD
rank, count = comm.Get_rank(), comm.Get_size()


def same(problem, *arguments, **options):
    """On all processes and on each by itself."""
    alone = seiche.solve(problem, *arguments, **options)
    shared = seiche.solve(problem, *arguments, **options, comm=comm)
    assert (shared.t == alone.t).all() and (shared.energy == alone.energy).all()
    assert shared.law == alone.law and shared.steps == alone.steps and shared.status == alone.status
    assert shared.message == alone.message, (shared.message, alone.message)
    whole = shared.gathered()
    assert (whole is None) == (rank > 0)
    if whole is not None:
        assert whole.y.shape == alone.y.shape and (whole.y == alone.y).all()
        assert whole.problem.shape == alone.problem.shape
        for one, other in zip(whole.y_events or [], alone.y_events or []):
            assert (one == other).all()
        whole.to_xarray()
    planes = comm.allgather(len(shared.problem.axes[0]))
    assert sum(planes) == len(alone.problem.axes[0])
    first = sum(planes[:rank])
    here = slice(first, first + planes[rank])
    assert (shared.problem.axes[0] == alone.problem.axes[0][here]).all()
    for field in alone.problem.fields:
        assert (shared.field(field) == alone.field(field)[:, here]).all()
    assert shared.to_xarray().sizes["x"] == planes[rank]
    return alone, shared


plane = dict(points=[12, 10], length=[6.0, 5.0])
wave = seiche.problem("klein_gordon", **plane, gamma=0.1, initial={"u": "exp(-(x-1)^2-y^2)", "v": "0.1*sin(x+2*y)"})
alone, shared = same(wave, 0.5, h=0.01)
same(wave, 0.5, tolerance=1e-6, method="egc4", t_eval=[0.0, 0.21, 0.5])
same(wave, 0.5, h=0.05, method="seilm", record_every=2, ledger=True)
same(seiche.problem("nls", points=[10, 12], length=[6.0, 6.0]), 0.2, h=0.01, method="etdrk4")
own = dict(fields=["u", "v"], M={"u": "1 - laplacian", "v": "1"}, V="(1 + x^2)*u^4/4", D={"v": 0.1}, initial={"u": "exp(-x^2-y^2)", "v": 0})
same(seiche.Problem(**own, **plane), 0.3, h=0.02)

# States of the whole grid, and of what is here.
z0 = alone.y[:, -1]
_, shared = same(wave, 0.3, z0, h=0.02)
planes = comm.allgather(len(shared.problem.axes[0]))
part = z0.reshape(2, 12, 10)[:, sum(planes[:rank]) : sum(planes[: rank + 1])]
here = seiche.solve(wave, 0.3, part, h=0.02, comm=comm)
assert (here.y == shared.y).all()


# An event by a number that all know, and an action on what is here.
def energy_of_u(t, z):
    return comm.allreduce(float(np.abs(z[: z.size // 2]).max(initial=0.0)), op=MPI.MAX) - 0.9


def energy_alone(t, z):
    return float(np.abs(z[: z.size // 2]).max()) - 0.9


def halve(t, z):
    return z / 2


for g in (energy_of_u, energy_alone):
    g.action = halve
of_all = seiche.solve(wave, 1.0, h=0.02, events=energy_of_u, comm=comm)
by_itself = seiche.solve(wave, 1.0, h=0.02, events=energy_alone)
assert len(by_itself.t_events[0]) > 0 and (of_all.t_events[0] == by_itself.t_events[0]).all()
whole = of_all.gathered()
if whole is not None:
    assert (whole.y == by_itself.y).all() and (whole.y_events[0] == by_itself.y_events[0]).all()

# What one process asks for ends all.
stopped = seiche.solve(wave, 1.0, h=0.02, observer=lambda t, z, H: not (t > 0.3 and rank == count - 1), comm=comm)
assert stopped.status == "interrupted" and abs(stopped.t[-1] - 0.32) < 1e-12, (stopped.status, stopped.t[-1])
dense = seiche.solve(wave, 0.4, h=0.02, dense_output=True, comm=comm)
exact = seiche.solve(wave, 0.4, h=0.02, dense_output=True).sol(0.333)
found = comm.gather(dense.sol(0.333).reshape(2, -1, 10))
if rank == 0:
    assert (np.concatenate(found, axis=1).ravel() == exact).all()


def refused(sentence, *arguments, **options):
    try:
        seiche.solve(*arguments, **options, comm=comm)
    except ValueError as error:
        assert sentence in str(error), error
    else:
        raise AssertionError(f"not refused: {sentence}")


if count > 1:
    refused("has no grid of two or three axes", "sine_gordon", 0.1, h=0.01)
    refused("only one process computes it", seiche.Problem(M=np.eye(4)), 0.1, np.ones(4), h=0.01)
    refused("checkpoints of several processes", wave, 0.1, h=0.01, checkpoint="/nowhere")
    refused("z0 has", wave, 0.1, np.ones(7), h=0.01)
    try:
        shared.save("/nowhere")
    except ValueError as error:
        assert "several processes hold it" in str(error)
assert seiche.solve(wave, 0.1, h=0.05, comm=MPI.COMM_SELF).gathered() is not None
if rank == 0:
    print(f"the same solutions on {count} processes")
