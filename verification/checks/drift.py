"""Without damping the kept energy stays where it was for a hundred thousand steps."""

import numpy as np

from .. import program
from ..verdict import Row, row

PENDULUM = """name = "custom"
fields = ["q", "p"]
H = "p^2/2 + 1 - cos(q)"
initial = { q = 2, p = 0.3 }"""
STEPS = 100_000
DRIFT = {"H": 1e-13, "H_modified": 1e-12}  # the latter adds C = 2E₀ to V, and takes roots


def tasks(systems, methods, quick):
    if quick:
        methods = [m for m in methods if m["name"] in ("seisav", "seilm", "seavf", "egc6", "crkn6", "strang_exact")]
    return [(m["name"], m["law"]) for m in methods]


def judge(name, kept, reference=None) -> list[Row]:
    expected = f"≤ {DRIFT[kept]:g}"
    case = program.case_text(PENDULUM, {"name": name, "h": 0.1}, 0.1 * STEPS, output={"energy_every": STEPS // 100})
    got = program.run(case)
    if got.refused:
        return [Row("free pendulum", name, "drift", expected, "refused", "refused", note=got.said)]
    H = got.energies.get(kept)
    if got.code != 0 or H is None:
        return [row("free pendulum", name, "drift", expected, got.outcome(), False, case)]
    moved = float(np.abs(H - H[0]).max() / abs(H[0]))
    return [row("free pendulum", name, "drift", expected, f"{moved:.0e}", moved <= DRIFT[kept], case, got.said)]
