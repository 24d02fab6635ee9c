"""Observed orders against those that `seiche list methods` declares."""

import numpy as np

from .. import program
from ..verdict import Row, row

MORE_HALVES = 4  # steps are halved so many times more where the last three are no straight line yet


def floor(system, reference) -> float:
    """Errors below are round-off: that of the reference, and that of some thousand steps, as the system amplifies it."""
    amplified = 3e-13 * max(1.0, 0.1 * reference["gain"])
    return max(amplified, 30 * reference["error"]) * float(np.abs(system.z0).max())


def slope(points) -> float:
    """By least squares over all points, or over the last two, which are nearest to the limit, if that is more."""
    h, e = np.log2([p[0] for p in points]), np.log2([p[1] for p in points])
    return max(float(np.polyfit(h, e, 1)[0]), float(np.polyfit(h[-2:], e[-2:], 1)[0]))


QUICK = ("avf", "seisav", "seilm", "seidm", "seavf", "egc4", "egc6", "egc8", "etdrk4", "crkn6", "chin4")


def tasks(systems, methods, quick):
    methods = [m for m in methods if not quick or m["name"] in QUICK]
    return [(system, method) for system in systems if system.steps for method in methods]


def judge(system, method, reference) -> list[Row]:
    name, declared = method["name"], method["order"]
    wanted = min(declared, system.limits.get(name, declared))
    least = wanted - max(0.4, 0.1 * wanted)
    smallest = floor(system, reference)
    points, steps = [], list(system.steps)
    halvings = MORE_HALVES
    while steps:
        h = steps.pop(0)
        got, error = program.run_against(system, {"name": name, "h": float(h)}, reference, system.steps[0])
        if got.refused:
            return [Row(system.name, name, "order", f"{wanted:g}", "refused", "refused", note=got.said)]
        if error <= smallest:
            break
        points.append((h, error))
        tail = [p for p in points[-3:] if np.isfinite(p[1])]
        if not steps and halvings and (len(tail) < 3 or slope(tail) < least):
            steps, halvings = [h / 2], halvings - 1
    expected = f"≥ {least:g}"
    tail = [p for p in points[-3:] if np.isfinite(p[1])]
    if error <= smallest and len(tail) < 3:  # fewer than three errors stand above round-off
        return [row(system.name, name, "order", expected, "round-off", True)]
    if len(tail) < 3:
        return [row(system.name, name, "order", expected, got.outcome(), False, got.case)]
    observed = slope(tail)
    shown = ", ".join(f"{e:.1e}" for _, e in points)
    return [row(system.name, name, "order", expected, f"{observed:.2f}", observed >= least, got.case, f"errors {shown}")]
