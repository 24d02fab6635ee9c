"""One look for all pictures: grounds, colours, and how each method is drawn (docs/conventions.md, Pictures)."""

from __future__ import annotations

import contextlib
import pathlib
import textwrap
import typing

from . import names

if typing.TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap
    from matplotlib.figure import Figure

# Of curves that belong to no method, one after the other.
CURVES = ("#0072B2", "#D55E00", "#117733", "#AA4499", "#E69F00", "#707070")
DASHES = {
    "solid": "-",
    "dashed": (0, (5, 2.5)),
    "dash_dotted": (0, (6, 2, 1.2, 2)),
    "dotted": (0, (1, 1.5)),
    "long_dashed": (0, (8, 4)),
}
SHAPES = {
    "pentagon": "p",
    "diamond": "D",
    "triangle_down": "v",
    "circle": "o",
    "square": "s",
    "triangle": "^",
    "star": "*",
}

_WARNING = "#D0402F"

# Perceptually uniform, from both sides of a centre on a light ground and on a dark one. Crameri, Nature Communications
# 11 (2020) 5444.
_VIK = (
    "#001261",
    "#033E7D",
    "#1E6F9D",
    "#71A8C4",
    "#C9DDE7",
    "#ECE5E0",
    "#EACEBD",
    "#D39774",
    "#BE6533",
    "#8B2706",
    "#590008",
)
_BERLIN = (
    "#9EB0FF",
    "#5BA4DB",
    "#2D75A0",
    "#1A4256",
    "#11191E",
    "#140F10",
    "#280D01",
    "#501802",
    "#8A3F2A",
    "#C4756A",
    "#FFACAC",
)


class Ground(typing.NamedTuple):
    suffix: str  # of the files
    paper: str
    ink: str
    grid: str


GROUNDS = {
    "light": Ground("", "#FFFFFF", "#000000", "#DEDEDE"),
    "dark": Ground("_dark", "#15181C", "#E6E8EA", "#363C44"),
}


@contextlib.contextmanager
def on(ground: Ground, settings: typing.Mapping[str, typing.Any] = {}) -> typing.Iterator[None]:
    """Figures made inside are drawn on this ground, in the style of the house but for these settings of Matplotlib."""
    import matplotlib

    ink = {key: ground.ink for key in ("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color")}
    paper = {key: ground.paper for key in ("figure.facecolor", "axes.facecolor", "savefig.facecolor")}
    style = pathlib.Path(__file__).with_name("seiche.mplstyle")
    with matplotlib.rc_context(ink | paper | {"grid.color": ground.grid}):
        matplotlib.rcParams.update(matplotlib.rc_params_from_file(style, use_default_template=False))
        matplotlib.rcParams.update(settings)
        yield


def set_offsets(figure: "Figure") -> None:
    """The power of ten that the numbers of an axis share, as 10⁻⁵. As formulas they would be set many times more slowly."""
    from matplotlib.ticker import ScalarFormatter

    for ax in figure.axes:
        for axis in (ax.xaxis, ax.yaxis):
            formatter = axis.get_major_formatter()
            if isinstance(formatter, ScalarFormatter):
                given = formatter.get_offset
                formatter.get_offset = lambda given=given: names.offset(given())


def title(figure: "Figure", text: str, warning: str) -> None:
    """Above a figure, at its left end, with a line in red below it for what a run falls short of."""
    points = figure.get_figwidth() * 72
    letters = int(points / (0.58 * _title_size()))  # of a line
    lines = textwrap.wrap(text.replace(" = ", "\u00a0=\u00a0"), letters) or [""]  # h = 0.1 stays on one line
    plain = {"ha": "left", "parse_math": False}
    top = 1 - 0.03 / figure.get_figheight()  # where a layout puts it, and it stands without one
    figure.suptitle("\n".join(lines) + ("\n" if warning else ""), x=0.012, **plain).set_y(top)
    if warning:
        # On the line that is left empty: whoever lays out a figure makes room for its title alone.
        height = 1.2 * _title_size() / 72 / figure.get_figheight()
        at = top - len(lines) * height
        figure.text(0.012, at, warning, color=_WARNING, va="top", fontsize=_title_size(), **plain)


def _title_size() -> float:
    import matplotlib
    from matplotlib.font_manager import FontProperties

    return float(FontProperties(size=matplotlib.rcParams["figure.titlesize"]).get_size_in_points())


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
        return GROUNDS["dark"].ink
    rgb = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
    light = (0.30 * rgb[0] + 0.59 * rgb[1] + 0.11 * rgb[2]) / 255
    share = max(0.0, (0.58 - light) / (1 - light))
    return "#" + "".join(f"{round(c + share * (255 - c)):02X}" for c in rgb)


def next_colour(ax: "Axes") -> str:
    """The colour of one more curve on these axes; marks of single states are no curves."""
    return on_ground(ax, CURVES[sum(len(line.get_xdata()) > 1 for line in ax.lines) % len(CURVES)])


def sequence(ax: "Axes") -> "Colormap":
    """Colours of curves in a sequence of times: viridis without the end that would vanish on the ground."""
    import matplotlib
    from matplotlib.colors import ListedColormap

    low, high = (64, 256) if is_dark(ax) else (0, 208)
    return ListedColormap([matplotlib.colormaps["viridis"](k) for k in range(low, high)])


def in_sequence(ax: "Axes", share: float) -> typing.Any:
    """One of them, from 0 to 1."""
    return sequence(ax)(share)


def diverging(ax: "Axes") -> "Colormap":
    from matplotlib.colors import LinearSegmentedColormap

    name, colours = ("berlin", _BERLIN) if is_dark(ax) else ("vik", _VIK)
    return LinearSegmentedColormap.from_list(name, colours)


def with_style(defaults: dict[str, typing.Any], given: typing.Mapping[str, typing.Any]) -> dict[str, typing.Any]:
    """The keywords of a line, those given first, by whatever of their names."""
    from matplotlib.cbook import normalize_kwargs
    from matplotlib.lines import Line2D

    return defaults | normalize_kwargs(dict(given), Line2D)
