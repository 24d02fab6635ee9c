"""Figures with Matplotlib: energy, fields over space and time, phase portraits, spectra, work and precision.

Each returns the axes it drew on.
"""

from __future__ import annotations

import math as _math
import pathlib as _pathlib
import typing as _typing

import numpy as _np

from . import _ensemble, _problem, _result, _studies, _styles

if _typing.TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["energy", "phase_portrait", "slices", "space_time", "spectrum", "work_precision"]


def __dir__() -> list[str]:
    return __all__


def _axes(ax: "Axes | None") -> "Axes":
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots(layout="constrained")[1]


_GREEK = (
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon phi chi psi omega".split()
)
# Colours of `seiche plot`: perceptually uniform, from both sides of zero on a light ground and on a dark one, or from low to
# high. Crameri, Nature Communications 11 (2020) 5444; Smith and van der Walt, SciPy 2015.
_VIK = ("#001261", "#033E7D", "#1E6F9D", "#71A8C4", "#C9DDE7", "#ECE5E0", "#EACEBD", "#D39774", "#BE6533", "#8B2706", "#590008")
_BERLIN = ("#9EB0FF", "#5BA4DB", "#2D75A0", "#1A4256", "#11191E", "#140F10", "#280D01", "#501802", "#8A3F2A", "#C4756A", "#FFACAC")
_VIRIDIS = "viridis"


def _symbol(name: str) -> str:
    """A name as it is set in print, as in `seiche plot`: u in italics, l₁ with an index, Greek letters."""
    if name in _GREEK:
        return rf"$\{name}$"
    if name[1:].isdigit() or name[1:] in ("x", "y", "z"):
        return f"${name[0]}_{{{name[1:]}}}$"
    return f"${name}$" if len(name) == 1 else "$\\mathit{" + name.replace("_", r"\_") + "}$"


def _size(h: float | None, tolerance: float | None) -> str:
    """The tolerance, or the step size as a power of two where it is one."""
    if tolerance is not None:
        return f"tolerance {tolerance:g}"
    if h is None:
        return ""
    mantissa, exponent = _math.frexp(h)
    return f"$h = 2^{{{exponent - 1}}}$" if mantissa == 0.5 else f"$h$ = {h:g}"


def _title(result: _result.Result | _ensemble.EnsembleResult, what: str) -> str:
    """The problem, or its case file where it was written down and has no name of its own; method; size of steps; what."""
    problem, file = result.problem, result.problem._file
    name = problem.name if problem.name != "custom" else _pathlib.Path(file).stem if file else ""
    sizes = result.get("report", result)
    title = ", ".join(filter(None, (name, result.method, _size(sizes.get("h"), sizes.get("tolerance"))))) + f": {what}"
    return "\n".join(filter(None, (title, _shortfall(result))))


def _shortfall(result: _result.Result | _ensemble.EnsembleResult) -> str:
    """What is said below the title of a run that is not what was asked for, as in `seiche plot`; of members how many."""
    violated = "the energy law is violated"
    if isinstance(result, _ensemble.EnsembleResult):
        words = {word: result.status.count(word) for word in ("failed", "interrupted")}
        words[f"where {violated}"] = result.law.count("violated")
        return ", ".join(f"{count} of {len(result.status)} members {word}" for word, count in words.items() if count)
    ended = "" if result.success else f"{result.status.word} at $t$ = {result.report['t']:.6g}"
    return ", ".join(filter(None, (ended, violated if result.law == "violated" else "")))


def _label(result: _result.Result, field: str) -> str:
    """The meaning of a field and its name, as `seiche plot` writes them."""
    meaning = dict(zip(result.problem.fields, result.problem._core.layout["fields"]))[field][1]
    return _symbol(field) if meaning.startswith("field ") else f"{meaning} {_symbol(field)}"


def _one_run(result: _typing.Any, caller: str) -> None:
    if isinstance(result, _ensemble.EnsembleResult):
        raise ValueError(f"{caller} draws one run, and an ensemble keeps the last states alone: result.field(name); energy draws it")


def _named(result: _result.Result, field: str | None, dimension: int, caller: str) -> str:
    _one_run(result, caller)
    if len(result.problem._core.layout["axes"]) != dimension:
        axes = ", ".join(name for name, _ in result.problem._core.layout["axes"]) or "none"
        raise ValueError(f"{caller} draws fields over {dimension} axes; {result.problem.name} has: {axes}")
    return result.problem.fields[0] if field is None else field


def _diverging(ax: "Axes") -> _typing.Any:
    from matplotlib.colors import LinearSegmentedColormap

    dark = _styles.is_dark(ax)
    return LinearSegmentedColormap.from_list("berlin" if dark else "vik", _BERLIN if dark else _VIK)


def _colours(ax: "Axes", values: _np.ndarray) -> dict[str, _typing.Any]:
    """From both sides of zero, of one length, where values lie there; from the lowest to the highest elsewhere."""
    low, high = float(_np.nanmin(values)), float(_np.nanmax(values))
    top = max(-low, high)
    if low == high and high > 0:
        return {"cmap": _VIRIDIS, "vmin": 0.0, "vmax": 2 * high}
    if low == high or (low < -0.05 * top and high > 0.05 * top):
        return {"cmap": _diverging(ax), "vmin": -(top or 1.0), "vmax": top or 1.0}
    return {"cmap": _VIRIDIS, "vmin": low, "vmax": high}


def _common_colours(ax: "Axes", pictures: _typing.Sequence[_np.ndarray]) -> dict[str, _typing.Any]:
    """A scale for several pictures: that of all their values, but where a few large ones would leave everything else pale, it ends
    where it covers 98 per cent of each picture."""
    scale = _colours(ax, _np.concatenate([_np.ravel(values) for values in pictures]))
    most = max(float(_np.nanquantile(_np.abs(values), 0.98)) for values in pictures)
    if scale["vmin"] == -scale["vmax"] and 0 < most <= 0.5 * scale["vmax"]:
        scale |= {"vmin": -most, "vmax": most}
    return scale


def _image_style(scale: dict[str, _typing.Any], style: dict[str, _typing.Any]) -> dict[str, _typing.Any]:
    """A `norm` of the caller's brings its own limits."""
    if style.get("norm") is not None:
        scale = {"cmap": scale["cmap"]}
    return {"shading": "nearest", "rasterized": True} | scale | style


def _bar(mesh: _typing.Any, ax: _typing.Any, values: _np.ndarray, label: str) -> None:
    """With pointed ends where there are values beyond the scale."""
    low, high = mesh.get_clim()
    below, above = bool(_np.nanmin(values) < low), bool(_np.nanmax(values) > high)
    extend = "both" if below and above else "min" if below else "max" if above else "neither"
    mesh.figure.colorbar(mesh, ax=ax, label=label, extend=extend)


def _curve(ax: "Axes", x: _np.ndarray, y: _np.ndarray, style: dict[str, _typing.Any], **defaults: _typing.Any) -> _typing.Any:
    """One more curve, in the colour that is next."""
    (line,) = ax.plot(x, y, **_styles.with_style({"color": _styles.next_colour(ax)} | defaults, style))
    return line


def _energy_of_members(result: _ensemble.EnsembleResult, ax: "Axes", style: dict[str, _typing.Any]) -> None:
    for name, label, dash in (("energy", "$H$", "-"), ("modified_energy", "modified energy", "--")):
        statistics = result[name]
        if statistics is None:
            continue
        line = _curve(ax, result.t, statistics["mean"], style, linestyle=dash, label=f"{label}, mean")
        band = {"color": line.get_color(), "alpha": 0.2, "linewidth": 0}
        if name == "energy":  # that of the modified energy would lie on it
            ax.fill_between(result.t, statistics["q05"], statistics["q95"], label="$H$, 5 to 95 per cent", **band)
    ax.legend()


def energy(
    result: _result.Result | _ensemble.EnsembleResult, ax: "Axes | None" = None, **style: _typing.Any
) -> "Axes":
    """H over time, and the modified energy where the method has one; of an ensemble, their means and the spread of H."""
    if not isinstance(result, (_result.Result, _ensemble.EnsembleResult)):
        raise TypeError(f"energy draws what seiche.solve or seiche.solve_ensemble returned, not {result!r}")
    ax = _axes(ax)
    if isinstance(result, _ensemble.EnsembleResult):
        _energy_of_members(result, ax, style)
        members, held = len(result.law), result.law.count("holds")
        law = "law holds" if held == members else f"law holds for {held}"
        ax.set(xlabel="time $t$", ylabel="energy $H$", title=_title(result, f"energy of {members} members, {law}"))
        return ax
    _curve(ax, result.t, result.energy, style, label="$H$")
    if result.modified_energy is not None:
        _curve(ax, result.t, result.modified_energy, style, linestyle="--", label="modified energy")
        ax.legend()
    ax.set(xlabel="time $t$", ylabel="energy $H$", title=_title(result, f"energy, law {result.law}"))
    return ax


def space_time(
    result: _result.Result, field: str | None = None, ax: "Axes | None" = None, **style: _typing.Any
) -> "Axes":
    """One field of a problem on a line, over time and place as `seiche plot` draws it; by default the first."""
    name = _named(result, field, 1, "space_time")
    values = result.field(name)
    ax = _axes(ax)
    style = _image_style(_common_colours(ax, [values]), style)
    mesh = ax.pcolormesh(result.t, result.problem.axes[0], values.T, **style)
    _bar(mesh, ax, values, _label(result, name))
    place = result.problem._core.layout["axes"][0][0]
    what = f"{_symbol(name)} in space and time"
    ax.set(xlabel="time $t$", ylabel=place if place == "point" else _symbol(place), title=_title(result, what))
    return ax


def slices(
    result: _result.Result, field: str | None = None, count: int = 4, axes: _typing.Any = None, **style: _typing.Any
) -> _np.ndarray:
    """One field of a problem in the plane at `count` times, from the first to the last; by default the first field.

    All have one scale of colours. Where the largest values differ by more than a factor of four each has its own, so that a wave
    that has died down is not shown as nothing. `axes` are as many as there are pictures; they are returned as an array.
    """
    name = _named(result, field, 2, "slices")
    if count < 1:
        raise ValueError(f"count = {count} must be ≥ 1")
    values = result.field(name)
    times = _np.unique(_np.linspace(0, len(result.t) - 1, count).astype(int))
    if axes is None:
        import matplotlib.pyplot as plt

        columns = min(2, len(times))
        figure, grid = plt.subplots(-(-len(times) // columns), columns, layout="constrained", squeeze=False)
        for unused in grid.ravel()[len(times) :]:
            unused.remove()
        axes = grid.ravel()[: len(times)]
    axes = _np.atleast_1d(axes).ravel()
    if len(axes) != len(times):
        raise ValueError(f"{len(axes)} axes for pictures at {len(times)} times")
    sizes = _np.abs(values[times]).max(axis=(1, 2))
    seen = sizes > 1e-9 * sizes.max()  # the others are zero but for round-off
    own = bool(seen.any()) and sizes.max() > 4 * sizes[seen].min()
    x, y = result.problem.axes
    scales = [_colours(axes[0], picture) for picture in (values[times], *values[times[seen]])]
    signed = any(scale["vmin"] == -scale["vmax"] for scale in scales)
    mesh = None
    for ax, k, size, visible in zip(axes, times, sizes, seen):
        scale = _common_colours(ax, values[times])
        if own:  # one kind of colours for all, and from zero: what is left of a field may be nearly constant
            size = size if visible else sizes.max()
            scale = _colours(ax, _np.array([-size, size]) if signed else _np.append(values[k] if visible else values[times], 0))
        mesh = ax.pcolormesh(x, y, values[k].T, **_image_style(scale, style))
        ax.set(xlabel="$x$", ylabel="$y$", title=f"$t$ = {result.t[k]:.4g}", aspect="equal")
        if own:
            _bar(mesh, ax, values[k], _symbol(name))
    if not own:
        _bar(mesh, list(axes), values[times], _label(result, name))
    axes[0].figure.suptitle(_title(result, f"{_symbol(name)} at some times"))
    return axes


def _mean_corner(x: _np.ndarray, y: _np.ndarray) -> float:
    """Between one state and the next, as it is seen, in radians; long pieces count more."""
    z = (x - x.min()) / (_np.ptp(x) or 1.0) + 1j * (y - y.min()) / (_np.ptp(y) or 1.0)
    pieces = _np.diff(z)
    weights = _np.abs(pieces[1:]) + _np.abs(pieces[:-1])
    return float(_np.average(_np.abs(_np.angle(pieces[1:] * pieces[:-1].conj())), weights=weights)) if weights.sum() > 0 else 0.0


def phase_portrait(
    result: _result.Result,
    x: str | None = None,
    y: str | None = None,
    point: int | None = None,
    ax: "Axes | None" = None,
    **style: _typing.Any,
) -> "Axes":
    """One field over another, by default a momentum over its coordinate, with the start (open circle) and the end (filled square).

    Every point is a curve, unless `point` chooses one, from 0. Where fewer than 24 states make a turn they are shown as dots on a
    thin line, and where fewer than 6 do, without it: corners are not of the solution, and a smaller step between records, or
    t_eval, gives more states.
    """
    _one_run(result, "phase_portrait")
    fields = result.problem.fields
    if len(fields) < 2:
        raise ValueError(f"{result.problem.name} has one field, {fields[0]}; a phase portrait draws two")
    x = fields[0] if x is None else x
    if y is None:  # the partner stands half of the fields behind; of an odd number the next
        apart = len(fields) // 2 if len(fields) % 2 == 0 else 1
        y = fields[(fields.index(x) + apart) % len(fields)] if x in fields else next(name for name in fields if name != x)
    across, up = (result.field(name).reshape(len(result.t), -1) for name in (x, y))
    if point is not None:
        if not 0 <= point < across.shape[1]:
            raise ValueError(f"there is no point {point}; they are 0 to {across.shape[1] - 1}")
        across, up = across[:, [point]], up[:, [point]]
    ax = _axes(ax)
    corner = max(_mean_corner(a, b) for a, b in zip(across.T, up.T))
    dots: dict[str, _typing.Any] = {}
    if corner > _np.pi / 12:
        dots = {"marker": ".", "markersize": 3, "linewidth": 0.4} | ({"linestyle": "none"} if corner > _np.pi / 3 else {})
    for a, b in zip(across.T, up.T):
        _curve(ax, a, b, style, **dots)
        ax.plot(a[0], b[0], "o", mfc="none", color=_styles.on_ground(ax, "#000000"))
        ax.plot(a[-1], b[-1], "s", color=_styles.on_ground(ax, "#000000"))
    ax.set(xlabel=_label(result, x), ylabel=_label(result, y), title=_title(result, "phase portrait"))
    return ax


def spectrum(
    problem: _problem.Problem | _problem.Case,
    method: str | None = None,
    h: float | str | None = None,
    ax: "Axes | None" = None,
    **options: _typing.Any,
) -> "Axes":
    """The decay that one step gives each mode over its frequency, beside that of the equation."""
    study = _studies.spectrum(problem, method, h, **options)
    rows = study["modes"]
    of = {key: _np.array([row[key] for row in rows], dtype=float) for key in rows[0] if key.startswith(("exact", "numerical"))}
    ax = _axes(ax)
    ink = _styles.on_ground(ax, "#000000")
    ax.plot(of["exact_frequency"], of["exact_decay"], "o", mfc="none", color=ink, label="exact")
    colour = _styles.of_method(ax, study["method"])["color"]
    ax.plot(of["numerical_frequency"], of["numerical_decay"], ".", color=colour, label=study["method"])
    ax.update_datalim([(of["exact_frequency"][0], 0.0)])  # or round-off would fill the axis
    ax.autoscale_view()
    ax.set(xlabel="frequency", ylabel="decay rate", title=f"{study['problem']}, h = {study['h']:.4g}")
    ax.legend()
    return ax


def work_precision(
    problem: _problem.Problem | _problem.Case,
    methods: str | _typing.Sequence[str],
    h: float | str | _typing.Sequence[float | str],
    t_end: float | None = None,
    ax: "Axes | None" = None,
    **options: _typing.Any,
) -> "Axes":
    """The error of methods at several step sizes over the CPU time it took, against a tight reference."""
    rows = _studies.converge(problem, methods, h, t_end, **options)["rows"]
    ax = _axes(ax)
    for method in dict.fromkeys(row["method"] for row in rows):
        mine = [row for row in rows if row["method"] == method and row["error"] and row["cpu_seconds"]]
        x, y = ([row[key] for row in mine] for key in ("cpu_seconds", "error"))
        ax.loglog(x, y, **_styles.of_method(ax, method), label=method)
    ax.set(xlabel="CPU time in seconds", ylabel="error (max norm)")
    ax.legend()
    return ax
