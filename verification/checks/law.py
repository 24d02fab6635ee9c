"""No recorded energy rises where a law is promised, however long the steps; and none is promised where the exact H may rise."""

import numpy as np

from .. import program
from ..verdict import Row, row

ROUND_OFF = 1e-12
EPSILON = float(np.finfo(float).eps)

QUICK = ("avf", "seisav", "seilm", "egc4", "egc8", "etdrk4", "crkn6", "strang_exact")


def tasks(systems, methods, quick):
    methods = [m for m in methods if not quick or m["name"] in QUICK]
    return [(system, method) for system in systems for method in methods]


def judge(system, method, reference) -> list[Row]:
    name, kept = method["name"], method["law"]
    rise, at, codes, promised, lost, case, wrong = -np.inf, 0.0, set(), set(), [], "", ""
    for h in (0.25, 3.0, 30.0, 300.0):
        got = program.run_system(system, {"name": name, "h": h}, end=16 * h, output={"snapshot_every": 1})
        if got.refused:
            return [Row(system.name, name, "law", "no rise", "refused", "refused", note=got.said)]
        codes.add(got.code)
        promised.add(got.law)
        case = case or got.case
        H = got.energies.get(kept, np.zeros(0))
        if got.code == 3 and "C was raised to" in got.said and "can no longer be told from round-off" in got.said:
            lost.append(f"{h:g}")  # V is not bounded below at steps so long
        elif got.code not in (0, 1) or got.law == "violated":
            wrong = wrong or f"h = {h:g}: {got.outcome()}"
        if system.law == "free" and got.law == "holds":
            wrong = wrong or f"h = {h:g}: promised, though the exact H may rise"
        if got.law == "holds":
            if not np.isfinite(H).all():
                wrong = wrong or f"h = {h:g}: H is not finite"
            elif H.size > 1:
                size = np.abs(H[:-1]) + np.abs(H[0]) + 1e-300
                # what round-off in an angle of many turns does to its cosine
                turned = 4 * EPSILON * system.slope * max(np.abs(got.states).max(), np.abs(got.state).max())
                largest = float(((np.diff(H) - turned) / size).max())
                told = got.summary["energy"]["max_increase"] if kept == "H" else got.summary["energy"]["modified"]["max_increase"]
                if told is None or abs(told - np.diff(H).max()) > 1e-9 * size.max():
                    wrong = wrong or f"h = {h:g}: max_increase {told} is said, {np.diff(H).max():g} is in energy.csv"
                if largest > rise:
                    rise, at = largest, h
        if wrong:
            return [row(system.name, name, "law", "no rise", wrong, False, got.case)]
    if promised == {"not promised"}:
        return [row(system.name, name, "law", "no rise", "not promised", True, note=got.said)]
    if codes == {1} and rise == -np.inf:  # no step that long has a solution, and the program says so
        return [row(system.name, name, "law", "no rise", "exit 1 at every h", True, case)]
    shown = f"{rise:.0e}" + (", exit 1 at some h" if 1 in codes else "") + (f", digits lost to C at h = {', '.join(lost)}" if lost else "")
    return [row(system.name, name, "law", "no rise", shown, np.isfinite(rise) and rise <= ROUND_OFF, case, f"largest at h = {at:g}, relative to |H|")]
