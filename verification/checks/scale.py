"""The same oscillators in other units: lengths and times of 2^±100 cost no accuracy.

Multipliers along a Euclidean direction (dm, and lm where it falls back on it) give other numbers in other units, of the same accuracy.
"""

from functools import lru_cache

import numpy as np

from .. import program, reference
from ..systems.oscillators import two_oscillators
from ..verdict import Row, row

UNITS = [(2.0**100, 1.0), (2.0**-100, 1.0), (1.0, 2.0**100), (1.0, 2.0**-100), (2.0**100, 2.0**-100), (2.0**-50, 2.0**60)]
LEAST = 1e-10  # errors below are round-off in any units
FACTOR = 10.0
END, STEP, TOLERANCE = 4.0, 1 / 16, 1e-8


def tasks(systems, methods, quick):
    by_tolerance = ("egc6", "auto") if quick else ("egc4", "egc6", "egc8", "seisav", "crkn6", "auto")
    return [(m["name"], False) for m in methods] + [(name, True) for name in by_tolerance]


@lru_cache
def exact() -> np.ndarray:
    return np.array(reference.load()["two_oscillators"]["states"][-1])


def solution(name: str, by_tolerance: bool, length: float, time: float) -> tuple[program.Run, float]:
    """A run, and its error in units of `length` and `time`."""
    step = {"tolerance": TOLERANCE * length} if by_tolerance else {"h": STEP * time}
    got = program.run(program.case_text(two_oscillators(length, time), {"name": name} | step, END * time, output={"energy_every": 10**9}))
    if not got.solved:
        return got, np.inf
    return got, float(np.abs(got.state / np.array([length, length, length / time, length / time]) - exact()).max())


def judge(name, by_tolerance, _=None) -> list[Row]:
    check = "scale, tolerance" if by_tolerance else "scale"
    first, error = solution(name, by_tolerance, 1.0, 1.0)
    if first.refused:
        return [Row("two_oscillators", name, check, "as in units of 1", "refused", "refused", note=first.said)]
    if not first.solved:
        return [row("two_oscillators", name, check, "as in units of 1", first.outcome(), False, first.case)]
    limit = max(FACTOR * error, LEAST)
    worst, where, case = 0.0, "", ""
    # a tolerance is for coordinates and momenta alike, and means another thing where times are scaled
    for length, time in [u for u in UNITS if u[1] == 1.0] if by_tolerance else UNITS:
        got, apart = solution(name, by_tolerance, length, time)
        if not apart <= worst:
            worst, where, case = apart, f"length 2^{np.log2(length):g}, time 2^{np.log2(time):g}", got.case
            if not got.solved:
                return [row("two_oscillators", name, check, f"≤ {limit:.0e}", f"{where}: {got.outcome()}", False, case)]
    return [row("two_oscillators", name, check, f"≤ {limit:.0e}", f"{worst:.0e}", worst <= limit, case, where)]
