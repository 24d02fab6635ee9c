"""Pictures of curves, as the program describes them: those of the paper, of a spectrum, of a benchmark.

A picture is {"stem", "title", "caption", "x": axis, "y": axis, "series": […], "slope": whether a line of slope 2 stands beside errors};
an axis {"label", "log": whether, "powers_of_two": whether its numbers are step sizes, "limits": [low, high] or null}; a series {"label",
"x", "y", "colour", "marker", "filled", "dash", "width", "layer", "marked": the numbers of its points with a marker, or null for all}.
"""

from __future__ import annotations

import typing

import numpy as np

from . import curves, names, runs, style

if typing.TYPE_CHECKING:
    from matplotlib.axes import Axes

Description = dict[str, typing.Any]


def picture_of(description: Description) -> runs.Picture:
    rows = sum(bool(series["label"]) for series in description["series"])
    height = 0.68 + 0.03 * max(0, rows - 4)  # of the legend below
    of = (description[key] for key in ("stem", "title", "caption"))
    return runs.on_axes(*of, lambda ax: draw(ax, description), height)


def _shown(picture: Description, series: Description) -> tuple[np.ndarray, np.ndarray]:
    """What is not finite is left out, and what a logarithmic axis cannot show, but for zeros, which get a line of their own."""
    x, y = (np.array(series[name], dtype=float) for name in ("x", "y"))
    keep = np.isfinite(x) & np.isfinite(y)
    keep &= (np.abs(x) < 1e300) & (np.abs(y) < 1e300)
    for values, axis in ((x, picture["x"]), (y, picture["y"])):
        if axis["log"]:
            keep &= (values > 1e-300) | ((values == 0) & (values is y))
    return np.where(keep, x, np.nan), np.where(keep, y, np.nan)


def _on_powers_of_two(ax: "Axes", values: np.ndarray) -> None:
    from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

    powers = np.unique(np.round(np.log2(values)))
    powers = powers[:: -(-len(powers) // 8)]
    ax.set_xscale("log", base=2)
    ax.xaxis.set_major_locator(FixedLocator(list(2.0**powers)))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda h, _: names.step(h)))
    ax.xaxis.set_minor_locator(NullLocator())


def _slope_two(ax: "Axes", points: list[curves.Curve]) -> None:
    """Below all curves, so that it hides none of them."""
    x, y = (np.concatenate(values) for values in zip(*points))
    seen = np.isfinite(x) & np.isfinite(y) & (y > 0)
    if not seen.any():
        return
    h = np.array([np.min(x[seen]), np.max(x[seen])])
    below = 0.35 * np.min(y[seen] / x[seen] ** 2) * h**2
    grey = style.on_ground(ax, "#707070")
    ax.plot(h, below, color=grey, linewidth=0.7, linestyle=style.DASHES["dotted"])
    ax.annotate(
        "slope 2", (h[1], below[1]), (-2, -7), textcoords="offset points", ha="right", va="top", fontsize=6, color=grey
    )


def _zeros_on_a_line(ax: "Axes", points: list[curves.Curve]) -> bool:
    """Moves zeros, which a logarithmic axis cannot show, to a line below it; False without zeros."""
    values = np.concatenate([y for _, y in points]) if points else np.zeros(0)
    positive = values[values > 0]
    if not (values == 0).any() or not positive.size:
        return False
    bottom = 10.0 ** (np.floor(np.log10(positive.min())) - 1)
    for _, y in points:
        y[y == 0] = bottom
    ax.axhline(bottom, color=style.on_ground(ax, "#707070"), linewidth=0.4)
    at_right = {"xycoords": ("axes fraction", "data"), "textcoords": "offset points", "ha": "left", "va": "center"}
    ax.annotate("0", (1, bottom), (3, 0), fontsize=6.5, **at_right)
    return True


def _from_zero(ax: "Axes") -> None:
    """Shows zero too where values differ by round-off alone, which would fill the axis."""
    low, high = ax.dataLim.intervaly
    if 0 < high - low < 1e-9 * max(abs(low), abs(high)):
        ax.set_ylim(min(0.0, 1.1 * low), max(0.0, 1.1 * high))


def draw(ax: "Axes", picture: Description) -> str:
    """Returns what the caption has to say beyond."""
    drawn = [(series, *_shown(picture, series)) for series in picture["series"]]
    drawn = [one for one in drawn if np.isfinite(one[2]).any() or not one[0]["x"]]
    said = ""
    if picture["slope"]:
        _slope_two(ax, [(x, y) for series, x, y in drawn if series["label"]] or [(np.zeros(0), np.zeros(0))])
    if picture["y"]["log"] and _zeros_on_a_line(ax, [(x, y) for _, x, y in drawn]):
        said += " What is exactly zero stands on the line 0 at the bottom, below the logarithmic axis."
    lines = {}
    for series, x, y in drawn:
        label = series["label"]
        colour = style.on_ground(ax, series["colour"])
        marker = style.SHAPES.get(series["marker"])
        marks = {} if marker is None else {"marker": marker, "markevery": series["marked"]}
        (line,) = ax.plot(
            x,
            y,
            color=colour,
            linestyle=style.DASHES[series["dash"]],
            linewidth=series["width"],
            markerfacecolor=colour if series["filled"] else "none",
            label=label.replace("$", r"\$") if label else "_",
            zorder=2 + series["layer"],
            **marks,
        )
        if label and len(x):
            lines[label] = line
    if picture["x"]["powers_of_two"]:
        everything = [x[np.isfinite(x) & (x > 0)] for _, x, _ in drawn]
        if any(len(x) for x in everything):
            _on_powers_of_two(ax, np.concatenate(everything))
    elif picture["x"]["log"] and any((x > 0).any() for _, x, _ in drawn):
        ax.set_xscale("log")
    if picture["y"]["log"] and any((y > 0).any() for _, _, y in drawn):
        ax.set_yscale("log")
    if ax.get_xscale() == "log" and not picture["x"]["powers_of_two"]:
        curves.number_decades(ax.xaxis)
    if ax.get_yscale() == "log":
        curves.number_decades(ax.yaxis)
    else:
        _from_zero(ax)
    ax.set(xlabel=picture["x"]["label"], ylabel=picture["y"]["label"])
    if picture["x"]["log"]:
        ax.margins(x=0.05)
    if picture["x"]["limits"]:
        ax.set_xlim(*picture["x"]["limits"])
    curves.legend(ax)
    points = {series["label"]: (x, y) for series, x, y in drawn if series["label"] in lines}
    return said + _told_apart(_hidden(picture, points), lines)


def _hidden(picture: Description, points: dict[str, curves.Curve]) -> list[list[str]]:
    """Groups of curves that hide one another, as the axes show them; looked for once for both grounds."""
    if "hidden" not in picture:

        def seen(values: np.ndarray, axis: Description) -> np.ndarray:
            with np.errstate(divide="ignore", invalid="ignore"):
                return np.log(values) if axis["log"] else values

        shown = {label: (seen(x, picture["x"]), seen(y, picture["y"])) for label, (x, y) in points.items()}
        picture["hidden"] = curves.coinciding(shown)
    return picture["hidden"]


def _told_apart(groups: list[list[str]], lines: dict[str, typing.Any]) -> str:
    """Of curves that hide one another the first becomes the widest, and those on it narrower."""
    if not groups:
        return ""
    for group in groups:
        widths = np.geomspace(2.8, 0.7, len(group))
        for place, label in enumerate(group):
            lines[label].set(linewidth=widths[place], zorder=4 + place)
    if len(groups) == 1 and len(groups[0]) == len(lines):
        return " All curves coincide within the width of a line, all or nearly all the way; the first is the widest."
    named = "; ".join(names.listed([f"“{label}”" if "," in label else label for label in group]) for group in groups)
    return (
        f" All or nearly all the way these coincide within the width of a line, the first of them the widest: {named}."
    )
