"""Runs that are hard to end: blow-ups, collapsed steps, rates beyond any step. Each must end in time, and say what is true."""

from dataclasses import dataclass
from typing import Callable

import numpy as np

from .. import program, reference
from ..systems.linear import damped
from ..verdict import Row, row

BLOW_UP = """name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2 - q^3/3"
D = { p = 0.05 }
initial = { q = 1.01, p = 0 }"""
BLOWS_UP_AT = 7.2013  # DOP853, where |q| = 1e8
QUARTIC_WELL = """name = "custom"
fields = ["q", "p"]
H = "p^2/2 - q^4/4"
D = { p = 0.05 }
initial = { q = 2, p = 0 }"""
DECAY = """name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2"
D = { p = 0.1 }
initial = { q = 1, p = 0 }"""
APART = """name = "custom"
fields = ["a", "b", "p", "r"]
H = "(p^2 + r^2)/2 + 1e14*a^2/2 + b^2/2"
D = { p = 0.125, r = 0.125 }
initial = { a = 0, b = 1, p = 0, r = 0 }"""


def short_wave(length: float) -> str:
    return f"""name = "custom"
fields = ["u", "v"]
length = {length!r}
points = 8
H = "v^2/2 + u_x^2/2"
D = {{ v = 0.1 }}
initial = {{ u = "j", v = 0 }}"""


STIFF_PAIR = """name = "custom"
fields = ["q", "p"]
H = "p^2/2 + 1e14*q^2/2"
D = { p = 0.1 }
initial = { q = 1e-7, p = 0 }"""
OVERDAMPED = """name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
D = { p = 1000 }
initial = { q = 1, p = 0.3 }"""
DRAGGED = (1.0824803, -0.43425222)  # DOP853 and Radau at t = 1
CUBIC_DRAG = """name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2"
initial = { q = 1, p = 3 }
friction = { kind = "cubic", coefficient = 10 }"""


def sentences(got) -> str:
    """What a run says of itself: on stderr, and in the message of its summary."""
    return f"{got.said}; {(got.summary or {}).get('message', '')}"


def says(got, words: tuple) -> bool:
    return any(some in sentences(got) for some in words)


def note_on(said: bool) -> str:
    return "and says why" if said else "and does not say why"


def is_failure_near(time: float, words: tuple) -> Callable:
    def judge(got):
        at = got.summary["t"] if got.summary else np.nan
        said = says(got, words)
        return got.code == 1 and abs(at - time) < 0.5 and said, f"exit {got.code} at t = {at:.4g}, {note_on(said)}"

    return judge


def is_no_success(words: tuple) -> Callable:
    def judge(got):
        said = says(got, words)
        return got.code in (1, 3) and said, f"exit {got.code}, {note_on(said)}"

    return judge


def ends_at(state, error: float) -> Callable:
    def judge(got):
        if not got.solved:
            return False, got.outcome()
        apart = float(np.abs(got.state - np.asarray(state)).max())
        return apart <= error, f"error {apart:.1e}"

    return judge


def is_right_or_says_so(state, error: float, words: tuple) -> Callable:
    """Right: a small error with exit 0, or one of the sentences, with exit 0 or 1."""

    def judge(got):
        apart = float(np.abs(got.state - np.asarray(state)).max()) if got.state is not None else np.inf
        said = says(got, words)
        right = got.code in (0, 1) and (said or (got.code == 0 and apart <= error))
        return right, f"exit {got.code}, error {apart:.1e}, {'a note' if said else 'no note'}"

    return judge


def decays(gamma: float, error: float | None, words: tuple = ("take a smaller h",)) -> Callable:
    """Oscillators much faster than γ, all damped alike, lose e^{−γt} of H, but for γ/ω of it.

    Right: exit 1 or 2 with one of the sentences; or exit 0, where H never rises, is nowhere further from the exact one than `error`, or says so, and falls no
    faster than any solution can: dH/dt = −γ∫v² ≥ −2γH. Without `error`, for methods that split the damping from oscillations they do not resolve, the bounds
    are all that is asked.
    """

    def judge(got):
        said = says(got, words)
        if got.code in (1, 2):
            return said, f"exit {got.code}, {note_on(said)}"
        if got.code != 0 or len(got.energies.get("H", [])) < 3:
            return False, got.outcome() if got.code else "no energies"
        t, H = got.energies["t"], got.energies["H"]
        kept = got.energies.get("H_modified", H)
        rise = max(float((np.diff(kept) / np.abs(kept[0])).max()), 0.0)
        exact = H[0] * np.exp(-gamma * t)
        apart = float((np.abs(H - exact) / exact).max())
        slow = bool((H[1:] >= H[:-1] * np.exp(-2 * gamma * np.diff(t)) * (1 - 1e-12)).all()) and H[-1] > 0
        near = error is None or apart <= error or said
        note = ", a note" if error is not None and apart > error and said else ""
        shown = f"exit 0, H rises by {rise:.0e} of itself, is {apart:.0e} off{note}" + ("" if slow else ", and falls too fast")
        return rise <= 1e-12 and slow and near, shown

    return judge


SPLIT = ("seisav", "seilm", "savf")  # their decay is that of the averages over a step, which oscillations are not resolved by
WITHIN = "H = H(0)e^(−γt) within 1e-6, or a note; exit 1 or 2 with a word"
BOUNDED = "no rise, no faster fall than e^(−2γt); exit 1 or 2 with a word"
ILL = ("the solution blows up", "a blow-up, of the solution or of the method", "no solution was found", "the directed multiplier was not found")
DRAG_WORDS = ("h does not resolve the nonlinear part, and errors may be large", "the collocation equations were not solved in the step")
SPLIT_WORDS = ("splits the damping from the forces", "no solution was found, because the result of the Runge–Kutta–Nyström splitting is not finite")


@dataclass(frozen=True)
class Ending:
    name: str
    problem: str
    method: dict
    end: float
    expected: str
    judge: Callable
    backend: str = "auto"


def endings() -> list[Ending]:
    found = []
    for name in ("seisav", "seilm", "eisav", "egc4", "egc6", "auto"):
        method = {"name": name, "tolerance": 1e-3}
        found.append(Ending("blow-up, cubic", BLOW_UP, method, 8.0, f"exit 1 near t = {BLOWS_UP_AT:g}, with a word", is_failure_near(BLOWS_UP_AT, ("blows up",))))
    for name in ("seisav", "egc4", "egc6", "crkn6", "etdrk4", "seidm"):
        found.append(Ending("blow-up, quartic", QUARTIC_WELL, {"name": name, "h": 1 / 64}, 10.0, "exit 1 or 3, with a word", is_no_success(ILL)))
    for end in (1e4, 1e8, 1e15):
        for name in ("auto", "egc6"):
            method = {"name": name, "tolerance": 1e-6}
            found.append(Ending(f"decay to t = {end:g}", DECAY, method, end, "0 within 1e-4", ends_at(np.zeros(2), 1e-4)))
    b, r = damped(1.0, 0.125, 1.0, 0.0, 10.0)
    for name in ("egc4", "egc6", "auto", "seisav"):
        method = {"name": name, "tolerance": 1e-7}
        found.append(Ending("rates 1e7 : 1", APART, method, 10.0, "error ≤ 1e-5", ends_at([0, b, 0, r], 1e-5)))
    for length in (1e-5, 1e-6, 1e-8):
        for backend in ("dense", "modal"):
            for name in ("seisav", "seilm", "eisav", "crkn6", "egc6", "strang_exact", "chin4", "savf"):
                error = None if name in SPLIT else 1e-6
                found.append(
                    Ending(
                        f"waves on a length of {length:g}",
                        short_wave(length),
                        {"name": name, "h": 1 / 8},
                        2.0,
                        WITHIN if error else BOUNDED,
                        decays(0.1, error),
                        backend,
                    )
                )
    for name in ("seisav", "egc4"):
        found.append(Ending("hω = 1e6, sparse", STIFF_PAIR, {"name": name, "h": 0.1}, 1.0, WITHIN if name == "egc4" else BOUNDED, decays(0.1, 1e-6 if name == "egc4" else None), "sparse"))
    for law in ("interval", "guard", "none"):
        for name in ("egc4", "egc6"):
            method = {"name": name, "h": 0.1, "law": law}
            found.append(Ending(f"cubic drag, {law}", CUBIC_DRAG, method, 1.0, "error ≤ 1e-4, or a note", is_right_or_says_so(DRAGGED, 1e-4, DRAG_WORDS)))
    overdamped = reference.load()["overdamped"]["states"][-1]
    for name in ("seisav", "seavf", "seilm", "ssav", "strang_exact", "crkn6", "chin4"):
        found.append(Ending("splitting at γh = 100", OVERDAMPED, {"name": name, "h": 0.1}, 10.0, "error ≤ 1e-2, or a note", is_right_or_says_so(overdamped, 1e-2, SPLIT_WORDS)))
    return found


ENDINGS = endings()


def tasks(systems, methods, quick):
    return [(i, None) for i in range(len(ENDINGS))]


def judge(index, _, reference=None) -> list[Row]:
    e = ENDINGS[index]
    backend = {} if e.backend == "auto" else {"name": e.backend}
    case = program.case_text(e.problem, e.method, e.end, output={"energy_every": 10**9} if "tolerance" in e.method else None, backend=backend)
    got = program.run(case, quiet="note" not in e.expected)
    if got.code == -1:
        return [row(e.name, e.method["name"], "ending", e.expected, got.outcome(), False, case)]
    right, shown = e.judge(got)
    return [row(e.name, f"{e.method['name']}{'' if e.backend == 'auto' else ', ' + e.backend}", "ending", e.expected, shown, right, case, got.said)]
