"""Steps of one's own."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np

from . import _core
from ._problem import Case, Problem, as_problem, real_array, require_start, run_case, thread_count, whole_number
from ._result import SeicheWarning, field_of
from ._types import Array, ArrayLike, Backend, Method, ProblemName


class StepError(ArithmeticError):
    """A step found no solution. The simulation is where it was before that step."""


class Simulation:
    """A problem and a method, moved step by step: for loops of one's own, control and couplings.

    Parameters
    ----------
    problem : Problem, Case or str
        What `seiche.problem`, `seiche.load` or `seiche.Problem` made, or a name.
    method : str
        One of `seiche.methods()`; by default "seisav", or that of the case.
    z0 : (size,) array
        The state at the start, of any shape with so many numbers; by default that of the problem.
    t : float
        The time at the start.
    backend : str
        One of `seiche.backends()`; by default "auto".
    threads : int
        For large grids. Results do not depend on it.
    **options
        C, auxiliary, scalar_solver, predictor, law, linear, plan, exponential, as of `solve`.

    Raises
    ------
    ValueError
        For what makes no sense, in one sentence.
    """

    def __init__(
        self, problem: Problem | Case | ProblemName, method: Method | None = None, z0: ArrayLike | None = None, t: float = 0.0, *,
        backend: Backend | None = None, threads: int = 1, **options: Any,
    ):  # fmt: skip
        for name in ("h", "tolerance", "t_span", "t_eval", "events", "observer"):
            if name in options:
                raise ValueError(f"{name} is no argument of a simulation: " + ("give h to step" if name == "h" else "seiche.solve takes it"))
        given = as_problem(problem) if isinstance(problem, str) else problem
        self.problem = as_problem(given)
        if z0 is None:
            require_start(self.problem, "seiche.Simulation")
        case = run_case(given, {"t_start": 0.0, "t_end": 1.0, "h": 1.0, "energy_every": 1, "method": method, "backend": backend} | options)
        if case.method == "auto":
            raise ValueError("method = 'auto' chooses by the length of a run and its tolerance, which a simulation does not know: name one")
        start = None if z0 is None else self._state("z0", z0)
        self._core = _core.Simulation(self.problem._core, case, start, self._time(t), thread_count(threads))

    def _state(self, name: str, values: Any) -> Array:
        state = real_array(name, values).ravel()
        if state.size != self.problem.size:
            raise ValueError(f"{name} has {state.size} numbers; a state of {self.problem.name} has {self.problem.size}")
        if not np.isfinite(state).all():
            raise ValueError(f"{name} holds a value that is no finite number")
        return state

    @staticmethod
    def _time(t: Any) -> float:
        time = float(t)
        if not math.isfinite(time):
            raise ValueError(f"t = {time} must be a finite number")
        return time

    def step(self, h: float, count: int = 1) -> "Simulation":
        """Take `count` steps of the size h. Returns the simulation.

        Raises
        ------
        StepError
            Where a step finds no solution: the state is then that before it.
        """
        size = float(h)
        if not (math.isfinite(size) and size > 0):
            raise ValueError(f"h = {size:g} must be > 0: damping cannot be followed backwards")
        replaced = self._core.replaced
        failure = self._core.step(size, whole_number("count", count))
        if failure:
            raise StepError(failure)
        if self._core.replaced > replaced:
            warnings.warn(f"{self._core.replaced - replaced} steps were replaced by the linear flow", SeicheWarning, stacklevel=2)
        return self

    def set_state(self, y: Any, t: float | None = None) -> None:
        """Go on from another state, and perhaps another time. What the method remembers of the steps before is forgotten."""
        self._core.set_state(self._state("y", y), self.t if t is None else self._time(t))

    def field(self, name: str) -> Array:
        """One field on the grid, of shape (points along each axis)."""
        first: Array = field_of(self.y[np.newaxis], self.problem, name)[0]
        return first

    @property
    def t(self) -> float:
        return self._core.t

    @property
    def y(self) -> Array:
        """(size,) the state, a copy."""
        return self._core.y

    @property
    def energy(self) -> float:
        """H(y)."""
        return self._core.H

    @property
    def modified_energy(self) -> float:
        """The energy that the method keeps a law for; equal to `energy` where it has none of its own."""
        return self._core.modified

    @property
    def steps(self) -> int:
        """Steps taken since the start, or since `set_state`."""
        return self._core.steps

    @property
    def method(self) -> str:
        return self._core.method

    @property
    def backend(self) -> str:
        return self._core.backend

    def __repr__(self) -> str:
        return f"<seiche.Simulation {self.problem.name} by {self.method} at t = {self.t:g}, H = {self.energy:.6g}>"
