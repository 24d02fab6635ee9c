"""Questions about a problem and a method, as the program answers them."""

from __future__ import annotations

import json
from typing import Any, Sequence

from . import _core
from ._problem import Case, Problem, as_problem, run_case


def _case(problem: Problem | Case, values: dict[str, Any]) -> _core.Case:
    given = as_problem(problem) if isinstance(problem, str) else problem
    if not isinstance(given, Case) and given._text is None and values.get("h") is None and not values.get("tolerance"):
        values = values | {"h": values.get("t_end") or 1.0}  # the question is not about a step size
    return run_case(given, values)


def check(
    problem: Problem | Case | str, t_end: float | None = None, method: str | None = None, **options: Any
) -> dict[str, Any]:
    """Which hypotheses of the energy law hold up to t_end, how each is known, and which law they promise.

    Returns {"hypotheses": [{"name", "grade", "statement", …}], "law": {"promised", "reason", …}}.
    """
    return json.loads(_core.check(as_problem(problem)._core, _case(problem, {"t_end": t_end, "method": method} | options)))


def spectrum(
    problem: Problem | Case | str, method: str | None = None, h: float | str | None = None, **options: Any
) -> dict[str, Any]:
    """Is the damping physical? Decay and frequency that one step gives each mode of the linear part, and the exact ones.

    Returns the document of ``seiche spectrum --json``.
    """
    return json.loads(_core.spectrum(as_problem(problem)._core, _case(problem, {"method": method, "h": h} | options)))


def converge(
    problem: Problem | Case | str,
    methods: Sequence[str],
    h: Sequence[float],
    t_end: float | None = None,
    timed: bool = True,
    **options: Any,
) -> dict[str, Any]:
    """Errors, orders, energy errors and cost of methods at several step sizes, against a tight reference.

    Returns the document of ``seiche converge --json``; its "rows" make a table.
    """
    case = _case(problem, {"t_end": t_end} | options)
    return json.loads(
        _core.converge(as_problem(problem)._core, list(methods), [float(step) for step in h], case, timed)
    )
