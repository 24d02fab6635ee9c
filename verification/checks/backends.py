"""Backends against each other, at the same steps."""

import numpy as np

from .. import program
from ..verdict import Row, row

METHODS = ("seisav", "seilm", "savf", "egc4", "egc8", "etdrk4", "crkn6", "strang_exact")
AGREEMENT = 1e-10


def tasks(systems, methods, quick):
    chosen = [m for m in methods if m["name"] in METHODS]
    return [(s, m) for s in systems if s.steps and s.z0.size >= 10 for m in chosen]


def judge(system, method, reference) -> list[Row]:
    name, h = method["name"], float(system.steps[2])
    states, refusals, case = {}, [], ""
    for backend in ("dense", "modal", "sparse"):
        got = program.run_system(system, {"name": name, "h": h}, output={"energy_every": 10**9}, backend={"name": backend})
        if got.refused:
            refusals.append(f"{backend}: {got.said}")
        elif not got.solved:
            return [row(system.name, name, "backends", f"≤ {AGREEMENT:g}", f"{backend}: {got.outcome()}", False, got.case)]
        else:
            states[backend] = got.state
            case = got.case
    if len(states) < 2:
        return [Row(system.name, name, "backends", f"≤ {AGREEMENT:g}", "refused", "refused", note="; ".join(refusals))]
    first = next(iter(states.values()))
    apart = max(float(np.abs(state - first).max()) for state in states.values())
    return [row(system.name, name, "backends", f"≤ {AGREEMENT:g}", f"{apart:.0e}", apart <= AGREEMENT, case, ", ".join(states))]
