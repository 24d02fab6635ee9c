"""What a run leaves."""

from __future__ import annotations

import contextlib
import contextvars
import json
import logging
import os
import textwrap
import warnings
from typing import TYPE_CHECKING, Any, Iterator, NamedTuple, Sequence

import numpy as np

from . import _core
from ._problem import real_array
from ._types import Array, File

if TYPE_CHECKING:
    import xarray

    from ._problem import Case, Problem
    from ._progress import Report
    from ._run import CaseRun


class SeicheWarning(UserWarning):
    """A computation came to its end, and what it left may be inaccurate: steps were replaced, or H went where no solution takes it."""


_LOG = logging.getLogger("seiche")
_is_quiet = contextvars.ContextVar("_is_quiet", default=False)


def say(notes: Sequence[str], remarks: Sequence[str], stacklevel: int = 3) -> None:
    """What there is to know of a run goes to the log, and what may make it inaccurate is a warning."""
    if _is_quiet.get():
        return
    for note in notes:
        _LOG.info("%s", note)
    for remark in remarks:
        warnings.warn(remark, SeicheWarning, stacklevel=stacklevel)


@contextlib.contextmanager
def quietly() -> Iterator[None]:
    """Of runs that are only tried nothing is said."""
    token = _is_quiet.set(True)
    try:
        yield
    finally:
        _is_quiet.reset(token)


class Status(int):
    """How a run ended: SciPy's number, which also equals the word for it.

    −1 "failed", 0 "success", 1 "event" (an event ended the run), 2 "interrupted". It is no key of a dictionary or a set,
    since no hash agrees with both: there take ``status.word``, or ``int(status)``.
    """

    _words = {-1: "failed", 0: "success", 1: "event", 2: "interrupted"}

    @property
    def word(self) -> str:
        return self._words[int(self)]

    def __eq__(self, other: object) -> bool:
        return self.word == other if isinstance(other, str) else int(self) == other

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        raise TypeError("a status equals a number and a word, and has no hash: take status.word, or int(status)")

    def __str__(self) -> str:
        return self.word

    def __repr__(self) -> str:
        return f"{int(self)} ({self.word})"


class DenseOutput:
    """The solution at any time of a run: ``sol(t)``, of shape (size,), or (size, len(t)) for an array of times.

    Each time is a step of the method, or a part of one, and no interpolation of the states beside it. At the time of an
    event it is the state behind it.
    """

    def __init__(self, solution: _core.Solution):
        self._solution = solution
        self.t_min, self.t_max = solution.sol_span

    def __call__(self, t: Any) -> Array:
        times = real_array("t", t)
        if times.ndim > 1:
            raise ValueError(f"t has the shape {times.shape}; it must be a number or a list of them")
        order = np.argsort(times.ravel(), kind="stable")  # times inside one step, one after the other, cost one step
        values = np.empty((times.size, self._solution.size))
        values[order] = self._solution.at(times.ravel()[order])
        found: Array = values[0] if times.ndim == 0 else values.T
        return found

    def __reduce__(self) -> Any:
        raise TypeError("a dense output lives in one process: evaluate sol at the times that are needed, or solve without it")


class Answer(dict[str, Any]):
    """What a computation leaves; keys are attributes too."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"a result has no {name!r}; it has {', '.join(self)}") from None

    __setattr__ = dict.__setitem__
    __delattr__ = dict.__delitem__

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]

    def __repr__(self) -> str:
        width = max(map(len, self), default=0)

        def shown(value: Any) -> str:
            if isinstance(value, np.ndarray):
                return f"array of shape {value.shape}"
            text = repr(value)
            if isinstance(value, str):  # a sentence is whole, in as many lines as it takes
                lines = textwrap.wrap(text, 100, break_long_words=False, break_on_hyphens=False)
                return f"\n{'':{width + 2}}".join(lines)
            return text if len(text) <= 100 else text[:99] + "…"

        return "\n".join(f"{key:>{width}}: {shown(value)}" for key, value in self.items())


    def _repr_html_(self) -> str:
        """The same as a table, for notebooks."""
        import html

        rows = (line.partition(": ")[::2] for line in repr(self).replace("\n" + " " * (max(map(len, self), default=0) + 2), " ").splitlines())
        cells = "".join(f"<tr><th>{key.strip()}</th><td style='text-align:left'>{html.escape(value)}</td></tr>" for key, value in rows)
        return f"<table>{cells}</table>"


def field_of(states: Array, problem: "Problem", name: str) -> Array:
    """One field of states, (count, size), on the grid: of shape (count, points along each axis); a view."""
    names = problem.fields
    if name not in names:
        raise ValueError(f"{problem.name} has no field {name!r}; it has {', '.join(names)}")
    return states.reshape(len(states), len(names), *problem.shape)[:, names.index(name)]


def about_it(meaning: str) -> dict[str, str]:
    """The attributes of an array, as solution.h5 has them."""
    return {"long_name": meaning, "units": "1"}  # an equation has units of its own


def coordinates_of(problem: "Problem") -> dict[str, tuple[Any, ...]]:
    """The places of the grid, as coordinates of an `xarray.Dataset`."""
    return {
        name: (name, values.astype(int) if name == "point" else values, about_it(meaning))
        for (name, meaning), values in zip(problem._core.layout["axes"], problem.axes)
    }


class Asked(NamedTuple):
    """What a run was asked for, to repeat it."""

    problem: "Problem | Case"
    options: dict[str, Any]  # of `run_case`
    start: float
    z0: Any
    t_eval: Array | None
    record_every: int


class Result(Answer):
    """The solution and its energies, in the manner of ``scipy.integrate.solve_ivp``; keys are attributes too.

    Attributes
    ----------
    t : (times,) array
        Recorded times.
    y : (size, times) array
        States: y[:, k] is z at t[k], field after field. A view of the memory that the run wrote.
    energy : (times,) array
        H(z), summed over points without a factor Δx.
    modified_energy : (times,) array or None
        The energy that the method keeps a law for, where it is another than H.
    success : bool
        Did the run reach its end, or an event that ends it?
    status : Status
        0 success, 1 an event ended the run, −1 failed, 2 interrupted; also equal to these words.
    message : str
        One sentence: how the run ended, and what one should know.
    law : str
        "holds", "violated" or "not promised": the verdict on the energy law over the recorded steps.
    certificate : dict
        The hypotheses of the law, how each is known, and what they promise.
    report : dict
        What the program writes to summary.json.
    sol : DenseOutput or None
        The solution at any time, ``sol(t)``. It is None unless `solve` was called with ``dense_output=True``; where the times
        are known beforehand, ``t_eval`` gives their states without it.
    t_events, y_events : list of arrays, or None
        For each event its times, and the states then, of shape (times, size), before its action.
    ledger : dict of (times,) arrays, or None
        With ``ledger=True``: where the change of H since the start comes from.
    nfev : int
        Evaluations of ∇V.
    steps : int
    method, backend : str
        As taken.
    notes : list of str
        What the case, the problem and the choice of the method have to say.
    problem : Problem
    """

    def field(self, name: str) -> Array:
        """One field on the grid, of shape (times, points along each axis); a view of y."""
        return field_of(self.y.T, self.problem, name)

    def gathered(self) -> "Result | None":
        """Of a run of several processes (``comm``): the result on the whole grid, on the first process; None on the others.

        All of them make this call. Of a run of one process it is the result itself.
        """
        if self._shared is None:
            return self
        comm, problem = self._shared
        parts = comm.gather([self.y.T, *(self.y_events or [])])
        if parts is None:
            return None

        def joined(states: Sequence[Array]) -> Array:  # (times, size) of each process
            count = len(states[0])
            planes = [part.reshape(count, len(problem.fields), -1, *problem.shape[1:]) for part in states]
            return np.concatenate(planes, axis=2).reshape(count, -1)

        y, *y_events = map(joined, zip(*parts))
        whole = Result(self)
        whole.update(y=y.T, problem=problem, y_events=y_events if self.y_events is not None else None)
        object.__setattr__(whole, "_asked", self._asked)
        object.__setattr__(whole, "_shared", None)
        return whole

    def save(self, folder: File, progress: bool | Report = False) -> "CaseRun":
        """Leave the folder that ``seiche run`` leaves, for ``seiche audit``, ``plot`` and ``resume``.

        The run is repeated there, from the case file that says the same: it takes as long as it took. What comes out is
        compared with this result and must be the same to the bit. States are recorded as here; or, where ``t_eval`` is no
        even sequence of steps, as case files do by default, and with a tolerance at every step. ``z0`` goes into a file
        initial.txt beside the case; a file that is there keeps its name, and the new one becomes initial_2.txt.

        Parameters
        ----------
        folder : path
        progress : bool or function
            As of `seiche.run`.

        Returns
        -------
        CaseRun

        Raises
        ------
        ValueError
            Where no case file can say this run: of Python functions, events, a problem by its parts, a run that did not
            reach its end or began before t = 0. Or where the folder has files of others.
        RuntimeError
            Where what comes out differs from this result: nothing is kept.
        """
        from ._run import save

        return save(self, folder, progress)

    def to_xarray(self) -> "xarray.Dataset":
        """The fields on their grid and the energies as an `xarray.Dataset`.

        Names, dimensions, and the attributes long_name and units, are those of solution.h5: points without a grid have the dimension
        "point", a single one has none.
        """
        import xarray

        layout = self.problem._core.layout
        names = [name for name, _ in layout["axes"]]
        coordinates = {"t": ("t", self.t, about_it("time"))} | coordinates_of(self.problem)
        shape = (len(self.t), *(self.problem.shape if names else ()))
        data: dict[str, tuple[Any, ...]] = {
            shown: (("t", *names), self.field(name).reshape(shape), about_it(meaning))
            for name, (shown, meaning) in zip(self.problem.fields, layout["fields"])
        }
        data["H"] = ("t", self.energy, about_it("energy H = ½zᵀMz + V(z), summed over points"))
        if self.modified_energy is not None:
            data["H_modified"] = ("t", self.modified_energy, about_it("modified energy, whose law the method keeps"))
        about = {key: self[key] for key in ("method", "backend", "message", "law", "steps")}
        about.update(problem=self.problem.name, status=self.status.word)
        return xarray.Dataset(data, coords=coordinates, attrs=about)


def result_of(
    solution: _core.Solution, problem: "Problem", *, notes: list[str], has_events: bool, has_ledger: bool
) -> Result:
    number = {"success": 1 if solution.ended_by_event else 0, "failed": -1, "interrupted": 2}[solution.status]
    return Result(
        t=solution.t,
        y=solution.y,
        energy=solution.H,
        modified_energy=solution.modified,
        success=solution.status == "success",
        status=Status(number),
        message=solution.message,
        law=solution.law,
        sol=DenseOutput(solution) if solution.has_sol else None,
        t_events=solution.t_events if has_events else None,
        y_events=solution.y_events if has_events else None,
        ledger=solution.ledger if has_ledger else None,
        nfev=solution.nfev,
        steps=solution.steps,
        method=solution.method,
        backend=solution.backend,
        certificate=json.loads(solution.certificate_json()),
        report=json.loads(solution.report_json()),
        notes=notes,
        problem=problem,
    )
