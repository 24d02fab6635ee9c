"""Questions about a problem and a method, as the program answers them."""

from __future__ import annotations

import json
from typing import Any, Sequence

import numpy as np

from . import _core
from ._problem import Case, Problem, as_problem, require_start, run_case
from ._types import Method, ProblemName, Size


def _given(problem: Problem | Case | ProblemName) -> Problem | Case:
    return problem if isinstance(problem, Case) else as_problem(problem)


def _followed(given: Problem | Case, t_end: Any, options: dict[str, Any]) -> dict[str, Any]:
    """The keys of a study along a solution, which needs a start and an end. It asks for no step size of its own."""
    values = {"t_end": t_end, "energy_every": 10**12} | options  # no file is written, whose size the parser would guard
    if isinstance(given, Case) or given._text is not None:
        require_start(as_problem(given))
        return values
    if t_end is None:
        raise ValueError("t_end is missing: give the end of the time that is looked at")
    require_start(given)
    return {"h": t_end} | values


def check(
    problem: Problem | Case | ProblemName, t_end: float | None = None, method: Method | None = None, **options: Any
) -> dict[str, Any]:
    """Which hypotheses of the energy law hold up to t_end, how each is known, and which law they promise.

    By default t_end is that of the case, or of the problem's example; a problem by parts has none. Ctrl-C is answered between
    two hypotheses: one that is verified by a factorisation is finished first.

    Returns these parts of the document of ``seiche check --json``:
    {"hypotheses": [{"hypothesis", "grade", "statement", "margin", "witness"}, …], "law": {"promised", "reason", "theorem"}}.
    """
    given = _given(problem)
    case = run_case(given, _followed(given, t_end, {"method": method} | options))
    return dict(json.loads(_core.check(as_problem(given)._core, case)))


def spectrum(
    problem: Problem | Case | ProblemName, method: Method | None = None, h: Size | None = None, **options: Any
) -> dict[str, Any]:
    """Is the damping physical? Decay and frequency that one step gives each mode of the linear part, and the exact ones.

    By default h is that of the case, or of the problem's example; a problem by parts has none. Ctrl-C is answered between two
    modes: the eigenvectors of a full matrix are finished first.

    Returns the document of ``seiche spectrum --json``.
    """
    given = _given(problem)
    if isinstance(given, Problem) and given._text is None and h is None:
        raise ValueError('h is missing, and spectrum looks at one step: give h, such as "1/64"')
    return dict(json.loads(_core.spectrum(as_problem(given)._core, run_case(given, {"method": method, "h": h} | options))))


def converge(
    problem: Problem | Case | ProblemName,
    methods: Method | Sequence[Method],
    h: float | str | Sequence[float | str],
    t_end: float | None = None,
    timed: bool = True,
    **options: Any,
) -> dict[str, Any]:
    """Errors, orders, energy errors and cost of methods at several step sizes, against a tight reference.

    Fractions may be texts: ["1/32", "1/64"]. By default t_end is that of the case, or of the problem's example; a problem by parts
    has none. Ctrl-C ends the study within a step.

    Returns the document of ``seiche converge --json``; its "rows" make a table.
    """
    given = _given(problem)
    names: list[str] = [methods] if isinstance(methods, str) else list(methods)
    sizes = [h] if isinstance(h, (str, float, int)) or np.ndim(h) == 0 else list(h)
    values = _followed(given, t_end, options)
    case = run_case(given, values)
    steps = [run_case(given, values | {"h": size, "tolerance": None}).h for size in sizes]  # read as everywhere
    return dict(json.loads(_core.converge(as_problem(given)._core, names, steps, case, timed)))
