"""From values to colours: the ends of a scale, its palette, and what is said where values lie beyond it."""

from __future__ import annotations

import typing

import numpy as np

from . import names, style

if typing.TYPE_CHECKING:
    from matplotlib.axes import Axes

_COVERED = 0.98  # of the values of each picture, where a few large ones would leave everything else pale


class Look(typing.NamedTuple):
    """What one asks for. A range is that of the scale; a centre is the value of the middle colour."""

    range: tuple[float, float] | None = None
    centre: float | None = None
    palette: str | None = None


class Scale(typing.NamedTuple):
    low: float
    high: float
    is_diverging: bool  # from both sides of a centre
    palette: str | None = None  # instead of that of the house
    least: float = 0.0  # of all values
    most: float = 0.0

    def style(self, ax: "Axes") -> dict[str, typing.Any]:
        """Keywords of an image."""
        cmap = self.palette or (style.diverging(ax) if self.is_diverging else "viridis")
        return {"cmap": cmap, "vmin": self.low, "vmax": self.high}

    def remark(self) -> str:
        """Where values lie beyond the scale, a sentence, with a blank before it."""
        beyond = [f"down to {names.number(self.least)}"] * (self.least < self.low) + [
            f"up to {names.number(self.most)}"
        ] * (self.most > self.high)
        if not beyond:
            return ""
        ends = f"{names.number(self.low)} to {names.number(self.high)}"
        return (
            f" The scale goes from {ends}, so that small values are seen; beyond its pointed ends, {' and '.join(beyond)}, "
            "colours stay as they are there."
        )


def _have_both_signs(pictures: list[np.ndarray], low: float, high: float, top: float) -> bool:
    """In earnest, a twentieth of the largest away from zero: nearly all of the values, which lie from `low` to `high`; or a few of
    them, as of a wave in a wide field, where the others are at rest at zero."""
    near = max(-low, high)
    if near > 1e-3 * top and low < -0.05 * near and high > 0.05 * near:
        return True
    least, most = min(values.min() for values in pictures), max(values.max() for values in pictures)
    rest = max(abs(float(np.median(values))) for values in pictures)
    return bool(rest <= 0.1 * top and least < -0.05 * top and most > 0.05 * top)


def scale_of(pictures: typing.Sequence[np.ndarray], look: Look = Look()) -> Scale:
    """One scale for several pictures.

    Where values lie on both sides of zero in earnest it is as long on both, and else it goes from the lowest to the highest. Where
    that leaves nearly all of every picture in the inner half of the colours, it ends where it covers 98 per cent of each.
    """
    finite = [values[np.isfinite(values)] for values in pictures]
    finite = [values for values in finite if values.size] or [np.zeros(1)]
    least, most = (float(f([f(values) for values in finite])) for f in (min, max))
    low, high = (
        pick([float(np.quantile(values, q)) for values in finite]) for pick, q in ((min, 1 - _COVERED), (max, _COVERED))
    )
    top = max(-least, most)
    is_diverging = look.centre is not None or _have_both_signs(finite, low, high, top) or least == most == 0
    if look.range is not None:
        return Scale(*look.range, is_diverging, look.palette, least, most)
    if is_diverging:
        centre = look.centre or 0.0
        far = max(most - centre, centre - least)
        near = max(float(np.quantile(np.abs(values - centre), _COVERED)) for values in finite)
        far = (near if 0 < near <= 0.5 * far else far) or 1.0
        return Scale(centre - far, centre + far, True, look.palette, least, most)
    if least == most:
        return Scale(min(0.0, 2 * most), max(0.0, 2 * most), False, look.palette, least, most)
    if high - low > 0 and high - low <= 0.5 * (most - least):
        return Scale(low, high, False, look.palette, least, most)
    return Scale(least, most, False, look.palette, least, most)


def scales_of(pictures: typing.Sequence[np.ndarray], look: Look = Look()) -> list[Scale]:
    """One for all pictures, as often as there are pictures; or, where their largest values differ by more than a factor of four, each
    its own, all of one kind, so that a wave that has died down is not shown as nothing."""
    common = scale_of(pictures, look)
    sizes = np.array([np.nanmax(np.abs(values), initial=0) for values in pictures])
    seen = sizes > 1e-9 * sizes.max()  # the others are zero but for round-off
    if look != Look(palette=look.palette) or not seen.any() or sizes.max() <= 4 * sizes[seen].min():
        return [common] * len(pictures)
    one_of_a_kind = [scale_of([values], look) for values, shown in zip(pictures, seen) if shown]
    signed = common.is_diverging or any(scale.is_diverging for scale in one_of_a_kind)
    scales = []
    for values, size, shown in zip(pictures, sizes, seen):
        size = size if shown else sizes.max()
        # From zero: what is left of a field may be nearly constant.
        low = -size if signed else min(0.0, float(np.nanmin(values)))
        high = size if signed or np.nanmax(values) > 0 else 0.0
        scales.append(Scale(low, high, signed, look.palette, float(np.nanmin(values)), float(np.nanmax(values))))
    return scales


def add_bar(mesh: typing.Any, ax: typing.Any, scale: Scale, label: str, rows: int = 1) -> typing.Any:
    """A bar beside these axes, with pointed ends where there are values beyond the scale."""
    below, above = scale.least < scale.low, scale.most > scale.high
    extend = "both" if below and above else "min" if below else "max" if above else "neither"
    bar = mesh.figure.colorbar(mesh, ax=ax, label=label, extend=extend, pad=0.02, aspect=28 * rows)
    bar.outline.set_linewidth(0.4)
    return bar
