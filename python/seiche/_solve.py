"""One run."""

from __future__ import annotations

import copy
import numbers
import os
from typing import Any, Callable, Sequence

import numpy as np

from . import _core
from ._problem import Case, Problem, as_problem, real_array, refuse_other_names, require_start, run_case, thread_count, truth, whole_number
from ._progress import Report, showing
from ._result import Asked, Result, result_of, say
from ._types import Array, ArrayLike, Backend, File, Method, ProblemName, Size

Event = Callable[[float, Array], float]


def _span(t_span: Any, default_end: float | None, default_start: float = 0.0) -> tuple[float, float]:
    if t_span is None:
        if default_end is None:
            raise ValueError("t_span is missing: give the end of the run, or (start, end)")
        return default_start, default_end
    ends = np.atleast_1d(real_array("t_span", t_span))
    if ends.shape not in ((1,), (2,)):
        raise ValueError(f"t_span = {t_span!r} must be the end of the run, or (start, end)")
    start, end = [0.0, *ends][-2:]
    if not start < end:
        raise ValueError(f"t_span = ({start:g}, {end:g}) must ascend: damping cannot be followed backwards")
    return float(start), float(end)


def _event(function: Event) -> tuple[Any, ...]:
    """(g, direction, number that ends the run, action), from the attributes that SciPy looks for, and `action`."""
    if not callable(function):
        raise TypeError(f"an event is a function g(t, y), not {function!r}")
    direction, terminal = getattr(function, "direction", 0), getattr(function, "terminal", 0)
    if not isinstance(direction, numbers.Real) or direction != direction:
        raise ValueError(f"the direction of an event is {direction!r}; it must be a number: > 0 rising, < 0 falling, 0 both")
    if terminal is not None and not isinstance(terminal, (numbers.Integral, np.bool_)):
        raise ValueError(f"terminal of an event is {terminal!r}; it must be True, or the number of occurrences that end the run")
    return (
        function,
        int(np.sign(float(direction))),
        int(terminal or 0),
        getattr(function, "action", None),
    )


def _of_scipy(theirs: str, ours: str, value: Any, options: dict[str, Any]) -> Any:
    """What was given under our name or SciPy's, which `options` then has no more."""
    if theirs not in options:
        return value
    if value is not None:
        raise ValueError(f"{ours} and {theirs} are one argument: give one of them")
    return options.pop(theirs)


def _part(stated: Problem, case: Any, comm: Any, z0: Any) -> tuple[Problem, Any]:
    """The part of a problem that this process holds, and of a state of all of it."""
    rank, count = comm.Get_rank(), comm.Get_size()
    if len(stated.axes) < 2:
        raise ValueError(f"{stated.name} has no grid of two or three axes, and only one process computes it: solve it without comm")
    part = copy.copy(stated)
    part._core = stated._core.part(rank, count) if stated._text is None else _core.make_problem(case, rank, count)
    if z0 is None:
        return part, None
    state = real_array("z0", z0)
    if state.size != stated._core.size:  # these planes, or what the program refuses
        return part, state
    planes = comm.allgather(len(part.axes[0]))
    first = sum(planes[:rank])
    by_planes = state.reshape(len(stated.fields), sum(planes), -1)
    return part, np.ascontiguousarray(by_planes[:, first : first + planes[rank]])


def solve(
    problem: Problem | Case | ProblemName,
    t_span: float | Sequence[float] | None = None,
    z0: ArrayLike | None = None,
    method: Method | None = None,
    *,
    h: Size | None = None,
    tolerance: Size | None = None,
    h_max: Size | None = None,
    t_eval: ArrayLike | None = None,
    events: Event | Sequence[Event] | None = None,
    dense_output: bool = False,
    observer: Callable[[float, Array, float], Any] | None = None,
    record_every: int = 1,
    ledger: bool | None = None,
    backend: Backend | None = None,
    threads: int = 1,
    checkpoint: File | None = None,
    comm: Any = None,
    progress: bool | Report = False,
    **options: Any,
) -> Result:
    """Integrates a damped Hamiltonian system, in the manner of ``scipy.integrate.solve_ivp``.

    The GIL is released while it steps, and taken for Python functions. Ctrl-C ends the run after the current step, a
    second one inside a Python function at once, and what was computed is returned with the status "interrupted", its
    last state whatever ``t_eval`` asked for.

    Parameters
    ----------
    problem : Problem, Case or str
        What `seiche.problem`, `seiche.load` or `seiche.Problem` made, or a name.
    t_span : float or (float, float)
        The end of the run, or start and end; by default that of the case, or of the problem's example.
    z0 : (size,) array
        The state at the start, of any shape with so many numbers; by default that of the problem. Also as ``y0``.
    method : str
        One of `seiche.methods()`, or "auto"; by default "seisav", or that of the case.
    h : float or str
        Step size; fractions may be texts: "1/256". Beside a tolerance, the first one. By default that of the case, or
        of the problem's example, which `notes` of the result names; a problem by parts has none.
    tolerance : float
        Instead of h: steps of variable size, which add an error of at most about this size per unit of time (max norm). Where damping
        lets errors fade this is about the error at the end; without damping they add up.
    h_max : float
        With a tolerance: no step is longer. Also as ``max_step``.
    t_eval : (times,) array
        The times to record, ascending. They shorten no step but, with a tolerance, perhaps the first. By default all steps.
        A run that ends early also records where it did, whatever was asked for.
    events : function or list of functions
        ``g(t, y) -> float``; an event is a change of its sign from one step to the next. Attributes as in SciPy: ``direction`` (> 0 rising, < 0 falling),
        ``terminal`` (True, or the number of occurrences that end the run); and ``action(t, y)``, which may return a new state.
        As in SciPy, a zero at the start is an event too. The method starts anew behind an event. Two changes inside one step
        are not seen: where they may lie close, h_max keeps
        steps short.
    dense_output : bool
        Keep a state for every step, so that ``result.sol(t)`` is the solution at any time.
    observer : function
        ``observer(t, y, energy)`` after every record_every-th step; ``False`` ends the run.
    record_every : int
        Without t_eval: record every so many steps. The energy law is judged at these steps.
    ledger : bool
        Keep the books of the energy, step by step: ``result.ledger``. Not with t_eval.
    backend : str
        One of `seiche.backends()`; by default "auto".
    threads : int
        For large grids. Results do not depend on it.
    checkpoint : path
        A folder for checkpoints, of long runs: after 5, 10, 20 and 40 seconds and then every minute, and at Ctrl-C. The
        same call again, whatever ended the one before, goes on from the newest and ends with the same bits; t_span may
        then end later. They are gone when the run has come to its end. What a checkpoint has seen is not shown again:
        observers, actions and events are called for what comes behind it.
    comm : mpi4py.MPI.Comm
        Its processes hold a grid of two or three axes together, and make this call together: each one gets the planes of
        y, the axes of ``result.problem`` and the z of observers and events that it holds, and t and the energies of all.
        The numbers are those of one process to the last bit, on any number of them; ``result.gathered()`` brings them
        together. z0: of the whole grid or of these planes. An event function must return the same number on all processes.
    progress : bool or function
        True: a bar on stderr, with the time that is left. Or a function of (t, t_end, steps), called ten times a second at
        most, and at the end.
    **options
        C, auxiliary, scalar_solver, predictor, law, linear (of methods); plan, exponential, pade_degree,
        lanczos_dimension, solver (of backends); temperature, seed (of noise), with the values of case files.

    Returns
    -------
    Result

    Raises
    ------
    ValueError
        For what makes no sense, in one sentence. A computation that fails is a status of the result.

    Warns
    -----
    SeicheWarning
        Where steps were replaced, or H went where no solution takes it. ``message`` says so too.
    """
    z0, h_max = _of_scipy("y0", "z0", z0, options), _of_scipy("max_step", "h_max", h_max, options)
    refuse_other_names(options)
    given = as_problem(problem) if isinstance(problem, str) else problem
    if isinstance(given, Case) and given._core.is_ensemble:
        raise ValueError(f"{given._file} has a section [ensemble]: call seiche.solve_ensemble, or give its problem for one run")
    stated = as_problem(given)
    default_end = given.t_end if isinstance(given, Case) else None
    if default_end is None and stated._text is not None and t_span is None:
        default_end = run_case(stated, {}).t_end
    start, end = _span(t_span, default_end, given.t_start if isinstance(given, Case) else 0.0)
    looked_at = max(start, 0.0)  # cases begin at 0 or later
    if z0 is None:
        require_start(stated, "seiche.solve")
    options |= {
        "t_start": looked_at,
        "t_end": looked_at + (end - start),
        "method": method,
        "backend": backend,
        "h": h,
        "tolerance": tolerance,
        "h_max": h_max,
    }
    every = options.pop("energy_every", None)
    case = run_case(given, options | {"energy_every": 10**12 if every is None else every})  # no file whose size is guarded
    times = None if t_eval is None else np.atleast_1d(real_array("t_eval", t_eval))
    if times is not None and times.size == 0:
        raise ValueError("t_eval is empty: give the times to record, or leave it out to record the steps")
    if times is not None and not np.isfinite(times).all():
        raise ValueError("t_eval holds a time that is no finite number")
    functions = [] if events is None else list(events) if isinstance(events, (list, tuple)) else [events]
    with_ledger = case.ledger and times is None if ledger is None else ledger
    shared = comm if comm is not None and comm.Get_size() > 1 else None
    if shared is not None:
        if checkpoint is not None:
            raise ValueError("checkpoints of several processes are those of the program: mpiexec -n … seiche run case.toml")
        stated, z0 = _part(stated, case, shared, z0)
    with showing(progress if shared is None or shared.Get_rank() == 0 else False) as tell:
        solution = _core.solve(
            stated._core,
            case,
            start,
            end,
            None if z0 is None else real_array("z0", z0).ravel(),
            times,
            [_event(function) for function in functions],
            truth("dense_output", dense_output),
            observer,
            whole_number("record_every", record_every),
            truth("ledger", with_ledger),
            thread_count(threads),
            None if checkpoint is None else os.fspath(checkpoint),
            tell,
            None if shared is None else shared.py2f(),
        )
        if tell is not None:
            has_reached = solution.status == "success" and not solution.ended_by_event
            tell(end if has_reached else float(solution.t[-1]), end, solution.steps)
    notes = [*case.notes, *stated.notes]
    if case.h_is_default:
        notes.insert(0, f"h is not given: steps of {case.h:g}, as in the problem's example")
    notes += solution.notes
    if solution.method_reason:
        notes.append(f'method = "auto": {solution.method_reason}')
    say([*notes, f"{stated.name} by {solution.method}: {solution.message}"], solution.remarks)
    result = result_of(solution, stated, notes=notes, has_events=events is not None, has_ledger=with_ledger)
    state = None if z0 is None else np.array(z0, dtype=float)
    asked = Asked(given, options, start, state, None if times is None else times.copy(), record_every)
    object.__setattr__(result, "_asked", asked)
    object.__setattr__(result, "_shared", None if shared is None else (shared, as_problem(given)))
    return result
