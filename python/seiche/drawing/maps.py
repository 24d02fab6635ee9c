"""Coloured maps: a field over place and time, and in planes."""

from __future__ import annotations

import typing

import numpy as np

from . import colours, curves, names

if typing.TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_CELLS = 900  # along an axis: more are not seen on paper


def image(
    ax: "Axes",
    x: np.ndarray,
    y: np.ndarray,
    values: np.ndarray,
    scale: colours.Scale,
    given: typing.Mapping[str, typing.Any] = {},
) -> typing.Any:
    """Values with one row for each x, and one column for each y, on cells around the points. A `norm` of the caller's brings its own
    limits."""
    limits = scale.style(ax)
    if given.get("norm") is not None:
        limits = {"cmap": limits["cmap"]}
    ax.grid(False)
    cells = (x, y) if "shading" in given else (_edges(x), _edges(y))
    return ax.pcolormesh(*cells, values.T, **({"shading": "flat", "rasterized": True} | limits | dict(given)))


def every_seen(points: int) -> int:
    """Every so many of them are shown, where there are more than are seen."""
    return -(-points // MOST_CELLS)


def _edges(x: np.ndarray) -> np.ndarray:
    """Of the cells around points; the first reaches to the end of the line at 0."""
    if len(x) == 1:
        return np.array([x[0] - 0.5, x[0] + 0.5])
    middles = (x[1:] + x[:-1]) / 2
    begin = curves.begin_of(x)
    return np.concatenate([[2 * x[0] - middles[0] if begin is None else begin], middles, [2 * x[-1] - middles[-1]]])


def space_time(
    ax: "Axes",
    t: np.ndarray,
    axis: tuple[str, np.ndarray],
    values: np.ndarray,
    scale: colours.Scale,
    label: str,
    given: typing.Mapping[str, typing.Any] = {},
) -> None:
    """Time to the right, place upwards; values have one row for each time."""
    mesh = image(ax, t, axis[1], values, scale, given)
    colours.add_bar(mesh, ax, scale, label)
    ax.set(xlabel="time $t$", ylabel=names.place(axis[0]), xlim=(t[0], t[-1]))
    curves.number_points(ax.yaxis, *axis)


def planes(
    axes: typing.Sequence["Axes"],
    pictures: typing.Sequence[np.ndarray],
    places: typing.Sequence[tuple[np.ndarray, np.ndarray]],
    scales: typing.Sequence[colours.Scale],
    label: str,
    symbol: str,
    given: typing.Mapping[str, typing.Any] = {},
) -> None:
    """Pictures of planes side by side, one unit as long along both axes: with one bar, or each with its own."""
    meshes = [
        image(ax, x, y, values, scale, given) for ax, values, (x, y), scale in zip(axes, pictures, places, scales)
    ]
    for ax in axes:
        ax.set_aspect("equal")
    if all(scale == scales[0] for scale in scales):
        place = getattr(axes[0], "get_subplotspec", lambda: None)()  # of axes side by side
        rows = place.get_gridspec().nrows if place is not None else 1
        colours.add_bar(meshes[-1], list(axes), scales[0], label, rows)
    else:
        for mesh, ax, scale in zip(meshes, axes, scales):
            colours.add_bar(mesh, ax, scale, symbol)
