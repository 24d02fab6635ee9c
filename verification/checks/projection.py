"""The default law against `law = "guard"` and `law = "none"` at the same fixed steps, resolved or not.

Steps where the default fails with exit code 1 are left out: it says so, and that is not a wrong number. Nor is a run
without a law that raises H, where no solution does, anything to compare with.
"""

import numpy as np

from .. import program
from ..verdict import Row, row
from .order import floor

FACTOR = {"egc4": 2.0, "egc6": 2.0, "egc8": 2.0, "etdrk4": 2.0}
ELSE = 3.0  # of order two: the law changes the constant of an error that has one term

ALL = ("egc2", "egc4", "egc6", "egc8", "etdrk4", "seimp")
QUICK = ("egc4", "egc6", "etdrk4", "seimp")


def tasks(systems, methods, quick):
    chosen = [m for m in methods if m["name"] in (QUICK if quick else ALL)]
    return [(system, method) for system in systems for method in chosen if system.gross or system.steps]


def raises_H(got) -> bool:
    """By more than a thousandth of what it was, where no solution does: a run that no law could allow is no measure of one."""
    energy = (got.summary or {}).get("energy", {})
    rise, initial = energy.get("max_increase"), energy.get("initial")
    return rise is not None and initial is not None and rise > 1e-3 * abs(initial)


def judge(system, method, reference) -> list[Row]:
    name, smallest = method["name"], 10 * floor(system, reference)
    factor = FACTOR.get(name, ELSE)
    expected = f"≤ {factor:g} ×"
    worst = (0.0, "", "")
    for h in sorted({*system.gross, *system.steps[:3]}, reverse=True):
        errors = {}
        for law in ("interval", "guard", "none"):
            got, errors[law] = program.run_against(system, {"name": name, "h": float(h), "law": law}, reference, h, energy_every=1)
            if got.refused:
                return [Row(system.name, name, "projection", expected, "refused", "refused", note=got.said)]
            if law == "interval":
                case = got.case
            if law == "none" and system.law == "falls" and raises_H(got):
                errors[law] = np.inf
        best = min(errors["guard"], errors["none"])
        if not np.isfinite(best) or not np.isfinite(errors["interval"]):
            continue
        ratio = errors["interval"] / max(best, smallest)
        if not ratio <= worst[0]:
            worst = (ratio, f"h = {h:g}: {errors['interval']:.1e}, guard {errors['guard']:.1e}, none {errors['none']:.1e}", case)
    return [row(system.name, name, "projection", expected, f"{worst[0]:.2g} ×", worst[0] <= factor, worst[2], worst[1])]
