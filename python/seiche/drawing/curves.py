"""Curves: energies and ledger over time, fields over time and along a line, phase portraits, the bars of a truss.

Each function draws on axes that it is given, and returns what its caption has to say beyond what is drawn; curves are (x, y).
"""

from __future__ import annotations

import typing

import numpy as np

from . import names, style

if typing.TYPE_CHECKING:
    from matplotlib.axes import Axes

Curve = tuple[np.ndarray, np.ndarray]
Style = typing.Mapping[str, typing.Any]

FEW_POINTS = 4  # each is shown over time
_TURN = 2 * np.pi
_WIDEST = 3.4  # points, of a line that another lies on


def thinned(curve: Curve, points: int = 1500) -> Curve:
    """No more points than are seen: of each stretch those with the smallest and the largest value, in their order."""
    x, y = (np.asarray(values, dtype=float) for values in curve)
    if len(x) <= 2 * points:
        return x, y
    stretch = -(-2 * len(x) // points)
    whole = len(x) // stretch * stretch
    parts = np.where(np.isfinite(y[:whole]), y[:whole], np.nan).reshape(-1, stretch)
    rows = np.flatnonzero(np.isfinite(parts).any(axis=1))
    first, parts = rows * stretch, parts[rows]
    ends = [[0], np.arange(whole, len(x)), [len(x) - 1]]
    kept = np.unique(np.concatenate([first + np.nanargmin(parts, axis=1), first + np.nanargmax(parts, axis=1), *ends]))
    return x[kept], y[kept]


def spread(count: int, most: int) -> np.ndarray:
    """At most so many of the numbers below `count`, evenly, the first and the last among them."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).astype(int)) if count else np.zeros(0, int)


def add(ax: "Axes", curve: Curve, given: Style = {}, **defaults: typing.Any) -> typing.Any:
    """One more curve, in the colour that is next."""
    (line,) = ax.plot(*curve, **style.with_style({"color": style.next_colour(ax)} | defaults, given))
    return line


def _dash(place: int) -> typing.Any:
    """Of one curve after the other."""
    return style.DASHES[("solid", "dashed", "dash_dotted", "dotted")[place % 4]]


def legend(ax: "Axes", is_below: bool = False) -> None:
    """Of axes with more than one thing to name; inside, where it hides least, or below if it is large."""
    labels = ax.get_legend_handles_labels()[1]
    longest = max(map(len, labels), default=0)
    if is_below or len(labels) > 4 or (longest > 24 and len(labels) > 1):
        columns = 1 if longest > 26 else 2 if longest > 16 else 3 if longest > 12 or len(labels) > 4 else 4
        letters = ax.figure.bbox.width / ax.figure.dpi * 72 / (0.55 * _letter_size())  # beside lines of eight
        columns = max(1, min(columns, int(letters / (longest + 8))))
        # So many letters below the axes, behind their own numbers and label.
        below = {"loc": "upper center", "bbox_to_anchor": (0.5, 0), "borderaxespad": 4.5}
        ax.legend(ncol=columns, columnspacing=1.2, **below)
    elif len(labels) > 1:
        ax.legend(loc="best")


def legend_above(ax: "Axes", rows: int = 1) -> None:
    """Inside, above all curves: the axes end higher, until something more is drawn on them."""
    low, high = ax.get_ylim()
    ax.set_ylim(top=high + (0.06 + 0.11 * rows) * (high - low), auto=True)
    ax.legend(loc="upper center", ncols=3, columnspacing=1.2)


def _letter_size() -> float:
    import matplotlib
    from matplotlib.font_manager import FontProperties

    return float(FontProperties(size=matplotlib.rcParams["legend.fontsize"]).get_size_in_points())


def are_numbered(name: str, places: np.ndarray) -> bool:
    """Points 1, 2, 3, … with nothing between them: those without a place, and the masses of a lattice."""
    return name == "point" or np.array_equal(places, np.arange(1, len(places) + 1))


def begin_of(places: np.ndarray) -> float | None:
    """The end of a line at 0 where the places on it are Δx, 2Δx, …, so that an axis shows it, or None."""
    is_grid = len(places) > 1 and np.isclose(places[0], places[1] - places[0]) and not are_numbered("", places)
    return 0.0 if is_grid else None


def number_points(axis: typing.Any, name: str, places: np.ndarray) -> None:
    """Ticks at points that there are, along an axis of numbered points."""
    if are_numbered(name, places):
        from matplotlib.ticker import MaxNLocator

        axis.set_major_locator(MaxNLocator("auto", steps=[1, 2, 5, 10], integer=True))


def number_decades(axis: typing.Any) -> None:
    """Of a logarithmic axis: powers of ten, and where it has less than two decades also twice and five times them, as far as
    there is room. As formulas the numbers would be set many times more slowly."""
    from matplotlib.ticker import Formatter, LogLocator, NullFormatter, NullLocator

    low, high = axis.get_view_interval()
    is_short = 0 < low < high < 100 * low

    class Numbers(Formatter):
        def __call__(self, x: float, pos: int | None = None) -> str:
            return names.number(x) if is_short else names.power(x)

        def format_ticks(self, values: typing.Sequence[float]) -> list[str]:
            texts = [self(value) for value in values]
            shown = _with_room(axis, values, texts)
            return [text if k in shown else "" for k, text in enumerate(texts)]

    if is_short:
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_minor_locator(NullLocator() if is_short else LogLocator(subs=(2.0, 5.0), numticks=20))
    axis.set_major_formatter(Numbers())
    axis.set_minor_formatter(NullFormatter())


def _with_room(axis: typing.Any, values: typing.Sequence[float], texts: list[str]) -> set[int]:
    """The texts that do not touch one another along a logarithmic axis: powers of ten come first, then five times them."""
    low, high = np.log10(axis.get_view_interval())
    box, is_upright = axis.axes.bbox, axis.axis_name == "y"
    font = axis.get_major_ticks(1)[0].label1.get_size() * axis.axes.figure.dpi / 72
    places = (np.log10(values) - low) / (high - low) * (box.height if is_upright else box.width)
    room = [font * (1.2 if is_upright else 0.64 * len(text) + 0.5) for text in texts]  # 0.64: a digit's width
    first_digit = [f"{value:e}"[0] for value in values]
    shown: set[int] = set()
    for k in sorted(range(len(values)), key=lambda k: ("152".find(first_digit[k]), k)):
        if all(abs(places[k] - places[j]) >= (room[k] + room[j]) / 2 for j in shown):
            shown.add(k)
    return shown


def falls_by_decades(values: np.ndarray) -> bool:
    values = values[np.isfinite(values)]
    return bool(values.size and values.min() > 0 and values.max() >= 100 * values.min())


def _lies_on(a: np.ndarray, b: np.ndarray) -> bool:
    """Do nine tenths of the points of a lie below the line b, drawn wide? Both as seen, in inches."""
    half = _WIDEST / 72 / 2
    begin, along = b[:-1], np.diff(b, axis=0)
    length = np.maximum((along**2).sum(axis=1), 1e-300)

    def share_below(points: np.ndarray) -> float:
        from_begin = points[:, None] - begin
        place = np.clip((from_begin * along).sum(axis=2) / length, 0, 1)
        away = from_begin - place[..., None] * along
        return float(np.mean((away**2).sum(axis=2).min(axis=1) <= half**2))

    return share_below(a[:: -(-len(a) // 24)]) >= 0.7 and share_below(a) >= 0.9


def coinciding(curves: typing.Mapping[str, Curve]) -> list[list[str]]:
    """Groups of curves over one axis that hide one another."""
    shown = {name: np.stack(thinned(curve, 100), axis=1) for name, curve in curves.items()}
    shown = {name: points[np.isfinite(points).all(axis=1)] for name, points in shown.items()}
    shown = {name: points for name, points in shown.items() if len(points) > 1}
    if not shown:
        return []
    everything = np.concatenate(list(shown.values()))
    seen = {
        name: points / (np.where(np.ptp(everything, axis=0) > 0, np.ptp(everything, axis=0), 1.0) / (2.7, 1.8))
        for name, points in shown.items()
    }
    groups: list[list[str]] = []
    for name, points in seen.items():
        for group in groups:
            if all(_lies_on(points, seen[other]) and _lies_on(seen[other], points) for other in group):
                group.append(name)
                break
        else:
            groups.append([name])
    return [group for group in groups if len(group) > 1]


def nest(ax: "Axes", groups: list[list[str]], labels: typing.Mapping[str, str]) -> str:
    """Shows curves that hide one another: the first wide, what lies on it narrower over it. Returns the sentence that says so."""
    lines = {line.get_label(): line for line in ax.lines}
    for group in groups:
        width = _WIDEST
        for place, name in enumerate(group):
            line = lines[labels[name]]
            line.set(linewidth=width, linestyle="-" if place == 0 else style.DASHES["dashed"], zorder=2 + place)
            width *= 0.5
    if not groups:
        return ""
    named = "; ".join(names.listed(group) for group in groups)
    return (
        f" Within the width of a line these coincide: {named}. There the first is the wide line, and what lies on it is "
        "drawn narrower over it."
    )


def energy(ax: "Axes", H: Curve, modified: Curve | None = None, given: Style = {}) -> str:
    """H over time, and the modified energy where there is one; both as the change since the start where the numbers of an axis would
    not show it."""
    t, values = H
    first = float(values[0]) if len(values) else 0.0
    span = max((float(np.nanmax(np.abs(y - first))) for _, y in filter(None, (H, modified)) if len(y)), default=0.0)
    is_change = span < 1e-6 * abs(first)
    shift = first if is_change else 0.0
    symbol = "$H - H(0)$" if is_change else "$H$"
    curves = {"H": (t, values - shift)}
    labels = {"H": symbol, "the modified energy": "modified energy"}
    add(ax, curves["H"], given, label=symbol)
    if modified is not None:
        curves["the modified energy"] = (modified[0], modified[1] - shift)
        add(ax, curves["the modified energy"], given, linestyle="--", label="modified energy")
    if not is_change and all(falls_by_decades(y) for _, y in curves.values()):
        ax.set_yscale("log")
        number_decades(ax.yaxis)
    ax.set(xlabel="time $t$", ylabel=symbol if is_change else "energy $H$")
    said = nest(ax, coinciding(curves), labels) if not given else ""
    legend(ax)
    return (
        (f", as its change since the start, where it is {first:.6g}" if is_change else "")
        + (", and the modified energy whose law the method keeps" if modified is not None else "")
        + "."
        + said
    )


def ledger(ax: "Axes", H: Curve, causes: typing.Mapping[str, Curve]) -> str:
    """The change of H since the start as a thin line, and what it comes from; parts below a thousandth are left out."""
    change = H[0], H[1] - H[1][0]
    largest = max(float(np.ptp(y)) for _, y in (change, *causes.values()))
    shown = {name: curve for name, curve in causes.items() if np.ptp(curve[1]) > 1e-3 * largest}
    for place, (name, curve) in enumerate(shown.items()):
        add(ax, curve, label=name, linestyle=_dash(place), linewidth=1.2)
    ax.plot(*change, color=style.on_ground(ax, "#000000"), linewidth=0.6, label="$H - H(0)$", zorder=3)
    ax.set(xlabel="time $t$", ylabel="change of $H$")
    said = nest(
        ax, coinciding(shown | {"the change": change}), {name: name for name in shown} | {"the change": "$H - H(0)$"}
    )
    legend(ax)
    return said


class Field(typing.NamedTuple):
    name: str
    meaning: str
    values: np.ndarray  # one row for each time, one column for each point

    @property
    def label(self) -> str:
        return names.label(self.meaning, self.name)


def _legend_of_turns(ax: "Axes") -> None:
    """Of curves that fill their axes: they leave no place inside."""
    labels = ax.get_legend_handles_labels()[1]
    legend_above(ax) if 1 < len(labels) <= 3 else legend(ax)


def over_time(ax: "Axes", t: np.ndarray, fields: typing.Sequence[Field]) -> None:
    """Every field at every point over time."""
    for k, field in enumerate(fields):
        points = field.values.shape[1]
        for p in range(points):
            colour = style.on_ground(ax, style.CURVES[(p if points > 1 else k) % len(style.CURVES)])
            which = f", point {p + 1}" if points > 1 else ""
            label = names.symbol(field.name) + which
            ax.plot(
                *thinned((t, field.values[:, p])),
                color=colour,
                linestyle=_dash(k),
                linewidth=0.9,
                label=label,
            )
    ax.set(xlabel="time $t$", ylabel=", ".join(names.symbol(field.name) for field in fields))
    _legend_of_turns(ax)


def fitted(ax: "Axes", t: np.ndarray, data: np.ndarray, fit: np.ndarray, std: np.ndarray) -> None:
    """Measurements as dots, what was fitted as lines in a band of two standard deviations; one row for each point."""
    few = 1 < len(data) <= FEW_POINTS
    for k, (measured, line, wide) in enumerate(zip(data, fit, 2 * std)):
        first = {name: name if k == 0 else None for name in ("measured", "fitted", "± 2 standard deviations")}
        colour = style.on_ground(ax, style.CURVES[k % len(style.CURVES)])
        ax.plot(t, measured, "o", mfc="none", markersize=3, color=colour, label=first["measured"])
        ax.plot(t, line, color=colour, label=f"fitted, point {k + 1}" if few else first["fitted"])
        band = {"color": colour, "alpha": 0.3, "linewidth": 0, "label": first["± 2 standard deviations"]}
        ax.fill_between(t, line - wide, line + wide, **band)
    legend_above(ax, 2 if few else 1)


def residuals(ax: "Axes", t: np.ndarray, weighted: np.ndarray) -> None:
    """Measurement minus solution in standard deviations, with lines at two of them."""
    for k, row in enumerate(weighted):
        ax.plot(t, row, "o", mfc="none", markersize=3, color=style.on_ground(ax, style.CURVES[k % len(style.CURVES)]))
    for level, width in ((-2, 0.5), (0, 0.8), (2, 0.5)):
        ax.axhline(level, color=style.on_ground(ax, "#000000"), linewidth=width, zorder=1)
    most = max(3.0, 1.1 * float(np.abs(weighted).max(initial=0)))
    ax.set(ylabel="residual / σ", ylim=(-most, most), yticks=(-2, 0, 2))


def profiles(ax: "Axes", t: np.ndarray, axis: tuple[str, np.ndarray], field: Field) -> None:
    """A field along a line at some times, in a sequence of colours; numbered points are dots on a thin line."""
    is_dotted = are_numbered(*axis) and len(axis[1]) <= 200
    dots = {"marker": "o", "markersize": 1.8} if is_dotted else {}
    for k in range(len(t)):
        width = (0.5 if dots else 0.8) * (1.6 if k in (0, len(t) - 1) else 1)
        look = {"color": style.in_sequence(ax, k / max(len(t) - 1, 1)), "linewidth": width} | dots
        ax.plot(axis[1], field.values[k], label=f"$t$ = {t[k]:.4g}", **look)
    ax.set(xlabel=names.place(axis[0]), ylabel=field.label)
    ax.margins(x=0)
    ax.set_xlim(left=begin_of(axis[1]))
    number_points(ax.xaxis, *axis)
    ax.legend(loc="upper left", bbox_to_anchor=(1, 1), borderaxespad=0.3, handlelength=1.4)  # where there are no curves


def _mean_corner(x: np.ndarray, y: np.ndarray) -> float:
    """Between one state and the next, as it is seen, in radians; long pieces count more."""
    z = (x - x.min()) / (np.ptp(x) or 1.0) + 1j * (y - y.min()) / (np.ptp(y) or 1.0)
    pieces = np.diff(z)
    weights = np.abs(pieces[1:]) + np.abs(pieces[:-1])
    return (
        float(np.average(np.abs(np.angle(pieces[1:] * pieces[:-1].conj())), weights=weights))
        if weights.sum() > 0
        else 0.0
    )


def portrait(ax: "Axes", across: Field, up: Field, given: Style = {}) -> str:
    """One field over another, with the start (open circle) and the end (filled square); every point is a curve.

    Where fewer than 24 states make a turn they are shown as dots on a thin line, and where fewer than 6 do, without it: corners are
    not of the solution.
    """
    pairs = list(zip(across.values.T, up.values.T))
    corner = max(_mean_corner(a, b) for a, b in pairs)
    dots: dict[str, typing.Any] = {}
    if corner > _TURN / 24:
        dots = {"marker": ".", "markersize": 3, "linewidth": 0.4} | (
            {"linestyle": "none"} if corner > _TURN / 6 else {}
        )
    ink = style.on_ground(ax, "#000000")
    for place, (a, b) in enumerate(pairs):
        add(ax, (a, b), given, **dots, **({"label": f"point {place + 1}"} if 1 < len(pairs) <= FEW_POINTS else {}))
        start, end = ("start", "end") if place == len(pairs) - 1 else (None, None)  # below the points in the legend
        ax.plot(a[0], b[0], "o", mfc="none", color=ink, label=start)
        ax.plot(a[-1], b[-1], "s", color=ink, label=end)
    ax.set(xlabel=across.label, ylabel=up.label)
    ax.margins(0.05)
    _legend_of_turns(ax)
    if not dots:
        return ""
    return f" Dots are the {len(across.values)} states of the run" + (
        ", too far apart to be joined."
        if corner > _TURN / 6
        else f", about {_TURN / corner:.0f} to a turn; the straight lines between them are no part of the solution."
    )


def magnification(largest: float, size: float) -> float:
    """What displacements are multiplied by, so that the largest is seen: 1, or 1, 2 or 5 times a power of ten."""
    seen = 0.02  # of the frame
    if not 0 < largest < seen * size:
        return 1.0
    wanted = 2 * seen * size / largest
    decade = 10.0 ** np.floor(np.log10(wanted))
    return float(max(step * decade for step in (1, 2, 5) if step * decade <= wanted))


def bars(
    ax: "Axes", places: np.ndarray, supports: np.ndarray, ends: np.ndarray, t: np.ndarray, moved: np.ndarray
) -> None:
    """The bars of a truss at rest and at two times: places of points and of supports, and how far to move the points."""
    everything = np.concatenate([places, supports])

    def draw(nodes: np.ndarray, **line: typing.Any) -> None:
        broken = np.insert(nodes[ends], 2, np.nan, axis=1).reshape(-1, 2)
        ax.plot(*broken.T, **line)

    draw(everything, color="#8C8C8C", linewidth=0.6, label="at rest")
    for k, colour in enumerate(style.CURVES[: len(t)]):
        nodes = everything.copy()
        nodes[: len(places)] += moved[k]
        draw(nodes, color=style.on_ground(ax, colour), linewidth=0.8 + 0.3 * k, label=f"$t$ = {t[k]:.4g}")
    ax.plot(*supports.T, "^", color=style.on_ground(ax, "#000000"), label="support")
    ax.set(xlabel="$x$", ylabel="$y$", aspect="equal")
    ax.margins(0.05)
    ax.grid(False)
    legend(ax, is_below=True)
