"""Colours, markers and dashes of curves: those of `seiche plot` (docs/conventions.md, Pictures)."""

from __future__ import annotations

import typing

from . import _core
from .drawing import style

if typing.TYPE_CHECKING:
    from matplotlib.axes import Axes

# Colour, marker, whether it is filled, dash. Shape tells the closure; filled and solid is exponential, open and dashed Cayley.
METHODS = _core.method_styles()


def of_method(ax: "Axes", method: str) -> dict[str, typing.Any]:
    """Keywords of a line with markers; a name that is no method has those of one more curve."""
    if method not in METHODS:
        return {"color": style.next_colour(ax), "marker": "o"}
    colour, shape, filled, dash = METHODS[method]
    line = {"color": style.on_ground(ax, colour), "marker": style.SHAPES[shape], "linestyle": style.DASHES[dash]}
    return line if filled else line | {"markerfacecolor": "none"}
