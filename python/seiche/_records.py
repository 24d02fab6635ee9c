"""Measurements, the parameters that are looked for, and what solutions say of the one with values of the other."""

from __future__ import annotations

import dataclasses
import difflib
import math
import re
from typing import Any, Callable, Mapping, Sequence

import numpy as np

from ._core import Case as CoreCase
from ._problem import Case, Problem, as_problem, of_text, override, parse_keywords, real_array
from ._progress import Report
from ._result import Result, quietly
from ._solve import solve
from ._types import Array

Observation = Callable[[Array, Array], Any]

_WIDTH = 1e-5  # of differences, of a parameter's size
EXACT = 1e-10  # of the size of data: no smaller error is asked for


class RunFailed(ValueError):
    """Not what was given makes no sense, but a run of it fails."""


@dataclasses.dataclass
class Record:
    """Measurements of one run, which begins at `start`."""

    given: Problem | Case
    start: float
    t: Array  # (times,)
    data: Array  # (observed, times)
    sigma: Array | None  # of the same shape
    shape: tuple[int, ...]  # of data as they were given
    function: Observation | None
    name: str  # of the field, where no function observes
    method: str

    def observe(self, result: Result) -> Array:
        """(observed, times): what the solution says of the data."""
        if self.function is None:
            field = result.field(self.name).reshape(len(result.t), -1).T
            if field.shape != self.data.shape:
                raise ValueError(f"{self.name} has {field.shape[0]} points now: a parameter must not change their number")
            return field
        seen = np.atleast_2d(real_array("what observe returns", self.function(result.t, result.y)))
        if not np.isfinite(seen).all():
            raise ValueError("observe returns a value that is no finite number")
        if seen.shape != self.data.shape:
            raise ValueError(f"observe returns the shape {seen.shape}; data have {self.data.shape}, times last")
        return seen


def _ascending(where: str, t: Any) -> Array:
    times = np.atleast_1d(real_array(f"t{where}", t))
    if times.ndim != 1 or times.size == 0:
        raise ValueError(f"t{where} has the shape {times.shape}; it must be a list of times")
    _refuse_gaps(f"t{where}", times)
    if (np.diff(times) <= 0).any():
        k = int(np.argmax(np.diff(times) <= 0))
        raise ValueError(f"t{where} must ascend: t[{k + 1}] = {times[k + 1]:g} follows t[{k}] = {times[k]:g}")
    return times


def _refuse_gaps(name: str, values: Array) -> None:
    missing = ~np.isfinite(values)
    if missing.any():
        place = ", ".join(map(str, np.argwhere(missing)[0]))
        raise ValueError(
            f"{name}[{place}] is {values[tuple(np.argwhere(missing)[0])]}; leave out what was not measured"
        )


def _record(given: Problem | Case, where: str, t: Any, data: Any, observe: Any, sigma: Any) -> Record:
    problem = as_problem(given)
    if isinstance(given, Case) and given._core.is_ensemble:
        raise ValueError(f"fit takes one run: remove [ensemble] from {given._file}")
    if not isinstance(given, Case) and problem._text is None:
        if problem._file is not None:
            raise ValueError("the problem of a case file: give the case itself")
        raise ValueError("a problem by parts has no parameters to change: state it by formulas, or by its name")
    if not problem._has_initial:
        raise ValueError("the initial state is missing: give initial to seiche.Problem, of which initial.… are parts")
    times = _ascending(where, t)
    start = given.t_start if isinstance(given, Case) else 0.0
    if times[0] < start:
        raise ValueError(f"t{where} begins at {times[0]:g}, before the run, which begins at {start:g}")
    if times[-1] == start:
        raise ValueError(f"t{where} ends where the run begins, at {start:g}")
    if callable(observe):
        function, name = observe, "measured"
    else:
        name = problem.fields[0] if observe is None else observe
        if name not in problem.fields:
            raise ValueError(
                f"observe = {name!r} is no field; {problem.name} has {', '.join(problem.fields)}, or give a function of (t, y)"
            )
        function = None
    values = real_array(f"data{where}", data)
    _refuse_gaps(f"data{where}", values)
    rows = np.atleast_2d(values)
    if rows.ndim != 2 or rows.shape[1] != times.size:
        raise ValueError(
            f"data{where} has the shape {values.shape}; its last axis must have the {times.size} times of t{where}"
        )
    points = problem.size // len(problem.fields)
    if function is None and rows.shape[0] != points:
        raise ValueError(
            f"data{where} has {rows.shape[0]} rows; {name} has {points} points: give them all, or a function as observe"
        )
    spread = None
    if sigma is not None:
        spread = real_array(f"sigma{where}", sigma)
        if not (np.isfinite(spread).all() and (spread > 0).all()):
            raise ValueError(f"sigma{where} must be finite and > 0: it is the standard deviation of the measurements")
        try:
            spread = np.broadcast_to(spread, rows.shape).astype(float)
        except ValueError:
            raise ValueError(
                f"sigma{where} has the shape {spread.shape}; it must be a number, or of the shape of data"
            ) from None
    method = (given._given_method if isinstance(given, Case) else None) or "egc4"
    return Record(given, start, times, rows, spread, values.shape, function, name, method)


def records_of(problem: Any, t: Any, data: Any, observe: Any, sigma: Any) -> list[Record]:
    several = isinstance(t, (list, tuple)) and len(t) > 0 and np.ndim(t[0]) > 0
    if not several:
        return [_record(problem, "", t, data, observe, sigma)]
    count = len(t)
    if not isinstance(data, (list, tuple)) or len(data) != count:
        raise ValueError(f"t has {count} records; data must be a list of as many")

    def of_each(name: str, value: Any) -> list[Any]:
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
class Parameter:
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


def parameters_of(given: Mapping[str, Any] | Sequence[str], records: list[Record]) -> list[Parameter]:
    if isinstance(given, (list, tuple)) and all(isinstance(name, str) for name in given):
        given = dict.fromkeys(given)
    if not isinstance(given, Mapping) or not given:
        raise ValueError(
            'parameters must name what is looked for: {"gamma": (0.1, 0, 1)}, its first guess and its bounds'
        )
    found: list[Parameter] = []
    for name, value in given.items():
        only = re.fullmatch(r"([\w.]+)(?:\[(\d+)\])?", str(name))
        if only is None:
            raise ValueError(
                f"parameters: {name!r} is no name; write gamma, initial.q, or initial.q[0] of one record alone"
            )
        record = None if only[2] is None else int(only[2])
        if record is not None and record >= len(records):
            raise ValueError(f"parameters: {name!r} is of record {record}, and there are {len(records)}")
        case = _own_case(records[record or 0])
        _refuse_what_cannot_change_a_little(only[1], case)
        start, low, high = _guess_and_bounds(name, _own_value(only[1], case) if value is None else value)
        made = Parameter(name, start, low, high, record)
        if any(made.key == other.key and None in (record, other.record) for other in found):
            raise ValueError(f"parameters: {only[1]} is one of all records, or one of each, and not both")
        found.append(made)
    return found


def _own_case(record: Record) -> CoreCase:
    given = record.given
    if isinstance(given, Case):
        return given._core
    problem = as_problem(given)
    return parse_keywords(problem._text or "", problem._overrides)


def _refuse_what_cannot_change_a_little(name: str, case: CoreCase) -> None:
    if re.fullmatch(r"\d+", case.parameters.get(name, "")):
        raise ValueError(f"parameters: {name} is a whole number, and what is looked for changes by a little")
    if case.problem == "custom" and name in ("H", "V") and name not in case.parameters:
        raise ValueError(
            f"parameters: {name} is a formula; look for a number in it, which the parameters of the problem name"
        )


def _own_value(name: str, case: CoreCase) -> float:
    own = case.parameters
    try:
        return float(own.get(name, ""))
    except ValueError:
        if name in own or "." in name:
            raise ValueError(f"parameters: {name} is no number of the problem's own: give a first guess") from None
        near = difflib.get_close_matches(name, own, 1)
        numbers = [key for key, text in own.items() if re.fullmatch(r"[-+\d.e]*[.e][-+\d.e]*", text)]
        hint = f"; did you mean {near[0]!r}?" if near else f"; those of the problem are {', '.join(numbers)}"
        raise ValueError(f"parameters: {name} is no number{hint}") from None


def _guess_and_bounds(name: str, value: Any) -> tuple[float, float, float]:
    numbers = np.atleast_1d(real_array(f"parameters[{name!r}]", value))
    if numbers.shape not in ((1,), (3,)) or np.isnan(numbers).any():
        raise ValueError(f"parameters[{name!r}] = {value!r} must be a first guess, or (guess, least, most)")
    start, low, high = [*map(float, numbers), -math.inf, math.inf] if numbers.size == 1 else map(float, numbers)
    if not low < high or not low <= start <= high or not math.isfinite(start):
        raise ValueError(f"parameters[{name!r}] = {value!r}: least ≤ guess ≤ most, and least < most")
    return start, low, high


class Model:
    """What the solutions say of all data, one after the other, as a function of the parameters."""

    def __init__(self, records: list[Record], parameters: list[Parameter], options: dict[str, Any]):
        self.records, self.parameters, self.options = records, parameters, options
        self.data = np.concatenate([record.data.ravel() for record in records])
        self.is_estimated = records[0].sigma is None
        # Where sigma is not given residuals are in units of the data's size.
        self.unit = float(np.abs(self.data).max()) if self.is_estimated else 1.0
        self.sigma = np.concatenate(
            [np.full(r.data.size, self.unit) if r.sigma is None else r.sigma.ravel() for r in records]
        )
        self.failure = ""
        self.tried = 0
        self.tell: Report | None = None
        self.far: float | None = None  # residuals where runs fail, larger than all of the first guess

    def parts(self, values: Array) -> list[Array]:
        """Those of each record, in the shape of its data."""
        ends = np.cumsum([record.data.size for record in self.records])[:-1]
        return [part.reshape(record.shape) for part, record in zip(np.split(values, ends), self.records)]

    def problem(self, k: int, x: Array) -> Problem | Case:
        changes = [override(p.key, float(value)) for p, value in zip(self.parameters, x) if p.record in (None, k)]
        given = self.records[k].given
        if isinstance(given, Case):
            return Case(given._file, [*given._overrides, *changes], given._written)
        assert given._text is not None
        return of_text(given._text, True, [*given._overrides, *changes])

    def run(self, k: int, x: Array, **options: Any) -> Result:
        record = self.records[k]
        with quietly():  # `fit` looks at the last ones itself
            asked = {"method": record.method} | self.options | options
            result = solve(self.problem(k, x), (record.start, record.t[-1]), t_eval=record.t, **asked)
        if result.status == "interrupted":
            raise KeyboardInterrupt
        return result

    def solved(self, x: Array, **options: Any) -> tuple[list[Result], Array] | None:
        """The solution for each record, and what they say of the data. None where a run failed, and `failure` says why;
        of the first guess a refusal is raised."""
        results, seen = [], []
        for k, record in enumerate(self.records):
            try:
                result = self.run(k, x, **options)
                if not result.success or result.y.shape[1] != record.t.size:
                    self.failure = result.message
                    return None
                seen.append(record.observe(result).ravel())
            except ValueError as error:
                if self.far is None:
                    raise
                self.failure = str(error)
                return None
            results.append(result)
        return results, np.concatenate(seen)

    def residuals(self, x: Array) -> Array:
        solved = self.solved(x)
        weighted: Array = np.full(self.data.size, self.far) if solved is None else (self.data - solved[1]) / self.sigma
        self.tried += 1
        if self.tell is not None:
            self.tell(self.tried, float(weighted @ weighted))
        return weighted

    def begin(self, x: Array) -> None:
        """Raises ValueError where the first guess gives no solution, or where what it gives is no number that can change."""
        for k, parameter in enumerate(self.parameters):
            refused: list[ValueError] = []
            sides = self._sides(x, k)
            for side in sides:
                try:
                    self.problem(parameter.record or 0, side)
                except ValueError as error:
                    refused.append(error)
            if len(refused) == len(sides):
                raise refused[0]
        solved = self.solved(x)
        if solved is None:
            raise RunFailed(f"the run with the first guess does not reach the end of the data: {self.failure}")
        self.far = 10 * max(float(np.abs((self.data - solved[1]) / self.sigma).max()), 1.0)

    def _sides(self, x: Array, k: int) -> list[Array]:
        """x with a little less and a little more of one parameter, as far as its bounds allow."""
        parameter = self.parameters[k]
        width = _WIDTH * max(abs(x[k]), parameter.size)
        values = [value for value in (x[k] - width, x[k] + width) if parameter.low <= value <= parameter.high]
        return [np.where(np.arange(x.size) == k, value, x) for value in values]

    def jacobian(self, x: Array) -> Array:
        """By differences to both sides, or to one at a bound and where runs fail."""
        columns, here = [], None
        for k in range(x.size):
            ends = [(side[k], solved[1]) for side in self._sides(x, k) if (solved := self.solved(side)) is not None]
            if len(ends) == 1:
                here = self.solved(x) if here is None else here
                ends += [] if here is None else [(x[k], here[1])]
            if len(ends) < 2:
                columns.append(np.zeros(self.data.size))
                continue
            (one, seen), (other, seen_there) = ends
            columns.append((seen - seen_there) / (other - one) / self.sigma)
        return np.array(columns).T

    def error_of_steps(self, x: Array, seen: Array, spread: float) -> float:
        """By how much halving the steps moves what is seen, in standard deviations of the measurements."""
        finer = self.solved(x, h=self.options["h"] / 2)
        if finer is None:
            return math.inf
        least = np.maximum(self.sigma * spread, EXACT * np.abs(self.data).max())
        return float((np.abs(seen - finer[1]) / least).max())

    def step_size(self, x: Array) -> float:
        """As long as a run by a loose tolerance takes them; errors are looked at afterwards."""
        spans = [record.t[-1] - record.start for record in self.records]
        longest, span = int(np.argmax(spans)), float(max(spans))
        scale = float(np.abs(as_problem(self.problem(longest, x)).z0).max()) or 1.0
        result = self.run(longest, x, tolerance=1e-4 * scale / span, h=None)
        return span / max(int(result.steps), 4) if result.success else span / 1000
