"""Linear systems with closed forms: methods whose exponential holds all of the linear part are exact, at steps of any length."""

import numpy as np

from .. import program
from ..verdict import Row, row

METHODS = ("eavf", "eisav", "eilm", "egc2", "egc4", "egc6", "egc8", "seimp", "etdrk4", "strang_exact")
ERROR = 1e-10  # of the largest component at the start


def tasks(systems, methods, quick):
    chosen = [m for m in methods if m["name"] in (METHODS[::3] if quick else METHODS)]
    return [(s, m) for s in systems if s.exact for m in chosen]


def judge(system, method, reference) -> list[Row]:
    name = method["name"]
    limit = max(ERROR, 100 * reference["error"]) * float(np.abs(system.z0).max())
    worst = (0.0, "", "")
    for h in system.gross:
        got, error = program.run_against(system, {"name": name, "h": float(h)}, reference, h)
        if got.refused:
            return [Row(system.name, name, "linear", f"≤ {limit:.0e}", "refused", "refused", note=got.said)]
        if not got.solved:
            return [row(system.name, name, "linear", f"≤ {limit:.0e}", got.outcome(), False, got.case)]
        if not error <= worst[0]:
            worst = (error, f"h = {h:g}", got.case)
    return [row(system.name, name, "linear", f"≤ {limit:.0e}", f"{worst[0]:.0e}", worst[0] <= limit, worst[2], worst[1])]
