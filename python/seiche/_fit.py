"""Parameters of an equation from measurements."""

from __future__ import annotations

import dataclasses
import math
import re
import warnings
from typing import TYPE_CHECKING, Any, Callable, Mapping, Sequence

import numpy as np

from ._problem import Case, Problem, as_problem, make_problem, override, parse_keywords, real_array
from ._result import Answer, Result, SeicheWarning
from ._solve import solve

if TYPE_CHECKING:
    import matplotlib.axes

Observation = Callable[[np.ndarray, np.ndarray], Any]

_MANY = 1e6  # standard deviations: where the run failed, far from every measurement
_UNLIKELY = 1e-3
_ALIKE = 0.999  # a correlation of two parameters that the data hardly tell apart


class FitResult(Answer):
    """What measurements say of the parameters; keys are attributes too.

    Attributes
    ----------
    parameters, std : dict
        What was found, and their standard deviations.
    correlations : (parameters, parameters) array
        In the order of ``parameters``.
    covariance : (parameters, parameters) array
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
        The step size of all runs; halving it moves the solution by less than a tenth of sigma.
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

    parts = zip(of_each("problem", problem), t, data, of_each("observe", observe), of_each("sigma", sigma))
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


def _parameters(given: Mapping[str, Any], records: int) -> list[_Parameter]:
    if not isinstance(given, Mapping) or not given:
        raise ValueError('parameters must name what is looked for: {"gamma": (0.1, 0, 1)}, its first guess and its bounds')
    found = []
    for name, value in given.items():
        numbers = np.atleast_1d(real_array(f"parameters[{name!r}]", value))
        if numbers.shape not in ((1,), (3,)) or np.isnan(numbers).any():
            raise ValueError(f"parameters[{name!r}] = {value!r} must be a first guess, or (guess, least, most)")
        start, low, high = (numbers[0], -np.inf, np.inf) if numbers.size == 1 else numbers
        if not low < high or not low <= start <= high or not math.isfinite(start):
            raise ValueError(f"parameters[{name!r}] = {value!r}: least ≤ guess ≤ most, and least < most")
        only = re.fullmatch(r"[\w.]+(?:\[(\d+)\])?", name)
        if only is None:
            raise ValueError(f"parameters: {name!r} is no name; write gamma, initial.q, or initial.q[0] of one record alone")
        record = None if only[1] is None else int(only[1])
        if record is not None and record >= records:
            raise ValueError(f"parameters: {name!r} is of record {record}, and there are {records}")
        found.append(_Parameter(name, float(start), float(low), float(high), record))
    return found


class _Model:
    """The solutions of all records as a function of the parameters."""

    def __init__(self, records: list[_Record], parameters: list[_Parameter], options: dict[str, Any]):
        self.records, self.parameters, self.options = records, parameters, options
        self.failure = ""

    def problem(self, k: int, x: np.ndarray) -> Problem | Case:
        changes = [override(p.key, float(value)) for p, value in zip(self.parameters, x) if p.record in (None, k)]
        given = self.records[k].given
        if isinstance(given, Case):
            return Case(given._file, [*given._overrides, *changes], given._written)
        if given._text is None:
            raise ValueError("a problem by parts has no parameters to change: state it by formulas, or by its name")
        made = Problem.__new__(Problem)
        made._core = make_problem(parse_keywords(given._text, changes))
        made._text, made._has_initial = given._text, given._has_initial
        return made

    def run(self, k: int, x: np.ndarray, **options: Any) -> Result:
        record = self.records[k]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SeicheWarning)  # of tried values; `fit` looks at the last ones itself
            return solve(self.problem(k, x), (record.start, record.t[-1]), t_eval=record.t, **(self.options | options))

    def observed(self, x: np.ndarray, **options: Any) -> list[np.ndarray] | None:
        """Of each record; None where a run failed, and `failure` says why."""
        seen = []
        for k, record in enumerate(self.records):
            result = self.run(k, x, **options)
            if result.status == "interrupted":
                raise KeyboardInterrupt
            if not result.success or result.y.shape[1] != record.t.size:
                self.failure = result.message
                return None
            seen.append(record.observe(result))
        return seen

    def residuals(self, x: np.ndarray) -> np.ndarray:
        seen = self.observed(x)
        if seen is None:
            return np.full(sum(record.data.size for record in self.records), _MANY)
        return np.concatenate([((r.data - s) / _of(r.sigma)).ravel() for r, s in zip(self.records, seen)])


def _of(sigma: np.ndarray | None) -> Any:
    return 1.0 if sigma is None else sigma


def _step_size(model: _Model, x: np.ndarray) -> float:
    """So many steps of one size as a tolerance of a thousandth of the data's size takes."""
    longest = max(range(len(model.records)), key=lambda k: model.records[k].t[-1] - model.records[k].start)
    record = model.records[longest]
    scale = max(float(np.ptp(record.data)), float(np.abs(record.data).max()), 1e-300)
    span = record.t[-1] - record.start
    result = model.run(longest, x, tolerance=1e-4 * scale / span, h=None)
    if not result.success:
        raise ValueError(f"the run with the first guess does not reach the end of the data: {result.message}")
    return float(span / max(result.steps, 4))


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

    for name in ("t_eval", "events", "dense_output", "observer", "tolerance", "z0", "t_span", "ledger", "record_every"):
        if name in options:
            raise ValueError(f"fit chooses {name} itself")
    if isinstance(problem, str):
        problem = as_problem(problem)
    records = _records(problem, t, data, observe, sigma)
    wanted = _parameters(parameters, len(records))
    count = sum(record.data.size for record in records)
    if count <= len(wanted):
        raise ValueError(f"{count} measurements cannot determine {len(wanted)} parameters: more of one than of the other are needed")
    if sigma is None:
        size = max(float(np.abs(record.data).max()) for record in records)
        if size == 0:
            raise ValueError("data are all zero, and sigma is not given: nothing says how large an error is")
    model = _Model(records, wanted, {"method": method, **options})
    x = np.array([p.start for p in wanted])
    model.options["h"] = _step_size(model, x) if h is None else h
    for attempt in range(4):
        if model.observed(x) is None:
            raise ValueError(f"the run with the first guess does not reach the end of the data: {model.failure}")
        found = scipy.optimize.least_squares(
            model.residuals, x, bounds=([p.low for p in wanted], [p.high for p in wanted]), x_scale="jac",
            diff_step=1e-6, xtol=1e-10, ftol=1e-12, gtol=1e-12,
        )  # fmt: skip
        x = found.x
        spread = _spread(found, count, len(wanted), sigma is None)
        seen, finer = model.observed(x), None
        if h is not None or seen is None:
            break
        finer = model.observed(x, h=model.options["h"] / 2)
        if finer is not None and all(
            np.abs(a - b).max() <= 0.1 * np.min(_of(r.sigma) * spread) for a, b, r in zip(seen, finer, records)
        ):
            break
        model.options["h"] /= 2
    return _answer(model, found, spread, count, sigma is None, scipy.stats.chi2.sf)


def _spread(found: Any, count: int, parameters: int, estimated: bool) -> float:
    """By what sigma is multiplied: 1 where it was given."""
    size = float(np.sqrt(2 * found.cost / (count - parameters)))
    return max(size, 1e-300) if estimated else 1.0


def _answer(model: _Model, found: Any, spread: float, count: int, estimated: bool, chi2_above: Callable) -> FitResult:
    records, wanted, x = model.records, model.parameters, found.x
    names = [p.name for p in wanted]
    J = found.jac / spread
    size = np.linalg.norm(J, axis=0)
    scaled = J / np.where(size > 0, size, 1)
    _, singular, V = np.linalg.svd(scaled, full_matrices=False)
    known = singular > 1e-7 * singular[0]
    with np.errstate(divide="ignore", invalid="ignore"):
        inverse = (V.T[:, known] / singular[known] ** 2) @ V[known]
        covariance = inverse / np.outer(size, size)
        std = np.sqrt(np.diag(covariance))
        correlations = covariance / np.outer(std, std)
    results = [model.run(k, x) for k in range(len(records))]
    residuals = [record.data - record.observe(result) for record, result in zip(records, results)]
    chi2, dof = 2 * float(found.cost) / spread**2, count - len(wanted)
    p_value = None if estimated else float(chi2_above(chi2, dof))
    remarks = _remarks(model, found, singular, V, size, correlations, p_value, chi2, dof, residuals, names)
    for k in np.flatnonzero(~known):
        std[np.abs(V[k]) > 0.1] = np.inf
    std[size == 0] = np.inf
    for result in results:
        remarks += [result.message] if result.status != "success" or result.law == "violated" else []
    bands = []
    at = 0
    for record in records:
        part = J[at : at + record.data.size]
        at += record.data.size
        variance = np.einsum("ij,jk,ik->i", part, np.nan_to_num(covariance), part)
        bands.append(np.sqrt(np.maximum(variance, 0)).reshape(record.data.shape) * _of(record.sigma) * spread)
    said = f"{found.nfev} sets of parameters tried; χ² = {chi2:.4g} with {dof} degrees of freedom"
    if estimated:
        said = f"{found.nfev} sets of parameters tried; standard deviation of the residuals {spread:.3g}"
    result = FitResult(
        parameters=dict(zip(names, map(float, x))),
        std=dict(zip(names, map(float, std))),
        correlations=correlations,
        covariance=covariance,
        residuals=[r.reshape(record.shape) for r, record in zip(residuals, records)],
        sigma=[np.broadcast_to(_of(record.sigma) * spread, record.data.shape).reshape(record.shape) for record in records],
        chi2=chi2,
        dof=dof,
        p_value=p_value,
        success=bool(found.status > 0),
        message="; ".join([said, *remarks]),
        results=results,
        h=float(model.options["h"]) if not isinstance(model.options["h"], str) else results[0].report["h"],
        nfev=int(found.nfev),
    )
    object.__setattr__(result, "_records", records)
    object.__setattr__(result, "_bands", bands)
    for remark in remarks:
        warnings.warn(remark, SeicheWarning, stacklevel=3)
    return result


def _remarks(
    model: _Model, found: Any, singular: np.ndarray, V: np.ndarray, size: np.ndarray, correlations: np.ndarray,
    p_value: float | None, chi2: float, dof: int, residuals: list[np.ndarray], names: list[str],
) -> list[str]:  # fmt: skip
    """What one should know before these numbers are believed."""
    said = [] if found.status > 0 else [f"the search did not end: {found.message}"]
    for k, parameter in enumerate(model.parameters):
        if size[k] == 0:
            said.append(f"the data do not depend on {names[k]}")
        elif found.active_mask[k] != 0:
            bound = parameter.low if found.active_mask[k] < 0 else parameter.high
            said.append(f"{names[k]} ended at its bound {bound:g}")
    alike = {
        tuple(sorted((i, j)))
        for i in range(len(names))
        for j in range(i)
        if abs(correlations[i, j]) > _ALIKE and size[i] > 0 and size[j] > 0
    }
    for i, j in sorted(alike):
        said.append(f"the data hardly tell {names[i]} from {names[j]}: their correlation is {correlations[i, j]:.5f}")
    for k in np.flatnonzero(singular <= 1e-7 * singular[0]):
        part = [name for name, weight, norm in zip(names, V[k], size) if abs(weight) > 0.1 and norm > 0]
        if len(part) > 1:
            said.append(f"the data do not tell {' and '.join(part)} apart: only a combination of them is known")
    if p_value is not None and p_value < _UNLIKELY:
        said.append(f"the model does not fit: noise makes χ²/dof = {chi2 / dof:.3g} with probability {p_value:.1e}")
    elif p_value is not None and p_value > 1 - _UNLIKELY:
        said.append(f"residuals are smaller than sigma says: χ²/dof = {chi2 / dof:.3g}")
    pairs = [(r[:, 1:].ravel(), r[:, :-1].ravel()) for r in residuals]
    next_, last = (np.concatenate(part) for part in zip(*pairs))
    power = float(np.sum(next_**2) + np.sum(last**2)) / 2
    if last.size >= 20 and power > 0 and (p_value is None or _UNLIKELY <= p_value <= 1 - _UNLIKELY):
        correlation = float(np.sum(next_ * last)) / power
        if correlation > 5 / math.sqrt(last.size):
            said.append(f"residuals are no noise: neighbours in time are correlated by {correlation:.2f}, so the model misses something")
    return said
