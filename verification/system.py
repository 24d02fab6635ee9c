"""What one system of the suite is: the equation as a user writes it for Seiche, and once more as a plain right-hand side."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Callable

import numpy as np

RightHandSide = Callable[[float, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class System:
    name: str
    problem: str  # the section [problem] of a case file, without its header
    rhs: RightHandSide  # ż = rhs(t, z), written apart from the above
    z0: np.ndarray
    end: float
    steps: tuple[float, ...] = ()  # for observed orders, falling; none: the system has no asymptotic range
    gross: tuple[float, ...] = ()  # steps that resolve neither layers nor fast oscillations, for laws against each other
    law: str = "falls"  # what the exact H does: "falls", or "free" where it may rise
    bounded: bool = True  # is H bounded below? If not, a solution may leave every bound
    stiff: bool = False  # SciPy's witness is Radau instead of DOP853
    analytic: bool = True  # complex steps through rhs give its Jacobian
    exact: Callable[[float], np.ndarray] | None = None  # a closed form
    breaks: tuple[float, ...] = ()  # times where rhs jumps
    gain: float | None = None  # instead of the computed one, where units differ among the components
    limits: dict[str, float] = field(default_factory=dict)  # method → order that the system allows, where less than declared
    tolerances: tuple[float, ...] = (1e-4, 1e-6, 1e-8)
    files: dict[str, str] = field(default_factory=dict)  # name → text, beside the case file
    slope: float = 1.0  # the steepest V of an angle: what round-off in the angle makes of H
    quick: bool = False  # part of the quick run
    about: str = ""


def canonical(force: Callable, damping: Callable, velocity: Callable = lambda p: p) -> RightHandSide:
    """q̇ = velocity(p), ṗ = force(q) − damping(t, p), halves of z."""

    def rhs(t: float, z: np.ndarray) -> np.ndarray:
        n = z.size // 2
        q, p = z[:n], z[n:]
        return np.concatenate([velocity(p), force(q) - damping(t, p)])

    return rhs
