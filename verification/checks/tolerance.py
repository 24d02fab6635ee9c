"""Errors at the end of runs by tolerance, against what an error of one tolerance per unit of time amounts to."""

from .. import program
from ..verdict import Row, row
from .order import floor

FACTOR = 10.0


def tasks(systems, methods, quick):
    names = ("egc4", "egc6", "egc8", "auto")
    return [(s, {"name": name}) for s in systems if s.tolerances for name in (("egc6", "auto") if quick else names)]


def judge(system, method, reference) -> list[Row]:
    name = method["name"]
    gain = reference["gain"]
    worst = (0.0, "", "")
    for tolerance in system.tolerances:
        got, error = program.run_against(system, {"name": name, "tolerance": tolerance}, reference)
        if got.refused:
            return [Row(system.name, name, "tolerance", f"≤ {FACTOR:g} ×", "refused", "refused", note=got.said)]
        ratio = error / (tolerance * gain + floor(system, reference))
        if not got.solved:
            return [row(system.name, name, "tolerance", f"≤ {FACTOR:g} ×", got.outcome(), False, got.case)]
        if ratio >= worst[0]:
            worst = (ratio, f"tolerance {tolerance:g}: error {error:.1e}, gain {gain:.3g}", got.case)
    return [row(system.name, name, "tolerance", f"≤ {FACTOR:g} ×", f"{worst[0]:.2g} ×", worst[0] <= FACTOR, worst[2], worst[1])]
