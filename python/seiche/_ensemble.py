"""Many members of one small problem."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Sequence

import numpy as np

from . import _core
from ._problem import Case, Problem, as_problem, real_array, refuse_other_names, require_start, run_case, thread_count
from ._progress import Report, showing
from ._result import Answer, about_it, coordinates_of, field_of, say
from ._solve import _span
from ._types import Array, ArrayLike, Backend, Method, ProblemName, Size

if TYPE_CHECKING:
    import xarray


class EnsembleResult(Answer):
    """What an ensemble leaves; keys are attributes too.

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
    side_by_side : bool
        Were members stepped side by side?
    wall_seconds : float
    method : str
    h : float
        Step size.
    problem : Problem
        That of the first member.
    """

    def field(self, name: str) -> Array:
        """One field of the last states on the grid, of shape (members, points along each axis); a view of y."""
        return field_of(self.y, self.problem, name)

    def to_xarray(self) -> "xarray.Dataset":
        """The last states and parameters by `member`, and the energies over `t` by `statistic`, as an `xarray.Dataset`.

        Members are numbered from 0. Names and attributes of the fields are those of solution.h5; where the grids of members have
        different lengths, places have no coordinates.
        """
        import xarray

        layout = self.problem._core.layout
        names = [name for name, _ in layout["axes"]]
        shape = (len(self.y), *(self.problem.shape if names else ()))
        coordinates: dict[str, Any] = {
            "t": ("t", self.t, about_it("time")),
            "member": ("member", np.arange(len(self.y)), {"long_name": "member, from 0"}),
            "statistic": ("statistic", list(self.energy)),
        }
        if self._one_grid:
            coordinates |= coordinates_of(self.problem)
        coordinates |= {name: ("member", values, about_it("parameter")) for name, values in self.parameters.items()}
        data: dict[str, Any] = {
            shown: (("member", *names), self.field(name).reshape(shape), about_it(f"{meaning} at the end"))
            for name, (shown, meaning) in zip(self.problem.fields, layout["fields"])
        }
        energies = {
            "H": (self.energy, "energy H = ½zᵀMz + V(z), summed over points"),
            "H_modified": (self.modified_energy, "modified energy"),
        }
        for name, (energy, meaning) in energies.items():
            if energy is not None:
                data[name] = (("statistic", "t"), np.array(list(energy.values())), about_it(meaning))
        data["final_energy"] = ("member", self.final_energy, about_it("energy at the end"))
        data["running"] = ("t", self.running, {"long_name": "members that still run"})
        for name in ("status", "law", "message"):
            data[name] = ("member", self[name])
        about = {"method": self.method, "h": self.h, "problem": self.problem.name}
        return xarray.Dataset(data, coords=coordinates, attrs=about)


def _members(problem: Any, given: Problem | Case) -> list[Problem]:
    """One problem for all members, or one for each: of one size, and with the same fields and points."""
    if not isinstance(problem, (list, tuple)):
        return [as_problem(given)]
    problems = [as_problem(p) for p in problem]
    first = problems[0]
    for k, other in enumerate(problems):
        if other.size != first.size:
            raise ValueError(
                f"the members of an ensemble have one size, but the state of problem 0 has {first.size} numbers and that of "
                f"problem {k} has {other.size}"
            )
        if (other.fields, other.shape) != (first.fields, first.shape):
            raise ValueError(
                f"the members of an ensemble have the same fields and points, but problem 0 has {', '.join(first.fields)} at "
                f"{' × '.join(map(str, first.shape))} and problem {k} has {', '.join(other.fields)} at "
                f"{' × '.join(map(str, other.shape))}"
            )
    return problems


def solve_ensemble(
    problem: Problem | Case | ProblemName | Sequence[Problem],
    t_span: float | None = None,
    z0: ArrayLike | None = None,
    method: Method | None = None,
    *,
    h: Size | None = None,
    backend: Backend | None = None,
    threads: int = 1,
    progress: bool | Report = False,
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

    The other parameters are those of `seiche.solve`; ``progress`` tells of the times in ``t``. A member that fails stops with its message, and the others go on.
    Warns with a `seiche.SeicheWarning` where members may be inaccurate, as `seiche.solve` does.
    """
    refuse_other_names(options)
    if isinstance(problem, (list, tuple)) and not problem:
        raise ValueError("the list of problems is empty: give one for each member")
    first: Any = problem[0] if isinstance(problem, (list, tuple)) else problem
    given: Problem | Case = problem if isinstance(problem, Case) else as_problem(first)
    default_end = given.t_end if isinstance(given, Case) else run_case(given, {}).t_end if given._text else None
    start, end = _span(t_span, default_end, given.t_start if isinstance(given, Case) else 0.0)
    if start < 0:
        raise ValueError(f"t_span = ({start:g}, {end:g}): an ensemble starts at t = 0 or later")
    problems: list[Problem] = []
    case = run_case(given, {"t_start": start, "t_end": end, "method": method, "backend": backend, "h": h} | options)
    if z0 is None and isinstance(given, Case) and case.is_ensemble:
        run: Callable[..., _core.Ensemble] = _core.ensemble_of_case
        members: tuple[Any, ...] = ()
    else:
        problems = _members(problem, given)
        if z0 is None:
            for stated in problems:
                require_start(stated, "seiche.solve_ensemble")
        states = [p.z0 for p in problems] if z0 is None else list(np.atleast_2d(real_array("z0", z0)))
        if isinstance(problem, (list, tuple)) and len(states) != len(problems):
            raise ValueError(f"z0 has {len(states)} rows for {len(problems)} problems")
        run, members = _core.ensemble_of_problems, ([p._core for p in problems], states)
    with showing(progress) as tell:
        held = run(*members, case, thread_count(threads), tell)
        if tell is not None and held.t.size:
            tell(held.t[-1], end, round((held.t[-1] - start) / case.h))
    remarks = {k: of_member for k, of_member in enumerate(held.remarks) if of_member}
    summed_up = [
        f"{len(remarks)} of {len(held.remarks)} members may be inaccurate, the first of them member {k}: "
        + "; ".join(remarks[k])
        for k in list(remarks)[:1]
    ]
    reached = sum(status == "success" for status in held.status)
    say([*case.notes, f"{reached} of {len(held.status)} members reached t = {end:g}"], summed_up)
    has_modified = any(m["name"] == case.method and m["law"] == "H_modified" for m in _core.methods())
    result = EnsembleResult(
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
        side_by_side=held.side_by_side,
        wall_seconds=held.wall_seconds,
        method=case.method,
        h=case.h,
        problem=as_problem(given),
    )
    one_grid = all(np.array_equal(a, b) for p in problems for a, b in zip(p.axes, problems[0].axes))
    object.__setattr__(result, "_one_grid", one_grid and "length" not in held.parameters)
    return result
