"""References at four times of each run: computed by different integrators, and kept with the distances between them.

`error` is that between collocation of two orders, or between collocation and a closed form; `scipy` that of an integrator of SciPy, which
is the least accurate of them. Both are relative to the largest component of the initial state.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from .collocation import Radau, jacobian
from .system import System

STORE = Path(__file__).with_name("references.json")


def fingerprint(system: System) -> str:
    """Changes with the right-hand side, the initial state and the time, so that a stored reference cannot be of another system."""
    n = system.z0.size
    state = system.z0 * (1 + 0.01 * np.cos(np.arange(n))) + 0.01 * np.sin(1 + np.arange(n)) * np.abs(system.z0).max()
    seen = system.rhs(0.37 * system.end, state)
    weights = np.cos(1 + 0.7 * np.arange(n))
    return f"{n} {system.end:.6e} {weights @ system.z0:.6e} {weights @ seen:.6e}"


def times(system: System) -> list[float]:
    return [system.end * k / 4 for k in (1, 2, 3, 4)]


def pieces(system: System):
    """(start, end, rhs, kept) between times that are kept or where rhs jumps; rhs is never asked at the latter themselves."""
    kept = times(system)
    ends = sorted({0.0, *system.breaks, *kept})
    for a, b in zip(ends, ends[1:]):
        inside = 1e-13 * (b - a) if system.breaks else 0.0
        yield a, b, lambda t, z, a=a, b=b, e=inside: system.rhs(min(max(t, a + e), b - e), z), b in kept


def by_collocation(system: System, stages: int, tolerance: float) -> np.ndarray:
    z, states = system.z0, []
    first = system.end * (1e-9 if system.stiff else 1e-3)
    for start, end, rhs, kept in pieces(system):
        z = Radau(rhs, stages, system.analytic).integrate(start, end, z, tolerance, first)
        states += [z] if kept else []
    return np.array(states)


def by_scipy(system: System) -> np.ndarray:
    z, states = system.z0, []
    for start, end, rhs, kept in pieces(system):
        options = (
            {"method": "Radau", "jac": lambda t, z: jacobian(rhs, t, z, system.analytic), "rtol": 1e-10, "atol": 1e-13}
            if system.stiff
            else {"method": "DOP853", "rtol": 3e-14, "atol": 1e-15}
        )
        z = solve_ivp(rhs, (start, end), z, **options).y[:, -1]
        states += [z] if kept else []
    return np.array(states)


def gain(system: System, intervals: int = 240) -> float:
    """max over the kept times T of ∫₀ᵀ ‖∂z(T)/∂z(t)‖∞ dt: what an error of one per unit of time amounts to."""
    solution = solve_ivp(
        system.rhs, (0, system.end), system.z0, method="Radau" if system.stiff else "DOP853", rtol=1e-6, atol=1e-9, dense_output=True
    ).sol
    dt = system.end / intervals
    flows = [expm(jacobian(system.rhs, t, solution(t), system.analytic) * dt) for t in dt * (0.5 + np.arange(intervals))]
    largest = 0.0
    for last in (intervals // 4, intervals // 2, 3 * intervals // 4, intervals):
        product, total = np.eye(system.z0.size), 0.0
        for flow in reversed(flows[:last]):
            total += dt * np.abs(product).sum(axis=1).max()
            product = product @ flow
        largest = max(largest, total)
    return largest


def make(system: System) -> dict:
    states = by_collocation(system, 9, 1e-13)
    others = by_collocation(system, 7, 3e-14) if system.exact is None else states
    if system.exact is not None:
        states = np.array([system.exact(t) for t in times(system)], float)
    unit = np.abs(system.z0).max() or np.abs(states).max()  # from rest: of the largest state kept
    return {
        "fingerprint": fingerprint(system),
        "by": "a closed form" if system.exact is not None else "Radau IIA of order 17 and 13",
        "error": float(np.abs(states - others).max() / unit),
        "scipy": float(np.abs(states - by_scipy(system)).max() / unit),
        "gain": gain(system) if system.gain is None else system.gain,
        "times": times(system),
        "states": states.tolist(),
    }


def load() -> dict[str, dict]:
    return json.loads(STORE.read_text()) if STORE.exists() else {}


def store(references: dict[str, dict]) -> None:
    rows = [f"  {json.dumps(name)}: {json.dumps(row)}" for name, row in sorted(references.items())]
    STORE.write_text("{\n" + ",\n".join(rows) + "\n}\n")
