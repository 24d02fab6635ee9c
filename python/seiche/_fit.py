"""Parameters of an equation from measurements."""

from __future__ import annotations

import dataclasses
import math
import re
import warnings
from typing import TYPE_CHECKING, Any, Callable, Mapping, Sequence

import numpy as np

from ._core import methods
from ._problem import Case, Problem, as_problem, make_problem, override, parse_keywords, real_array
from ._result import Answer, Result, SeicheWarning
from ._solve import solve

if TYPE_CHECKING:
    import matplotlib.axes

Observation = Callable[[np.ndarray, np.ndarray], Any]

_UNLIKELY = 1e-3
_ALIKE = 0.999  # a correlation of two parameters that the data hardly tell apart
_UNKNOWN = 1e-6  # of the largest singular value: a direction in which the data do not change
_MOST_STEPS = 100_000  # of a run, where h is not given
_EXACT = 1e-10  # of the size of data: no smaller error is asked for
_NO_NUMBERS = ("name", "fields", "H", "M", "V", "S", "D", "points", "boundary", "discretisation", "dealias", "initial")


class FitResult(Answer):
    """What measurements say of the parameters; keys are attributes too.

    Attributes
    ----------
    parameters, std : dict
        What was found, and their standard deviations.
    correlations : (parameters, parameters) array
        In the order of ``parameters``.
    covariance : (parameters, parameters) array
        NaN for what the data do not tell, where std is infinite.
    residuals : list of arrays
        Measurement minus solution, of each record, in its shape.
    sigma : list of arrays
        Standard deviations of the measurements, as given, or estimated from the residuals.
    chi2, dof : float, int
        Σ(residual/σ)² and the number of measurements less that of the parameters.
    p_value : float or None
        How likely noise alone makes chi2 as large; None where sigma was estimated.
    success : bool
    message : str
        How the search ended, and what one should know: parameters that the data do not tell apart, bounds that were
        reached, residuals that are no noise.
    results : list of Result
        The solution with these values at the times of each record.
    h : float
        The step size of all runs. Unless ``message`` says otherwise, halving it moves no solution by more than a tenth of sigma.
    nfev : int
        Sets of parameters that were tried, without those for derivatives.
    """

    def plot(self, axes: "matplotlib.axes.Axes | None" = None, record: int = 0) -> "matplotlib.axes.Axes":
        """The measurements, the solution and its band of two standard deviations."""
        if axes is None:
            import matplotlib.pyplot

            _, axes = matplotlib.pyplot.subplots(layout="constrained")
        one = self._records[record]
        for k, (data, fitted, wide) in enumerate(zip(one.data, one.observe(self.results[record]), self._bands[record])):
            axes.plot(one.t, data, ".", color=f"C{k}", markersize=3, label="measured" if k == 0 else None)
            axes.plot(one.t, fitted, color=f"C{k}", label="fitted" if k == 0 else None)
            axes.fill_between(one.t, fitted - 2 * wide, fitted + 2 * wide, color=f"C{k}", alpha=0.3, linewidth=0)
        axes.set_xlabel("time t")
        axes.set_ylabel(one.name)
        axes.legend()
        return axes

    def __repr__(self) -> str:
        width = max(map(len, self["parameters"]))
        lines = [f"{name:<{width}} = {_with_error(value, self['std'][name])}" for name, value in self["parameters"].items()]
        return "\n".join([*lines, self["message"]])


def _with_error(value: float, std: float) -> str:
    """0.1034 ± 0.0012: two digits of the standard deviation, and the value to the same place."""
    if not (math.isfinite(std) and std > 0):
        return f"{value:.6g} ± {std:.2g}"
    places = max(0, 1 - math.floor(math.log10(std)))
    return f"{value:.{places}f} ± {std:.{places}f}" if places < 12 else f"{value:.12g} ± {std:.2g}"


@dataclasses.dataclass
class _Record:
    """Measurements of one run, which begins at `start`."""

    given: Problem | Case
    start: float
    t: np.ndarray  # (times,)
    data: np.ndarray  # (observed, times)
    sigma: np.ndarray | None  # of the same shape
    shape: tuple[int, ...]  # of data as they were given
    function: Observation | None
    field: int
    name: str

    def observe(self, result: Result) -> np.ndarray:
        """(observed, times): what the solution says of the data."""
        if self.function is None:
            points = result.y.shape[0] // len(result.problem.fields)
            return result.y[self.field * points : (self.field + 1) * points]
        seen = np.atleast_2d(real_array("what observe returns", self.function(result.t, result.y)))
        if not np.isfinite(seen).all():
            raise ValueError("observe returns a value that is no finite number")
        if seen.shape != self.data.shape:
            raise ValueError(f"observe returns the shape {seen.shape}; data have {self.data.shape}, times last")
        return seen


def _ascending(where: str, t: Any) -> np.ndarray:
    times = np.atleast_1d(real_array(f"t{where}", t))
    if times.ndim != 1 or times.size == 0:
        raise ValueError(f"t{where} has the shape {times.shape}; it must be a list of times")
    _refuse_gaps(f"t{where}", times)
    if (np.diff(times) <= 0).any():
        k = int(np.argmax(np.diff(times) <= 0))
        raise ValueError(f"t{where} must ascend: t[{k + 1}] = {times[k + 1]:g} follows t[{k}] = {times[k]:g}")
    return times


def _refuse_gaps(name: str, values: np.ndarray) -> None:
    missing = ~np.isfinite(values)
    if missing.any():
        place = ", ".join(map(str, np.argwhere(missing)[0]))
        raise ValueError(f"{name}[{place}] is {values[tuple(np.argwhere(missing)[0])]}; leave out what was not measured")


def _record(given: Problem | Case, where: str, t: Any, data: Any, observe: Any, sigma: Any) -> _Record:
    problem = as_problem(given)
    times = _ascending(where, t)
    start = given.t_start if isinstance(given, Case) else 0.0
    if times[0] < start:
        raise ValueError(f"t{where} begins at {times[0]:g}, before the run, which begins at {start:g}")
    if times[-1] == start:
        raise ValueError(f"t{where} ends where the run begins, at {start:g}")
    if callable(observe):
        function, field, name = observe, 0, "measured"
    else:
        name = problem.fields[0] if observe is None else observe
        if name not in problem.fields:
            raise ValueError(f"observe = {name!r} is no field; {problem.name} has {', '.join(problem.fields)}, or give a function of (t, y)")
        function, field = None, problem.fields.index(name)
    values = real_array(f"data{where}", data)
    _refuse_gaps(f"data{where}", values)
    rows = np.atleast_2d(values)
    if rows.ndim != 2 or rows.shape[1] != times.size:
        raise ValueError(f"data{where} has the shape {values.shape}; its last axis must have the {times.size} times of t{where}")
    points = problem.size // len(problem.fields)
    if function is None and rows.shape[0] != points:
        raise ValueError(f"data{where} has {rows.shape[0]} rows; {name} has {points} points: give them all, or a function as observe")
    spread = None
    if sigma is not None:
        spread = real_array(f"sigma{where}", sigma)
        if not (np.isfinite(spread).all() and (spread > 0).all()):
            raise ValueError(f"sigma{where} must be finite and > 0: it is the standard deviation of the measurements")
        try:
            spread = np.broadcast_to(spread, rows.shape).astype(float)
        except ValueError:
            raise ValueError(f"sigma{where} has the shape {spread.shape}; it must be a number, or of the shape of data") from None
    return _Record(given, start, times, rows, spread, values.shape, function, field, name)


def _records(problem: Any, t: Any, data: Any, observe: Any, sigma: Any) -> list[_Record]:
    several = isinstance(t, (list, tuple)) and len(t) > 0 and np.ndim(t[0]) > 0
    if not several:
        return [_record(problem, "", t, data, observe, sigma)]
    count = len(t)
    if not isinstance(data, (list, tuple)) or len(data) != count:
        raise ValueError(f"t has {count} records; data must be a list of as many")

    def of_each(name: str, value: Any) -> list:
        if not isinstance(value, (list, tuple)):
            return [value] * count
        if len(value) != count:
            raise ValueError(f"{name} has {len(value)} entries for {count} records")
        return list(value)

    spreads = of_each("sigma", sigma)
    if 0 < sum(one is None for one in spreads) < count:
        raise ValueError("sigma must be given for all records, or for none")
    parts = zip(of_each("problem", problem), t, data, of_each("observe", observe), spreads)
    return [_record(one, f"[{k}]", *rest) for k, (one, *rest) in enumerate(parts)]


@dataclasses.dataclass
class _Parameter:
    name: str
    start: float
    low: float
    high: float
    record: int | None  # the only one that it is of

    @property
    def key(self) -> str:
        return "problem." + self.name.split("[")[0]

    @property
    def size(self) -> float:
        """What its changes are compared with."""
        width = self.high - self.low
        return abs(self.start) or (1e-2 * width if math.isfinite(width) else 1.0)


def _parameters(given: Mapping[str, Any], records: int) -> list[_Parameter]:
    if not isinstance(given, Mapping) or not given:
        raise ValueError('parameters must name what is looked for: {"gamma": (0.1, 0, 1)}, its first guess and its bounds')
    found: list[_Parameter] = []
    for name, value in given.items():
        only = re.fullmatch(r"([\w.]+)(?:\[(\d+)\])?", str(name))
        if only is None:
            raise ValueError(f"parameters: {name!r} is no name; write gamma, initial.q, or initial.q[0] of one record alone")
        if only[1] in _NO_NUMBERS or only[1].startswith(("method.", "time.", "output.")):
            raise ValueError(f"parameters: {only[1]} is no number of the problem")
        numbers = np.atleast_1d(real_array(f"parameters[{name!r}]", value))
        if numbers.shape not in ((1,), (3,)) or np.isnan(numbers).any():
            raise ValueError(f"parameters[{name!r}] = {value!r} must be a first guess, or (guess, least, most)")
        start, low, high = (numbers[0], -np.inf, np.inf) if numbers.size == 1 else numbers
        if not low < high or not low <= start <= high or not math.isfinite(start):
            raise ValueError(f"parameters[{name!r}] = {value!r}: least ≤ guess ≤ most, and least < most")
        record = None if only[2] is None else int(only[2])
        if record is not None and record >= records:
            raise ValueError(f"parameters: {name!r} is of record {record}, and there are {records}")
        made = _Parameter(name, float(start), float(low), float(high), record)
        if any(made.key == other.key and None in (record, other.record) for other in found):
            raise ValueError(f"parameters: {only[1]} is one of all records, or one of each, and not both")
        found.append(made)
    return found


class _Model:
    """The solutions of all records as a function of the parameters."""

    def __init__(self, records: list[_Record], parameters: list[_Parameter], options: dict[str, Any]):
        self.records, self.parameters, self.options = records, parameters, options
        # Where sigma is not given residuals are in units of the data's size.
        self.unit = 1.0 if records[0].sigma is not None else max(float(np.abs(r.data).max()) for r in records)
        self.failure = ""
        self.far: float | None = None  # residuals where runs fail, larger than all of the first guess

    def sigma(self, record: _Record) -> np.ndarray:
        return np.full(record.data.shape, self.unit) if record.sigma is None else record.sigma

    def problem(self, k: int, x: np.ndarray) -> Problem | Case:
        changes = [override(p.key, float(value)) for p, value in zip(self.parameters, x) if p.record in (None, k)]
        given = self.records[k].given
        if isinstance(given, Case):
            return Case(given._file, [*given._overrides, *changes], given._written)
        if given._text is None:
            if given._file is not None:
                raise ValueError("the problem of a case file: give the case itself")
            raise ValueError("a problem by parts has no parameters to change: state it by formulas, or by its name")
        if not given._has_initial:
            raise ValueError("the initial state is missing: give initial to seiche.Problem, of which initial.… are parts")
        made = Problem.__new__(Problem)
        made._core = make_problem(parse_keywords(given._text, changes))
        made._text, made._has_initial = given._text, given._has_initial
        return made

    def run(self, k: int, x: np.ndarray, **options: Any) -> Result:
        record = self.records[k]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SeicheWarning)  # of tried values; `fit` looks at the last ones itself
            result = solve(self.problem(k, x), (record.start, record.t[-1]), t_eval=record.t, **(self.options | options))
        if result.status == "interrupted":
            raise KeyboardInterrupt
        return result

    def observed(self, x: np.ndarray, **options: Any) -> list[np.ndarray] | None:
        """Of each record; None where a run failed, and `failure` says why. Of the first guess a refusal is raised."""
        seen = []
        for k, record in enumerate(self.records):
            try:
                result = self.run(k, x, **options)
                if not result.success or result.y.shape[1] != record.t.size:
                    self.failure = result.message
                    return None
                seen.append(record.observe(result))
            except ValueError as error:
                if self.far is None:
                    raise
                self.failure = str(error)
                return None
        return seen

    def residuals(self, x: np.ndarray) -> np.ndarray:
        seen = self.observed(x)
        if seen is None:
            return np.full(sum(record.data.size for record in self.records), self.far)
        return np.concatenate([((r.data - s) / self.sigma(r)).ravel() for r, s in zip(self.records, seen)])

    def begin(self, x: np.ndarray) -> None:
        """Raises ValueError where the first guess gives no solution."""
        if self.observed(x) is None:
            raise ValueError(f"the run with the first guess does not reach the end of the data: {self.failure}")
        self.far = 10 * max(float(np.abs(self.residuals(x)).max()), 1.0)

    def jacobian(self, x: np.ndarray) -> np.ndarray:
        """By differences to both sides, or to one at a bound and where runs fail."""
        columns, here = [], None
        for k, parameter in enumerate(self.parameters):
            width = 1e-5 * max(abs(x[k]), parameter.size)
            ends = []
            for value in (x[k] - width, x[k] + width):
                at = x.copy()
                at[k] = value
                inside = parameter.low <= value <= parameter.high
                ends.append((value, self.observed(at)) if inside else (value, None))
            if any(seen is None for _, seen in ends):
                here = self.observed(x) if here is None else here
                ends = [(value, seen) if seen is not None else (x[k], here) for value, seen in ends]
            (low, below), (high, above) = ends
            if below is None or above is None or high <= low:
                columns.append(np.zeros(sum(record.data.size for record in self.records)))
                continue
            slopes = [(a - b) / (high - low) for a, b in zip(above, below)]
            columns.append(np.concatenate([(-s / self.sigma(r)).ravel() for r, s in zip(self.records, slopes)]))
        return np.array(columns).T

    def error_of_steps(self, x: np.ndarray, spread: float) -> float:
        """By how much halving the steps moves the solutions, in standard deviations of the measurements."""
        seen, finer = self.observed(x), self.observed(x, h=self.options["h"] / 2)
        if seen is None or finer is None:
            return math.inf
        size = max(float(np.abs(record.data).max()) for record in self.records)
        least = [np.maximum(self.sigma(r) * spread, _EXACT * size) for r in self.records]
        return max(float((np.abs(a - b) / s).max()) for a, b, s in zip(seen, finer, least))


def _step_size(model: _Model, x: np.ndarray) -> float:
    """As long as a run by a loose tolerance takes them; errors are looked at afterwards."""
    longest = max(range(len(model.records)), key=lambda k: model.records[k].t[-1] - model.records[k].start)
    record = model.records[longest]
    span = float(record.t[-1] - record.start)
    start = as_problem(model.problem(longest, x)).z0
    scale = float(np.abs(start).max()) or 1.0
    result = model.run(longest, x, tolerance=1e-4 * scale / span, h=None)
    return span / max(result.steps, 4) if result.success else span / 1000


def fit(
    problem: Problem | Case | Sequence[Problem | Case],
    t: Any,
    data: Any,
    parameters: Mapping[str, Any],
    observe: str | Observation | Sequence[Any] | None = None,
    sigma: Any = None,
    *,
    h: float | str | None = None,
    method: str = "egc4",
    **options: Any,
) -> FitResult:
    """Finds parameters of an equation, or of its initial state, from measurements of its solution: least squares.

    Runs take steps of one size, so that they depend smoothly on the parameters; derivatives are differences of runs, and
    SciPy's ``least_squares`` moves within the bounds.

    Parameters
    ----------
    problem : Problem or Case
        By formulas, by name, or from a case file. For several records one of all, or a list with one for each.
    t : (times,) array
        The times of the measurements, ascending, at the start of the run (0, or that of the case) or later. For several
        records a list of such arrays.
    data : (times,) array, or (observed, times)
        What was measured; for several records a list.
    parameters : dict
        Name → first guess, or (first guess, least, most). Names are keys of the problem, ``"gamma"``, with a dot those of
        a table in it, ``"initial.q"``, ``"friction.coefficient"``, or the parameters that formulas name. ``"initial.q[0]"`` is
        that of the first record alone.
    observe : str or function
        What data are: a field at all its points, by default the first; or ``observe(t, y)``, y of shape (size, times),
        which returns the shape of data.
    sigma : float or array, optional
        Standard deviations of the measurements. Without it they are taken as equal and estimated from the residuals,
        and nothing can be said of how well the model fits but whether residuals look like noise.
    h : float or str, optional
        Step size; by default one that leaves errors below a tenth of sigma.
    method : str
        By default "egc4".
    **options
        More of `solve`: backend, threads, law.

    Returns
    -------
    FitResult

    Raises
    ------
    ValueError
        For data or parameters that make no sense, in one sentence.
    """
    import scipy.optimize
    import scipy.stats

    for name in ("t_eval", "events", "dense_output", "observer", "tolerance", "h_max", "z0", "t_span", "ledger", "record_every"):
        if name in options:
            raise ValueError(f"fit chooses {name} itself")
    if isinstance(problem, str):
        problem = as_problem(problem)
    records = _records(problem, t, data, observe, sigma)
    wanted = _parameters(parameters, len(records))
    count = sum(record.data.size for record in records)
    if count <= len(wanted):
        raise ValueError(f"{count} measurements cannot determine {len(wanted)} parameters: more of one than of the other are needed")
    if records[0].sigma is None and not any(record.data.any() for record in records):
        raise ValueError("data are all zero, and sigma is not given: nothing says how large an error is")
    model = _Model(records, wanted, {"method": method, **options})
    x = np.array([p.start for p in wanted])
    model.options["h"] = _step_size(model, x) if h is None else h
    model.begin(x)
    order = next((m["order"] for m in methods() if m["name"] == method), 2)
    bounds = [p.low for p in wanted], [p.high for p in wanted]
    for attempt in range(6):
        found = scipy.optimize.least_squares(
            model.residuals, x, model.jacobian, bounds, x_scale="jac", xtol=1e-10, ftol=1e-12, gtol=1e-12
        )
        x = found.x
        if model.observed(x) is None:
            raise ValueError(f"the search ended where runs fail: {model.failure}")
        spread = 1.0 if records[0].sigma is not None else float(np.sqrt(2 * found.cost / (count - len(wanted))))
        error = 0.0 if h is not None else model.error_of_steps(x, spread)
        shortest = max(r.t[-1] - r.start for r in records) / _MOST_STEPS
        if error <= 0.1 or attempt == 5 or model.options["h"] <= shortest:
            break
        model.options["h"] = max(model.options["h"] * min(max((0.05 / error) ** (1 / order), 1 / 16), 0.5), shortest)
    return _answer(model, found, spread, error, count, scipy.stats.chi2.sf)


def _answer(model: _Model, found: Any, spread: float, error: float, count: int, chi2_above: Callable) -> FitResult:
    records, wanted, x = model.records, model.parameters, found.x
    names = [p.name for p in wanted]
    estimated, exact = records[0].sigma is None, spread <= _EXACT
    J = found.jac / (spread or 1)
    size = np.linalg.norm(J, axis=0)
    _, singular, V = np.linalg.svd(J / np.where(size > 0, size, 1), full_matrices=False)
    is_known = singular > _UNKNOWN * singular[0]
    unknown = (size == 0) | (np.abs(V[~is_known]) > 0.1).any(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        covariance = (V.T[:, is_known] / singular[is_known] ** 2) @ V[is_known] / np.outer(size, size)
        band = np.where(np.isfinite(covariance), covariance, 0)
        covariance[unknown] = covariance[:, unknown] = np.nan
        std = np.where(unknown, np.inf, np.sqrt(np.diag(covariance)))
        correlations = covariance / np.outer(std, std)
    results = [model.run(k, x) for k in range(len(records))]
    residuals = [record.data - record.observe(result) for record, result in zip(records, results)]
    dof = count - len(wanted)
    chi2 = float(dof) if estimated else 2 * float(found.cost)
    p_value = None if estimated else float(chi2_above(chi2, dof))
    remarks = [] if found.status > 0 else [f"the search did not end: {found.message}"]
    if error > 0.1:
        remarks.append(f"steps of {model.options['h']:.3g} add errors of up to {error:.2g} sigma: give a smaller h")
    remarks += _unclear(wanted, found, size, V[~is_known], unknown, correlations)
    weighted = [r / model.sigma(record) for r, record in zip(residuals, records)]
    remarks += _misfit(weighted, p_value, chi2 / dof, estimated and exact)
    for result in results:
        remarks += [result.message] if result.law == "violated" else []
    bands, at = [], 0
    for record in records:
        part = J[at : at + record.data.size]
        at += record.data.size
        variance = np.einsum("ij,jk,ik->i", part, band, part)
        bands.append(np.sqrt(np.maximum(variance, 0)).reshape(record.data.shape) * model.sigma(record) * spread)
    said = f"{found.nfev} sets of parameters tried; "
    if estimated:
        said += f"standard deviation of the residuals {spread * model.unit:.3g}"
    else:
        said += f"χ² = {chi2:.4g} with {dof} degrees of freedom"
    result = FitResult(
        parameters=dict(zip(names, map(float, x))),
        std=dict(zip(names, map(float, std))),
        correlations=correlations,
        covariance=covariance,
        residuals=[r.reshape(record.shape) for r, record in zip(residuals, records)],
        sigma=[(model.sigma(record) * spread).reshape(record.shape) for record in records],
        chi2=chi2,
        dof=dof,
        p_value=p_value,
        success=bool(found.status > 0),
        message="; ".join([said, *remarks]),
        results=results,
        h=results[0].report["h"],
        nfev=int(found.nfev),
    )
    object.__setattr__(result, "_records", records)
    object.__setattr__(result, "_bands", bands)
    for remark in remarks:
        warnings.warn(remark, SeicheWarning, stacklevel=3)
    return result


def _unclear(
    wanted: list[_Parameter], found: Any, size: np.ndarray, free: np.ndarray, unknown: np.ndarray, correlations: np.ndarray
) -> list[str]:
    """Which parameters the data, or the bounds, do not determine. `free`: directions in which the data do not change."""
    said = []
    for k, parameter in enumerate(wanted):
        if size[k] == 0:
            said.append(f"the data do not depend on {parameter.name}")
        elif found.active_mask[k] != 0:
            said.append(f"{parameter.name} ended at its bound {parameter.low if found.active_mask[k] < 0 else parameter.high:g}")
    for direction in free:
        part = [p.name for p, weight, norm in zip(wanted, direction, size) if abs(weight) > 0.1 and norm > 0]
        if len(part) > 1:
            said.append(f"the data do not tell {', '.join(part[:-1])} and {part[-1]} apart: only a combination of them is known")
    for i in range(len(wanted)):
        for j in range(i):
            if not (unknown[i] or unknown[j]) and abs(correlations[i, j]) > _ALIKE:
                pair = f"{wanted[j].name} from {wanted[i].name}"
                said.append(f"the data hardly tell {pair}: their correlation is {correlations[i, j]:.6g}")
    return said


def _misfit(weighted: list[np.ndarray], p_value: float | None, ratio: float, exact: bool) -> list[str]:
    """Whether residuals, in standard deviations, look like noise."""
    if p_value is not None and p_value < _UNLIKELY:
        return [f"the model does not fit: noise makes χ²/dof = {ratio:.3g} with probability {p_value:.1e}"]
    if p_value is not None and p_value > 1 - _UNLIKELY:
        return [f"residuals are smaller than sigma says: χ²/dof = {ratio:.3g}"]
    later = np.concatenate([r[:, 1:].ravel() for r in weighted])
    before = np.concatenate([r[:, :-1].ravel() for r in weighted])
    power = float(np.sum(later**2) + np.sum(before**2)) / 2
    if exact or later.size < 20 or power == 0:
        return []
    correlation = float(np.sum(later * before)) / power
    if correlation <= 5 / math.sqrt(later.size):
        return []
    return [f"residuals are no noise: neighbours in time are correlated by {correlation:.2f}, so the model misses something"]
