"""The pictures of a finished run, from its solution.h5 and what `seiche plot` knows of it."""

from __future__ import annotations

import typing

import numpy as np

from . import colours, curves, maps, names

if typing.TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_FEWEST_TIMES = 8  # of a map over time
_MOST_STATES = 20000  # of a curve over time: more are not seen, and take long to read
_MOST_BARS = 4000  # more are a blot
_WIDTH, _HEIGHT = 3.4, 2.4  # inches, as in seiche.mplstyle


Mesh = tuple[np.ndarray, np.ndarray, np.ndarray]  # places of points, of supports, both ends of every bar


class Picture(typing.NamedTuple):
    stem: str  # of the files
    what: str  # the end of its title
    caption: str
    draw: typing.Callable[["Figure"], str]  # returns what the caption has to say beyond
    height: float = _HEIGHT / _WIDTH  # over the width


class Solution:
    """solution.h5: fields over times and places, read as they are asked for."""

    def __init__(self, path: str):
        import h5py

        self.path = path
        self._file = h5py.File(path)
        words = self._file.attrs["fields"]
        self.fields = [str(name) for name in (words.decode() if isinstance(words, bytes) else str(words)).split()]
        rows = min([self._file[name].shape[0] for name in ("t", *self.fields)])
        self.t = self._file["t"][:rows]
        shape = self._file[self.fields[0]].shape[1:]
        places = [] if not shape else ["point"] if "point" in self._file else ["x", "y", "z"][: len(shape)]
        self.axes = [(name, self._file[name][:]) for name in places]
        self.points = int(np.prod(shape))

    @property
    def is_numbered(self) -> bool:
        return bool(self.axes) and self.axes[0][0] == "point"

    def meaning(self, field: str) -> str:
        text = self._file[field].attrs.get("long_name", "")
        return text.decode() if isinstance(text, bytes) else str(text)

    def label(self, field: str) -> str:
        return names.label(self.meaning(field), field)

    def values(self, field: str, times: np.ndarray, every: int = 1) -> np.ndarray:
        """One state for each of these times, which rise, with every n-th point along a line; a few states are read at a time."""
        data, most = self._file[field], max(1, 1_000_000 // self.points)
        states, begin = [], 0
        while begin < len(times):
            end = int(np.searchsorted(times, times[begin] + most))
            slab = data[times[begin] : times[end - 1] + 1]
            states.append(np.ascontiguousarray(slab[times[begin:end] - times[begin]][..., ::every]))
            begin = end
        return np.concatenate(states)

    def plane(self, field: str, k: int, a: int = 0, b: int = 1) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The plane of axes a < b through the middle of the others: x, y and values, no more of them than are seen."""
        every = [maps.every_seen(len(axis)) for _, axis in self.axes]
        cut = tuple(
            slice(None, None, every[n]) if n in (a, b) else len(axis) // 2 for n, (_, axis) in enumerate(self.axes)
        )
        return self.axes[a][1][:: every[a]], self.axes[b][1][:: every[b]], self._file[field][(k, *cut)]

    def field(self, name: str, times: np.ndarray) -> curves.Field:
        return curves.Field(name, self.meaning(name), self.values(name, times).reshape(len(times), -1))

    def mesh(self) -> Mesh | None:
        """Of points that bars join: places of points and of supports in the plane, and both ends of every bar."""
        if not self.is_numbered or "mesh/bars" not in self._file:
            return None
        places = [
            np.asarray(self._file[f"mesh/{name}"])[:, :2] if f"mesh/{name}" in self._file else np.zeros((0, 2))
            for name in ("points", "supports")
        ]
        return places[0], places[1], np.asarray(self._file["mesh/bars"]).astype(int)


def on_axes(
    stem: str, what: str, caption: str, draw: typing.Callable[["Axes"], str | None], height: float = _HEIGHT / _WIDTH
) -> Picture:
    """A picture that is drawn on one pair of axes."""
    return Picture(stem, what, caption, lambda figure: draw(figure.subplots()) or "", height)


def energies(history: typing.Mapping[str, typing.Any]) -> list[Picture]:
    """From {"H": [t, values], "modified": … or null, "causes": [[label, [t, values]], …]}."""
    H, modified = (
        None if history[key] is None else tuple(np.array(values, float) for values in history[key])
        for key in ("H", "modified")
    )
    causes = {label: tuple(np.array(values, float) for values in curve) for label, curve in history["causes"]}
    assert H is not None
    pictures = [on_axes("energy", "energy", "The energy H = ½zᵀMz + V(z)", lambda ax: curves.energy(ax, H, modified))]
    if causes and len(H[0]):
        caption = (
            "Where the change of H since the start comes from: the sum over all steps of each part of the ledger, and the change itself "
            "as a thin line. Parts below a thousandth of it are left out."
        )
        pictures.append(on_axes("ledger", "ledger", caption, lambda ax: curves.ledger(ax, H, causes)))
    return pictures


def _bars(solution: Solution, mesh: Mesh) -> list[Picture]:
    places, supports, ends = mesh
    if not 0 < len(ends) <= _MOST_BARS or len(solution.fields) < 2:
        return []
    chosen = curves.spread(len(solution.t), 2)
    moved = np.stack([solution.field(name, chosen).values for name in solution.fields[:2]], axis=-1)
    extent = np.ptp(np.concatenate([places, supports]), axis=0)
    factor = curves.magnification(float(np.abs(moved).max(initial=0)), float(extent.max()))
    what = "bars" + (f", displacements × {factor:g}" if factor != 1 else "")
    caption = "The bars at the first and the last time, and at rest." + (
        f" Displacements are drawn {factor:g} times as large as they are." if factor != 1 else ""
    )

    def draw(ax: "Axes") -> None:
        curves.bars(ax, places, supports, ends, solution.t[chosen], factor * moved)

    return [on_axes("bars", what, caption, draw, min(1.5, 0.4 + float(extent[1] / (extent[0] or 1.0))))]


def _space_time(solution: Solution, name: str, look: colours.Look) -> Picture:
    # Of steps of several lengths the states nearest to equal distances, so that no more are read than are seen.
    wanted = np.linspace(solution.t[0], solution.t[-1], min(len(solution.t), maps.MOST_CELLS))
    right = np.clip(np.searchsorted(solution.t, wanted), 1, len(solution.t) - 1)
    chosen = np.unique(np.where(wanted - solution.t[right - 1] < solution.t[right] - wanted, right - 1, right))
    place, x = solution.axes[0]
    every = maps.every_seen(len(x))
    x, values = x[::every], solution.values(name, chosen, every)
    scale = colours.scale_of([values], look.of(name))
    caption = f"{names.in_text(name)} over {place} and t, from {len(solution.t)} states.{scale.remark()}"

    def draw(ax: typing.Any) -> None:
        maps.space_time(ax, solution.t[chosen], (place, x), values, scale, solution.label(name))

    return on_axes(f"space_time_{name}", f"{names.in_text(name)} in space and time", caption, draw)


def planes(solution: Solution, name: str, look: colours.Look, is_box: bool) -> Picture:
    """Of a plane four times; of a box its middle planes at the first and the last time."""
    chosen = curves.spread(len(solution.t), 2 if is_box else 4)
    pairs = ((0, 1), (0, 2), (1, 2)) if is_box else ((0, 1),)
    panels = [(solution.plane(name, k, a, b), a, b, solution.t[k]) for a, b in pairs for k in chosen]
    scales = colours.scales_of([picture for (_, _, picture), *_ in panels], look.of(name))
    columns = min(2, len(panels))
    rows = -(-len(panels) // columns)
    common = all(scale == scales[0] for scale in scales)
    said = (
        f" All have one scale of colours.{scales[0].remark()}"
        if common and len(panels) > 1
        else ""
        if common
        else " Each has a scale of colours of its own, because the largest values differ by more than a factor of four."
    )

    def draw(figure: "Figure") -> str:
        figure.set_layout_engine("compressed")
        axes = figure.subplots(rows, columns, squeeze=False).ravel()
        for unused in axes[len(panels) :]:
            unused.remove()
        axes = axes[: len(panels)]
        for ax, (_, a, b, t) in zip(axes, panels):
            ax.set(
                xlabel=names.place(solution.axes[a][0]), ylabel=names.place(solution.axes[b][0]), title=f"$t$ = {t:.4g}"
            )
            if not is_box:
                ax.label_outer()
            elif not ax.get_subplotspec().is_first_col():
                ax.set_ylabel("")
                ax.tick_params(labelleft=False)
        pictures = [picture for (_, _, picture), *_ in panels]
        maps.planes(
            axes, pictures, [(x, y) for (x, y, _), *_ in panels], scales, solution.label(name), names.symbol(name)
        )
        return ""

    tall = max(float(np.ptp(y) / (np.ptp(x) or 1.0)) for (x, y, _), *_ in panels)
    wide = (0.66 if common else 0.54) / columns  # of a panel beside one bar, or with its own
    height = rows * (wide * min(1.6, max(0.25, tall)) + (0.165 if is_box or not common else 0.085)) + 0.1
    what = " in the middle planes" if is_box else " at some times"
    caption = (
        f"{names.in_text(name)} in the three planes through the middle of the box, at the first and the last time."
        if is_box
        else f"{names.in_text(name)} at {len(chosen)} times."
    )
    return Picture(
        ("planes_" if is_box else "slices_") + name, names.in_text(name) + what, caption + said, draw, height
    )


def _profiles(solution: Solution, name: str) -> Picture:
    chosen = curves.spread(len(solution.t), 5)
    field = solution.field(name, chosen)
    caption = f"{names.in_text(name)} at {len(chosen)} times; the first and the last are drawn thicker."
    return on_axes(
        f"profiles_{name}",
        f"{names.in_text(name)} at some times",
        caption,
        lambda ax: curves.profiles(ax, solution.t[chosen], solution.axes[0], field),
    )


def _few_points(solution: Solution) -> list[Picture]:
    chosen = curves.spread(len(solution.t), _MOST_STATES)
    fields = [solution.field(name, chosen) for name in solution.fields]
    t = solution.t[chosen]
    pictures = [on_axes("fields", "solution", "Every field over time.", lambda ax: curves.over_time(ax, t, fields))]
    # Each coordinate with its momentum, which stands half of the fields behind it; of an odd number neighbours.
    apart = len(fields) // 2 if len(fields) % 2 == 0 else 1
    for across, up in zip(fields, fields[apart:]):
        caption = f"Phase portrait: {names.in_text(up.name)} over {names.in_text(across.name)}."

        def draw(ax: typing.Any, across: curves.Field = across, up: curves.Field = up) -> str:
            said = curves.portrait(ax, across, up)
            return said + (" A smaller output.snapshot_every or snapshot_interval leaves more states." if said else "")

        pictures.append(on_axes(f"portrait_{across.name}_{up.name}", "phase portrait", caption, draw))
    return pictures


def pictures_of(solution: Solution, history: typing.Mapping[str, typing.Any], look: colours.Look) -> list[Picture]:
    """All that show this run: energies; fields over time, along a line, in planes."""
    pictures = energies(history)
    if not len(solution.t):
        return pictures
    # Points that bars join are in no order that a map or a curve could show.
    mesh = solution.mesh()
    if mesh is not None:
        pictures += _bars(solution, mesh)
    dimension = len(solution.axes)
    few = dimension == 0 or (solution.is_numbered and solution.points <= curves.FEW_POINTS)
    over_time = (
        dimension == 1
        and solution.points > curves.FEW_POINTS
        and len(solution.t) >= _FEWEST_TIMES
        and solution.t[-1] > solution.t[0]
    )
    for name in solution.fields:
        if over_time and mesh is None:
            pictures.append(_space_time(solution, name, look))
        if dimension >= 2:
            pictures.append(planes(solution, name, look, dimension == 3))
    if few:
        pictures += _few_points(solution)
    elif dimension == 1 and mesh is None:
        pictures += [_profiles(solution, name) for name in solution.fields]
    return pictures
