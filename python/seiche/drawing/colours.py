"""From values to colours: the ends of a scale, its palette, and what is said where values lie beyond it."""

from __future__ import annotations

import typing

import numpy as np

from . import names, style

if typing.TYPE_CHECKING:
    from matplotlib.axes import Axes

_NEARLY_ALL = 0.98  # of the values of a picture; whether they have both signs is asked of these
Range = tuple[float, float]


class Look(typing.NamedTuple):
    """What one asks for. A range is that of the scale; a centre is the value of the middle colour."""

    range: Range | None = None
    centre: float | None = None
    palette: str | None = None
    ranges: typing.Mapping[str, Range] = {}  # of single fields, instead of that of all

    def of(self, field: str) -> Look:
        """What is asked for of one field."""
        return self._replace(range=self.ranges.get(field, self.range), ranges={})


class Scale(typing.NamedTuple):
    low: float
    high: float
    is_diverging: bool  # from both sides of the middle
    palette: str | None = None  # instead of that of the house
    least: float = 0.0  # of all values
    most: float = 0.0
    usual: Range | None = None  # between which nearly all lie, where those have few of the colours

    def style(self, ax: "Axes") -> dict[str, typing.Any]:
        """Keywords of an image."""
        cmap = self.palette or (style.diverging(ax) if self.is_diverging else "viridis")
        return {"cmap": cmap, "vmin": self.low, "vmax": self.high}

    def remark(self) -> str:
        """Where values lie beyond the scale, or nearly all have few of its colours, a sentence, with a blank before it."""
        beyond = [f"down to {names.number(self.least)}"] * (self.least < self.low)
        beyond += [f"up to {names.number(self.most)}"] * (self.most > self.high)
        if beyond:
            return (
                f" The scale goes from {names.number(self.low)} to {names.number(self.high)}; beyond its pointed ends, "
                f"{' and '.join(beyond)}, colours stay as they are there."
            )
        if self.usual is None:
            return ""
        low, high = self.usual
        if names.number(low) == names.number(high):
            return ""  # a range of so many digits is nothing to type
        between = f"{names.number(low)} and {names.number(high)}"
        return f" Nearly all values lie between {between}: --range {low:.6g},{high:.6g} shows those with more colours."


class Extent(typing.NamedTuple):
    """Of a picture: its smallest and its largest value, those between which nearly all lie, and the middle one."""

    least: float
    most: float
    low: float
    high: float
    rest: float


def extent_of(values: np.ndarray) -> Extent:
    """Of the values that are finite."""
    values = values[np.isfinite(values)]
    if not values.size:
        values = np.zeros(1)
    low, rest, high = (float(x) for x in np.quantile(values, (1 - _NEARLY_ALL, 0.5, _NEARLY_ALL)))
    return Extent(float(values.min()), float(values.max()), low, high, rest)


def _have_both_signs(whole: Extent) -> bool:
    """In earnest, a twentieth of the largest away from zero: nearly all of the values; or a few of them, as of a wave in a wide field,
    where the others are at rest at zero."""
    top, near = max(-whole.least, whole.most), max(-whole.low, whole.high)
    if near > 1e-3 * top and whole.low < -0.05 * near and whole.high > 0.05 * near:
        return True
    return abs(whole.rest) <= 0.1 * top and whole.least < -0.05 * top and whole.most > 0.05 * top


def common_scale(extents: typing.Sequence[Extent], look: Look = Look()) -> Scale:
    """One scale for several pictures. It holds every finite value, since a soliton covers little of a picture and its height
    is what one looks for, unless a range is asked for; where values lie on both sides of zero in earnest it is as long on both.
    """
    least, low = (min(getattr(one, name) for one in extents) for name in ("least", "low"))
    most, high = (max(getattr(one, name) for one in extents) for name in ("most", "high"))
    rest = max((one.rest for one in extents), key=abs)
    is_diverging = (
        look.centre is not None or least == most == 0 or _have_both_signs(Extent(least, most, low, high, rest))
    )

    def scale(begin: float, end: float, is_diverging: bool = is_diverging) -> Scale:
        usual = None if look.range else _usual(begin, end, Extent(least, most, low, high, rest), is_diverging)
        return Scale(begin, end, is_diverging, look.palette, least, most, usual)

    if look.range is not None:  # zero stays the middle of colours from both sides of it
        return scale(*look.range, is_diverging and look.range[0] == -look.range[1])
    if is_diverging:
        centre = look.centre or 0.0
        far = max(most - centre, centre - least) or 1.0
        return scale(centre - far, centre + far)
    if least == most:
        return scale(min(0.0, 2 * most), max(0.0, 2 * most))
    return scale(least, most)


def _usual(begin: float, end: float, whole: Extent, is_diverging: bool) -> Range | None:
    """Ends of a scale of nearly all values, of two digits, where they have less than a quarter of this one."""
    far = max(abs(whole.low - (begin + end) / 2), abs(whole.high - (begin + end) / 2))
    low, high = ((begin + end) / 2 - far, (begin + end) / 2 + far) if is_diverging else (whole.low, whole.high)
    if not 0 < high - low < 0.25 * (end - begin):
        return None
    digit = 10.0 ** (np.floor(np.log10(high - low)) - 1)
    return float(np.floor(low / digit) * digit), float(np.ceil(high / digit) * digit)


def scale_of(pictures: typing.Sequence[np.ndarray], look: Look = Look()) -> Scale:
    """common_scale of their extents."""
    return common_scale([extent_of(values) for values in pictures], look)


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
