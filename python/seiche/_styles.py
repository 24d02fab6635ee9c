"""Colours, markers and dashes of curves: those of `seiche plot` (docs/conventions.md, Pictures)."""

from __future__ import annotations

import typing

from . import _core

if typing.TYPE_CHECKING:
    from matplotlib.axes import Axes

# Of curves that belong to no method, one after the other.
CURVES = tuple(_core.curve_colours())

_SHAPES = {"pentagon": "p", "diamond": "D", "triangle_down": "v", "circle": "o", "square": "s", "triangle": "^", "star": "*"}
_DASHES = {"solid": "-", "dashed": "--", "dash_dotted": "-.", "dotted": ":", "long_dashed": (0, (8, 4))}

# Colour, marker, whether it is filled, dash. Shape tells the closure; filled and solid is exponential, open and dashed Cayley.
METHODS = _core.method_styles()


def is_dark(ax: "Axes") -> bool:
    """Is the ground that the axes are drawn on nearer to black than to white?"""
    from matplotlib.colors import to_rgba

    grounds = [to_rgba(colour) for colour in (ax.get_facecolor(), ax.figure.get_facecolor())]
    return next((sum(rgba[:3]) < 1.5 for rgba in grounds if rgba[3] > 0), False)


def on_ground(ax: "Axes", colour: str) -> str:
    """The colour on this ground: what is too dark for a dark one is mixed with white, and black becomes its ink."""
    if not is_dark(ax):
        return colour
    if colour == "#000000":
        return "#E6E8EA"
    rgb = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
    light = (0.30 * rgb[0] + 0.59 * rgb[1] + 0.11 * rgb[2]) / 255
    share = max(0.0, (0.58 - light) / (1 - light))
    return "#" + "".join(f"{round(c + share * (255 - c)):02X}" for c in rgb)


def next_colour(ax: "Axes") -> str:
    """The colour of one more curve on these axes; marks of single states are no curves."""
    return on_ground(ax, CURVES[sum(len(line.get_xdata()) > 1 for line in ax.lines) % len(CURVES)])


def of_method(ax: "Axes", method: str) -> dict[str, typing.Any]:
    """Keywords of a line with markers; a name that is no method has those of one more curve."""
    if method not in METHODS:
        return {"color": next_colour(ax), "marker": "o"}
    colour, shape, filled, dash = METHODS[method]
    style = {"color": on_ground(ax, colour), "marker": _SHAPES[shape], "linestyle": _DASHES[dash]}
    return style if filled else style | {"markerfacecolor": "none"}


def with_style(defaults: dict[str, typing.Any], given: dict[str, typing.Any]) -> dict[str, typing.Any]:
    """The keywords of a line, those given first, by whatever of their names."""
    from matplotlib.cbook import normalize_kwargs
    from matplotlib.lines import Line2D

    return defaults | normalize_kwargs(given, Line2D)
