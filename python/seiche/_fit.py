"""Parameters of an equation from measurements."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Mapping, Sequence

import numpy as np

from ._core import methods
from ._problem import Case, Problem, as_problem
from ._progress import Bar, Report, showing
from ._records import EXACT, Model, Observation, Parameter, RunFailed, parameters_of, records_of
from ._result import Answer, say
from ._types import Array, Method, Size

if TYPE_CHECKING:
    import matplotlib.axes

_UNLIKELY = 1e-3
_ALIKE = 0.999  # a correlation of two parameters that the data hardly tell apart
_UNKNOWN = 1e-6  # of the largest singular value: a direction in which the data do not change
_MOST_STEPS = 100_000  # of a run, where h is not given
_MOST_SEARCHES = 6  # with shorter and shorter steps
_NEGLIGIBLE = 1e-3  # of a standard deviation: a search ends where its steps are smaller
_FINEST = 1e-10  # of a parameter: what data without noise tell it to; runs have some 1e-13 of round-off
_CHOSEN_HERE = "t_eval events dense_output observer tolerance h_max z0 t_span ledger record_every".split()


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
        """The measurements, the solution and its band of two standard deviations; in a figure of its own residuals below."""
        from . import plot

        return plot._fit(self, record, axes)

    def _values(self) -> dict[str, str]:
        return {name: _with_error(value, self["std"][name]) for name, value in self["parameters"].items()}

    def __repr__(self) -> str:
        width = max(map(len, self["parameters"]))
        return "\n".join([*(f"{name:<{width}} = {text}" for name, text in self._values().items()), self["message"]])


def _with_error(value: float, std: float) -> str:
    """0.1034 ± 0.0012: two digits of the standard deviation, and the value to the same place."""
    if not (math.isfinite(std) and std > 0):
        return f"{value:.6g} ± {std:.2g}"
    places = max(0, 1 - math.floor(math.log10(std)))
    return f"{value:.{places}f} ± {std:.{places}f}" if places < 12 else f"{value:.12g} ± {std:.2g}"


def fit(
    problem: Problem | Case | Sequence[Problem | Case],
    t: Any,
    data: Any,
    parameters: Mapping[str, Any] | Sequence[str],
    observe: str | Observation | Sequence[Any] | None = None,
    sigma: Any = None,
    *,
    h: Size | None = None,
    method: Method | None = None,
    progress: bool | Report = False,
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
    parameters : dict or list of names
        Name → first guess, or (first guess, least, most); None, or a name in a list, begins with the problem's own value of a key
        with one number, as gamma.
        Names are keys of the problem, ``"gamma"``, with a dot those of
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
        By default that which the case file gives, and else "egc4".
    progress : bool or function
        True: a line on stderr. Or a function of (tried, chi2): how many sets of parameters were tried, and
        Σ(residual/σ)² of the last; without sigma in units of the largest measurement.
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
    for name in _CHOSEN_HERE:
        if name in options:
            raise ValueError(f"fit chooses {name} itself")
    if isinstance(problem, str):
        problem = as_problem(problem)
    records = records_of(problem, t, data, observe, sigma)
    wanted = parameters_of(parameters, records)
    for record in records:
        record.method = method or record.method
    model = Model(records, wanted, options)
    dof = model.data.size - len(wanted)
    if dof <= 0:
        raise ValueError(
            f"{model.data.size} measurements cannot determine {len(wanted)} parameters: more of one than of the other are needed"
        )
    if model.unit == 0:
        raise ValueError("data are all zero, and sigma is not given: nothing says how large an error is")
    with showing(progress, "(tried, chi2)", Bar.search) as model.tell:
        result = _answer(model, *_search(model, dof, h))
    say([result.message], result._remarks)
    return result


def _search(model: Model, dof: int, h: Size | None) -> tuple[Any, Any, float, float]:
    """The least squares, the solutions there, the spread of the residuals, and the error of steps that are short enough."""
    from scipy.optimize import least_squares

    x = np.array([p.start for p in model.parameters])
    model.options["h"] = model.step_size(x) if h is None else h
    model.begin(x)
    orders = {m["name"]: m["order"] for m in methods()}
    order = min(orders.get(record.method) or 2 for record in model.records)
    shortest = max(r.t[-1] - r.start for r in model.records) / _MOST_STEPS
    low, high, size = (np.array([getattr(p, name) for p in model.parameters]) for name in ("low", "high", "size"))
    for attempt in range(_MOST_SEARCHES):
        # In units of the parameters' sizes, since SciPy compares the length of a step with that of all of them.
        # A step of _NEGLIGIBLE standard deviations changes χ², about dof, by _NEGLIGIBLE². Of slopes only 0 ends it.
        found = least_squares(
            lambda u: model.residuals(np.clip(u * size, low, high)),
            x / size,
            lambda u: model.jacobian(np.clip(u * size, low, high)) * size,
            (low / size, high / size),
            x_scale="jac",
            ftol=max(_NEGLIGIBLE**2 / dof, 1e-14),
            xtol=_FINEST,
            gtol=float(np.finfo(float).eps),
        )
        x = np.clip(found.x * size, low, high)
        solved = model.solved(x)
        if solved is None:
            raise RunFailed(f"the search ended where runs fail: {model.failure}")
        spread = math.sqrt(2 * found.cost / dof) if model.is_estimated else 1.0
        error = model.error_of_steps(x, solved[1], spread) if h is None else 0.0
        if error <= 0.1 or attempt == _MOST_SEARCHES - 1 or model.options["h"] <= shortest:
            break
        model.options["h"] = max(model.options["h"] * min(max((0.05 / error) ** (1 / order), 1 / 16), 0.5), shortest)
    found.x, found.jac = x, found.jac / size
    return found, solved, spread, error


def _answer(model: Model, found: Any, solved: Any, spread: float, error: float) -> FitResult:
    import scipy.stats

    records, wanted = model.records, model.parameters
    results, seen = solved
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
    dof = model.data.size - len(wanted)
    chi2 = float(dof) if model.is_estimated else 2 * float(found.cost)
    p_value = None if model.is_estimated else float(scipy.stats.chi2.sf(chi2, dof))
    remarks = [] if found.status > 0 else [f"the search did not end: {found.message}"]
    if error > 0.1:
        remarks.append(f"steps of {model.options['h']:.3g} add errors of up to {error:.2g} sigma: give a smaller h")
    remarks += _unclear(wanted, found, size, V[~is_known], unknown, correlations)
    weighted = [np.atleast_2d(part) for part in model.parts((model.data - seen) / model.sigma)]
    remarks += _misfit(weighted, p_value, chi2 / dof, model.is_estimated and spread <= EXACT)
    remarks += [result.message for result in results if result.law == "violated"]
    sigma = model.sigma * spread
    if model.is_estimated:
        said = f"standard deviation of the residuals {spread * model.unit:.3g}"
    else:
        said = f"χ² = {chi2:.4g} with {dof} degrees of freedom"
    result = FitResult(
        parameters={p.name: float(value) for p, value in zip(wanted, found.x)},
        std={p.name: float(value) for p, value in zip(wanted, std)},
        correlations=correlations,
        covariance=covariance,
        residuals=model.parts(model.data - seen),
        sigma=model.parts(sigma),
        chi2=chi2,
        dof=dof,
        p_value=p_value,
        success=bool(found.status > 0),
        message="; ".join([said, *remarks]),
        results=results,
        h=results[0].report["h"],
        nfev=int(found.nfev),
    )
    variance = np.maximum(np.einsum("ij,jk,ik->i", J, band, J), 0)
    for name, value in {
        "_records": records,
        "_bands": model.parts(np.sqrt(variance) * sigma),
        "_remarks": remarks,
    }.items():
        object.__setattr__(result, name, value)
    return result


def _unclear(
    wanted: list[Parameter],
    found: Any,
    size: Array,
    free: Array,
    unknown: Array,
    correlations: Array,
) -> list[str]:
    """Which parameters the data, or the bounds, do not determine. `free`: directions in which the data do not change."""
    said = []
    for k, parameter in enumerate(wanted):
        if size[k] == 0:
            said.append(f"the data do not depend on {parameter.name}")
        elif found.active_mask[k] != 0:
            said.append(
                f"{parameter.name} ended at its bound {parameter.low if found.active_mask[k] < 0 else parameter.high:g}"
            )
    for direction in free:
        part = [p.name for p, weight, norm in zip(wanted, direction, size) if abs(weight) > 0.1 and norm > 0]
        if len(part) > 1:
            said.append(
                f"the data do not tell {', '.join(part[:-1])} and {part[-1]} apart: only a combination of them is known"
            )
    for i in range(len(wanted)):
        for j in range(i):
            if not (unknown[i] or unknown[j]) and abs(correlations[i, j]) > _ALIKE:
                pair = f"{wanted[j].name} from {wanted[i].name}"
                said.append(f"the data hardly tell {pair}: their correlation is {correlations[i, j]:.6g}")
    return said


def _misfit(weighted: list[Array], p_value: float | None, ratio: float, exact: bool) -> list[str]:
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
    return [
        f"residuals are no noise: neighbours in time are correlated by {correlation:.2f}, so the model misses something"
    ]
