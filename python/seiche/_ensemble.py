"""Many members of one small problem."""

from __future__ import annotations

from typing import Any, Sequence

import numpy as np

from . import _core
from ._problem import Case, Problem, as_problem, real_array, refuse_other_names, run_case, thread_count
from ._result import Result
from ._solve import _span


class EnsembleResult(Result):
    """What an ensemble leaves.

    Attributes
    ----------
    t : (times,) array
        Times of the statistics.
    y : (members, size) array
        The last good state of every member.
    energy, modified_energy : dict of (times,) arrays
        mean, std, min, q05, median, q95 and max over the members that run.
    final_energy : (members,) array
        H of every member at its end.
    status, message, law : list of str
        Of every member.
    success : bool
        Did all members reach the end?
    parameters : dict of (members,) arrays
        What differs between the members of a case.
    running : (times,) array
        How many members still run.
    """


def solve_ensemble(
    problem: Problem | Case | str | Sequence[Problem],
    t_span: float | None = None,
    z0: Any = None,
    method: str | None = None,
    *,
    h: float | str | None = None,
    backend: str | None = None,
    threads: int = 1,
    **options: Any,
) -> EnsembleResult:
    """Integrates many initial states, or many problems, side by side from t = 0, with steps of one size.

    Parameters
    ----------
    problem : Case, Problem or list of Problem
        A case with a section [ensemble]; or one problem with the states of all members in z0; or one problem for
        each member, all of one size.
    z0 : (members, size) array
        The states at the start; by default those of the problems.

    The other parameters are those of `seiche.solve`. A member that fails stops with its message, and the others go on.
    """
    refuse_other_names(options)
    several = isinstance(problem, (list, tuple))
    given = problem if isinstance(problem, Case) else as_problem(problem[0] if several else problem)
    default_end = given.t_end if isinstance(given, Case) else run_case(given, {}).t_end if given._text else None
    start, end = _span(t_span, default_end)
    if start != 0:
        raise ValueError(f"t_span = ({start:g}, {end:g}): an ensemble starts at t = 0")
    case = run_case(given, {"t_end": end, "method": method, "backend": backend, "h": h} | options)
    if z0 is None and isinstance(given, Case) and case.is_ensemble:
        held = _core.ensemble_of_case(case, thread_count(threads))
    else:
        problems = [as_problem(p) for p in problem] if several else [as_problem(given)]
        states = [p.z0 for p in problems] if z0 is None else list(np.atleast_2d(real_array("z0", z0)))
        if several and len(states) != len(problems):
            raise ValueError(f"z0 has {len(states)} rows for {len(problems)} problems")
        held = _core.ensemble_of_problems([p._core for p in problems], states, case, thread_count(threads))
    has_modified = any(m["name"] == case.method and m["law"] == "H_modified" for m in _core.methods())
    return EnsembleResult(
        t=held.t,
        y=held.y,
        energy=held.H,
        modified_energy=held.modified if has_modified else None,
        final_energy=np.array(held.energy),
        success=all(status == "success" for status in held.status),
        status=held.status,
        message=held.message,
        law=held.law,
        running=held.running,
        parameters=held.parameters,
        in_lanes=held.in_lanes,
        wall_seconds=held.wall_seconds,
        method=case.method,
        problem=as_problem(given),
    )
