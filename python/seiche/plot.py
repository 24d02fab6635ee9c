"""Figures with Matplotlib, as `seiche plot` draws them: energy, fields over space and time, phase portraits, spectra, work and precision.

Each returns the axes it drew on; `film` and `report` return the file that they wrote.
"""

from __future__ import annotations

import math as _math
import os as _os
import pathlib as _pathlib
import re as _re
import sys as _sys
import typing as _typing

import numpy as _np

from . import _core, _ensemble, _problem, _progress, _result, _run, _studies, _styles, _types
from .drawing import (
    colours as _colours,
    curves as _curves,
    films as _films,
    maps as _maps,
    names as _names,
    runs as _runs,
)
from .drawing import style as _style

if _typing.TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = [
    "energy",
    "film",
    "phase_portrait",
    "planes",
    "profiles",
    "report",
    "slices",
    "space_time",
    "spectrum",
    "work_precision",
]


def __dir__() -> list[str]:
    return __all__


def _axes(ax: "Axes | None") -> "Axes":
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots(layout="constrained")[1]


def _size_in_text(h: float | None, tolerance: float | None) -> str:
    """Without formulas."""
    return f"tolerance {_names.number(tolerance)}" if tolerance is not None else f"h = {_names.step(h)}" if h else ""


def _size(h: float | None, tolerance: float | None) -> str:
    """The tolerance, or the step size as a power of two where it is one."""
    if tolerance is not None:
        return f"tolerance {tolerance:g}"
    if h is None:
        return ""
    mantissa, exponent = _math.frexp(h)
    return f"$h$ = $2^{{{exponent - 1}}}$" if mantissa == 0.5 else f"$h$ = {h:g}"


def _heading(result: _result.Result | _ensemble.EnsembleResult, size: _typing.Callable[..., str]) -> str:
    """The problem, or its case file where it was written down and has no name of its own; method; size of steps."""
    problem, file = result.problem, result.problem._file
    name = problem.name if problem.name != "custom" else _pathlib.Path(file).stem if file else ""
    sizes = result.get("report", result)
    return ", ".join(filter(None, (name, result.method, size(sizes.get("h"), sizes.get("tolerance")))))


def _title(result: _result.Result | _ensemble.EnsembleResult, what: str) -> str:
    return "\n".join(filter(None, (f"{_heading(result, _size)}: {what}", _shortfall(result))))


def _entitle(ax: "Axes", result: _result.Result | _ensemble.EnsembleResult, what: str) -> None:
    ax.set_title(_in_lines(ax.figure, _title(result, what)))


def _in_lines(figure: _typing.Any, text: str) -> str:
    """A title on as many lines as a narrow figure needs: layouts make no room for those of Matplotlib's own wrapping."""
    from matplotlib import font_manager, rcParams

    size = font_manager.FontProperties(size=rcParams["axes.titlesize"]).get_size_in_points()
    most = 72 * (figure.bbox.width / figure.dpi - 0.7) / (0.52 * size)  # letters, above axes that stand beside the middle
    lines = [""]
    for word in _re.split(r"( |\n)", text):
        if word == "\n" or len(_re.sub(r"[${}^\\]", "", lines[-1] + word)) > most:
            lines.append("")
        lines[-1] += word.strip() if not lines[-1] else word
    return "\n".join(line.rstrip() for line in lines)


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
    return _names.label(meaning, field)


class _Held(_runs.Solution):
    """A result in the place of its solution.h5."""

    def __init__(self, result: _result.Result):
        layout = result.problem._core.layout
        self.path = ""
        self.fields, self.t = result.problem.fields, result.t
        self.axes = [(name, places) for (name, _), places in zip(layout["axes"], result.problem.axes)]
        shape = [len(places) for _, places in self.axes]
        self.points = _math.prod(shape)
        self._file = {name: result.field(name).reshape(-1, *shape) for name in self.fields}
        self._meanings: dict[str, str] = {name: meaning for name, (_, meaning) in zip(self.fields, layout["fields"])}

    def meaning(self, field: str) -> str:
        return self._meanings[field]


def _one_run(result: _typing.Any, caller: str) -> None:
    if isinstance(result, _ensemble.EnsembleResult):
        raise ValueError(
            f"{caller} draws one run, and an ensemble keeps the last states alone: result.field(name); energy draws it"
        )


def _named(result: _result.Result, field: str | None, dimension: int, caller: str) -> str:
    _one_run(result, caller)
    if len(result.problem._core.layout["axes"]) != dimension:
        axes = ", ".join(name for name, _ in result.problem._core.layout["axes"]) or "none"
        raise ValueError(f"{caller} draws fields over {dimension} axes; {result.problem.name} has: {axes}")
    name = str(result.problem.fields[0]) if field is None else field
    result.field(name)  # refuses one that there is not
    return name


def _energy_of_members(result: _ensemble.EnsembleResult, ax: "Axes", style: dict[str, _typing.Any]) -> None:
    H, modified = result.energy, result.modified_energy
    means = {"mean of $H$": (result.t, H["mean"])}
    line = _curves.add(ax, means["mean of $H$"], style, label="mean of $H$")
    if modified is not None:
        means["mean of modified energy"] = (result.t, modified["mean"])
        _curves.add(ax, means["mean of modified energy"], style, linestyle="--", label="mean of modified energy")
    if not style:
        _curves.nest(ax, _curves.coinciding(means), {name: name for name in means})
    # That of the modified energy would lie on it.
    band = {"color": line.get_color(), "alpha": 0.25, "linewidth": 0, "zorder": 1}
    ax.fill_between(result.t, H["q05"], H["q95"], label="5 to 95 per cent of members", **band)
    if all(_curves.falls_by_decades(H[name]) for name in ("q05", "mean", "q95")):
        ax.set_yscale("log")
        _curves.number_decades(ax.yaxis)
    ax.legend()


def energy(result: _result.Result | _ensemble.EnsembleResult, ax: "Axes | None" = None, **style: _typing.Any) -> "Axes":
    """H over time, and the modified energy where the method has one; of an ensemble, their means and the spread of H."""
    if not isinstance(result, (_result.Result, _ensemble.EnsembleResult)):
        raise TypeError(f"energy draws what seiche.solve or seiche.solve_ensemble returned, not {result!r}")
    ax = _axes(ax)
    if isinstance(result, _ensemble.EnsembleResult):
        _energy_of_members(result, ax, style)
        members, held = len(result.law), result.law.count("holds")
        law = "law holds" if held == members else f"law holds for {held}"
        ax.set(xlabel="time $t$", ylabel="energy $H$")
        _entitle(ax, result, f"energy of {members} members, {law}")
        return ax
    modified = result.modified_energy
    _curves.energy(ax, (result.t, result.energy), None if modified is None else (result.t, modified), style)
    _entitle(ax, result, f"energy, law {result.law}")
    return ax


def space_time(
    result: _result.Result, field: str | None = None, ax: "Axes | None" = None, **style: _typing.Any
) -> "Axes":
    """One field of a problem on a line, over time and place as `seiche plot` draws it; by default the first."""
    name = _named(result, field, 1, "space_time")
    values = result.field(name)
    ax = _axes(ax)
    place = result.problem._core.layout["axes"][0][0]
    axis = place, result.problem.axes[0]
    _maps.space_time(ax, result.t, axis, values, _colours.scale_of([values]), _label(result, name), style)
    _entitle(ax, result, f"{_names.symbol(name)} in space and time")
    return ax


def slices(
    result: _result.Result, field: str | None = None, count: int = 4, axes: _typing.Any = None, **style: _typing.Any
) -> "_np.ndarray[_typing.Any, _typing.Any]":
    """One field of a problem in the plane at `count` times, from the first to the last; by default the first field.

    All have one scale of colours. Where the largest values differ by more than a factor of four each has its own, so that a wave
    that has died down is not shown as nothing. `axes` are as many as there are pictures; they are returned as an array.
    """
    name = _named(result, field, 2, "slices")
    if count < 1:
        raise ValueError(f"count = {count} must be ≥ 1")
    values = result.field(name)
    times = _curves.spread(len(result.t), count)
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
    scales = _colours.scales_of(list(values[times]))
    for ax, k in zip(axes, times):
        ax.set(xlabel="$x$", ylabel="$y$", title=f"$t$ = {result.t[k]:.4g}")
    x, y = result.problem.axes
    _maps.planes(
        axes, list(values[times]), [(x, y)] * len(times), scales, _label(result, name), _names.symbol(name), style
    )
    axes[0].figure.suptitle(_in_lines(axes[0].figure, _title(result, f"{_names.symbol(name)} at some times")))
    return _np.asarray(axes)


def _fit(found: _typing.Any, record: int, ax: "Axes | None") -> "Axes":
    """What FitResult.plot draws: one record, and below it in a figure of its own the residuals."""
    one, result, below = found._records[record], found.results[record], None
    if ax is None:
        import matplotlib.pyplot as plt

        shares = {"height_ratios": (3, 1)}
        ax, below = plt.subplots(2, 1, sharex=True, layout="constrained", gridspec_kw=shares)[1]
    rows = one.data, one.observe(result), _np.atleast_2d(found._bands[record])
    _curves.fitted(ax, one.t, *rows)
    ax.set_ylabel(one.name if one.function is not None else _label(result, one.name))
    values = ", ".join(f"{_names.symbol(name)} = {text}" for name, text in found._values().items())
    _entitle(ax, result, f"fit, {values}" if len(values) < 60 else f"fit of {len(found.parameters)} parameters")
    lowest = ax if below is None else below
    if below is not None:
        _curves.residuals(below, one.t, (one.data - rows[1]) / _np.atleast_2d(found.sigma[record]))
    lowest.set_xlabel("time $t$")
    return ax


def profiles(result: _result.Result, field: str | None = None, count: int = 5, ax: "Axes | None" = None) -> "Axes":
    """One field of a problem on a line, over its places at `count` times, from the first to the last; by default the first field."""
    name = _named(result, field, 1, "profiles")
    held, times = _Held(result), _curves.spread(len(result.t), _problem.whole_number("count", count))
    ax = _axes(ax)
    _curves.profiles(ax, result.t[times], held.axes[0], held.field(name, times))
    _entitle(ax, result, f"{_names.symbol(name)} at some times")
    return ax


def planes(
    result: _result.Result, field: str | None = None, figure: _typing.Any = None
) -> "_np.ndarray[_typing.Any, _typing.Any]":
    """One field of a problem in space: its three planes through the middle of the box, at the first and the last time.

    By default the first field, in a figure of its own. Returns the six axes, the planes xy, xz and yz one below the other.
    """
    name = _named(result, field, 3, "planes")
    picture = _runs.planes(_Held(result), name, _colours.Look(), is_box=True)
    if figure is None:
        import matplotlib.pyplot as plt

        figure = plt.figure(figsize=(6.4, 6.4 * picture.height))
    before = len(figure.axes)
    picture.draw(figure)
    figure.suptitle(_in_lines(figure, _title(result, picture.what)))
    return _np.asarray(figure.axes[before : before + 6])


def film(
    result: _result.Result,
    file: _types.File,
    field: str | None = None,
    dark: bool = False,
    progress: bool | _progress.Report = False,
) -> _pathlib.Path:
    """One field of a problem in the plane as a film; by default the first.

    Returns the file: that which was given where it ends in .mp4, .webm, .webp, .apng or .png. Without an ending, .mp4 or .webm is
    appended where ffmpeg is installed. Without ffmpeg it is always a picture that moves, .webp or .apng.
    ``progress`` is True for a bar, or a function that is told the share that is done.
    """
    name = _named(result, field, 2, "film")
    if len(result.t) < 2:
        raise ValueError("a film needs two times at least, and the result has one")
    stem, ending = _pathlib.Path(file), ""
    given = stem.suffix[1:].lower()
    if given in _films.ENDINGS:
        stem, ending = stem.with_suffix(""), given
    elif given in ("gif", "avi", "mov", "mkv", "m4v", "mpg", "mpeg", "wmv", "flv", "ogv", "jpg", "jpeg"):
        raise ValueError(f"unknown ending '.{given}' of a film. Allowed: .{', .'.join(_films.ENDINGS)}")
    if not stem.parent.is_dir():
        raise ValueError(f"there is no folder {stem.parent} for the film")
    held, ground = _Held(result), _style.GROUNDS["dark" if dark else "light"]
    scale = _films.common_scale(held, name, _colours.Look())
    done = 0.0
    with _progress.showing(progress, "the share that is done", _progress.Bar.part) as tell:

        def add(part: float) -> None:
            nonlocal done
            done = min(1.0, done + part)
            if tell is not None:
                tell(done)

        scene = _films.Scene(held, name, ground, scale, _heading(result, _size_in_text), _shortfall(result))
        drawn = _films.draw(scene, add, stem, ending)
    return stem.with_name(drawn["file"])


def report(
    run: _run.CaseRun | _types.File, formats: str | _typing.Sequence[str] = ("png", "pdf", "svg"), film: bool = True
) -> _pathlib.Path:
    """All pictures of a run that left files, and report.html with them, as `seiche plot` makes both.

    Parameters
    ----------
    run : CaseRun or path
        What `seiche.run`, `seiche.resume` or ``result.save`` returned, or the folder.
    formats : str or list of str
        "png", "pdf", "svg"; png always.
    film : bool
        Film a field in the plane too, which takes longest.

    Returns
    -------
    pathlib.Path
        Of report.html, in the folder; pictures are in ``figures`` beside it.
    """
    folder = _os.fspath(run.folder if isinstance(run, _run.CaseRun) else run)
    wanted = [formats] if isinstance(formats, str) else list(formats)
    for name in wanted:
        if name not in ("png", "pdf", "svg"):
            raise ValueError(f"unknown format '{name}'. Allowed: png, pdf, svg")
    programs = _pathlib.Path(__file__).with_name("drawing")
    _core.report(folder, wanted, _problem.truth("film", film), str(programs), _sys.executable)
    return _pathlib.Path(folder) / "report.html"


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
        y = (
            fields[(fields.index(x) + apart) % len(fields)]
            if x in fields
            else next(name for name in fields if name != x)
        )
    across, up = (result.field(name).reshape(len(result.t), -1) for name in (x, y))
    if point is not None:
        if not 0 <= point < across.shape[1]:
            raise ValueError(f"there is no point {point}; they are 0 to {across.shape[1] - 1}")
        across, up = across[:, [point]], up[:, [point]]
    ax = _axes(ax)
    meanings = {name: meaning for name, (_, meaning) in zip(fields, result.problem._core.layout["fields"])}
    _curves.portrait(ax, _curves.Field(x, meanings[x], across), _curves.Field(y, meanings[y], up), style)
    _entitle(ax, result, "phase portrait")
    return ax


def spectrum(
    problem: _problem.Problem | _problem.Case,
    method: _types.Method | None = None,
    h: _types.Size | None = None,
    ax: "Axes | None" = None,
    **options: _typing.Any,
) -> "Axes":
    """The decay that one step gives each mode over its frequency, beside that of the equation."""
    study = _studies.spectrum(problem, method, h, **options)
    rows = study["modes"]
    of = {
        key: _np.array([row[key] for row in rows], dtype=float)
        for key in rows[0]
        if key.startswith(("exact", "numerical"))
    }
    ax = _axes(ax)
    ink = _style.on_ground(ax, "#000000")
    ax.plot(of["exact_frequency"], of["exact_decay"], "o", mfc="none", color=ink, label="exact")
    colour = _styles.of_method(ax, study["method"])["color"]
    ax.plot(of["numerical_frequency"], of["numerical_decay"], ".", color=colour, label=study["method"])
    ax.update_datalim([(of["exact_frequency"][0], 0.0)])  # or round-off would fill the axis
    ax.autoscale_view()
    ax.set(xlabel="frequency", ylabel="decay rate")
    size = _size(study["h"], None)
    ax.set_title(_in_lines(ax.figure, f"{study['problem']}, {study['method']}, {size}: decay of the modes"))
    ax.legend()
    return ax


def work_precision(
    problem: _problem.Problem | _problem.Case,
    methods: _types.Method | _typing.Sequence[_types.Method],
    h: float | str | _typing.Sequence[float | str],
    t_end: float | None = None,
    ax: "Axes | None" = None,
    **options: _typing.Any,
) -> "Axes":
    """The error of methods at several step sizes over the CPU time it took, against a tight reference."""
    study = _studies.converge(problem, methods, h, t_end, **options)
    rows = study["rows"]
    ax = _axes(ax)
    for method in dict.fromkeys(row["method"] for row in rows):
        mine = [row for row in rows if row["method"] == method and row["error"] and row["cpu_seconds"]]
        x, y = ([row[key] for row in mine] for key in ("cpu_seconds", "error"))
        ax.loglog(x, y, **_styles.of_method(ax, method), label=method)
    for axis in (ax.xaxis, ax.yaxis):
        _curves.number_decades(axis)
    ax.set(xlabel="CPU time in seconds", ylabel="error (max norm)")
    ax.set_title(_in_lines(ax.figure, f"{study['problem']}: work and precision"))
    ax.legend()
    return ax
