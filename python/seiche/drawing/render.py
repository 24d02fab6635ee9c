"""Draws pictures on both grounds in every format that is asked for, in as many processes as there are processors."""

from __future__ import annotations

import concurrent.futures
import ctypes
import difflib
import multiprocessing
import os
import signal
import time
import typing

if typing.TYPE_CHECKING:
    from matplotlib.transforms import Bbox

from . import colours, curve_pictures, films, names, runs, style


class _Progress:
    """A line on the terminal that says how far all processes have come; nothing where nobody looks on."""

    def __init__(self, tasks: float, is_shown: bool):
        self._tasks, self._begin = tasks, time.monotonic()
        self._terminal: typing.Any = None
        if is_shown:
            try:
                self._done, self._last = multiprocessing.Value("d", 0.0), multiprocessing.Value("d", 0.0)
                self._terminal = open("/dev/tty", "w", encoding="utf-8")
            except OSError:
                pass

    def add(self, tasks: float) -> None:
        if self._terminal is None:
            return
        with self._done.get_lock():
            self._done.value += tasks
            share, now = min(1.0, self._done.value / self._tasks), time.monotonic()
            if now - self._begin < 0.5 or now - self._last.value < 0.1:
                return
            self._last.value = now
            left = (now - self._begin) * (1 - share) / max(share, 1e-9)
            bar = "━" * round(20 * share)
            line = f"\r\x1b[2K{100 * share:3.0f} % {bar:<20} drawing, {left:.0f} s left"
            print(line, end="", file=self._terminal, flush=True)

    def end(self) -> None:
        if self._terminal is not None:
            print("\r\x1b[2K", end="", file=self._terminal, flush=True)


def _end_with_parent() -> None:
    """Where the program that asked ends, so does this one, and with it the processes that it started."""
    set_signal = 1  # PR_SET_PDEATHSIG
    try:
        ctypes.CDLL(None).prctl(set_signal, signal.SIGTERM)
    except (OSError, AttributeError):
        pass  # another system than Linux


class BadRequest(Exception):
    """What is asked for does not exist: one sentence."""


def _known_palette(name: str | None) -> str | None:
    import matplotlib

    if name is None or name in matplotlib.colormaps:
        return name
    near = difflib.get_close_matches(name, list(matplotlib.colormaps), 1)
    raise BadRequest(
        f"unknown --palette '{name}'"
        + (f"; did you mean '{near[0]}'?" if near else "; those of Matplotlib are known, as viridis, magma or RdBu_r")
    )


def _look(request: dict[str, typing.Any], fields: list[str]) -> colours.Look:
    limits, ranges = request.get("range"), request.get("ranges", {})
    for field, (low, high) in ranges.items():
        if field not in fields:
            raise BadRequest(
                f"--range {field}={low:g},{high:g}: there is no field '{field}'; the fields are {', '.join(fields)}"
            )
    ranges = {field: tuple(of_field) for field, of_field in ranges.items()}
    palette = _known_palette(request.get("palette"))
    return colours.Look(tuple(limits) if limits else None, request.get("centre"), palette, ranges)


class RunStudio:
    """All that a process needs to draw its share of the pictures and films of a run."""

    def __init__(self, request: dict[str, typing.Any]):
        self.title, self.warning = request["title"], request["warning"]
        self.solution = runs.Solution(request["solution"])
        look = _look(request, self.solution.fields)
        self.pictures = runs.pictures_of(self.solution, request["history"], look)
        self.films: list[str] = []
        if len(self.solution.axes) == 2 and len(self.solution.t) > 1:
            wanted = request.get("films")
            wanted = self.solution.fields[:1] if wanted is None else wanted
            self.films = [name for name in self.solution.fields if name in wanted]
        self.scales = {field: films.common_scale(self.solution, field, look) for field in self.films}

    def film(self, field: str, ground: style.Ground, progress: typing.Callable[[float], None]) -> dict[str, typing.Any]:
        solution = runs.Solution(self.solution.path)  # of this process
        scene = films.Scene(solution, field, ground, self.scales[field], self.title, self.warning)
        return films.draw(scene, progress)

    def film_reply(self, field: str, of: dict[str, dict[str, typing.Any]]) -> dict[str, typing.Any]:
        first = next(iter(of.values()))
        files = {ground: one["file"] for ground, one in of.items()}
        remark = self.scales[field].remark()
        return {
            "field": names.in_text(field),
            "frames": first["frames"],
            "remark": remark,
            "note": first["note"],
            "files": files,
        }


class CurveStudio:
    """The same of pictures that are described one by one."""

    title = ""
    films: typing.Sequence[str] = ()

    def __init__(self, request: dict[str, typing.Any]):
        self.warning = request.get("warning", "")
        self.pictures = [curve_pictures.picture_of(one) for one in request["pictures"]]


class _Draw:
    """What one process does: a film or a picture, on one ground."""

    def __init__(self, request: dict[str, typing.Any]):
        self.studio = CurveStudio(request) if "pictures" in request else RunStudio(request)
        self.grounds = request.get("grounds", list(style.GROUNDS))
        self.formats, self.is_journal = request["formats"], bool(request.get("journal"))
        width = request.get("width", _WIDTH)
        self.settings = {"figure.figsize": (width, width)}
        # Films first, since they take longest.
        self.tasks = [("film", k, ground) for k in range(len(self.studio.films)) for ground in self.grounds]
        self.tasks += [("picture", k, "") for k in range(len(self.studio.pictures))]
        self.progress = _Progress(
            sum(_FILM if kind == "film" else 1 for kind, *_ in self.tasks), bool(request.get("progress"))
        )

    def do(self, task: Task) -> tuple[Task, typing.Any]:
        kind, place, name = task
        if kind == "film":
            field, ground = self.studio.films[place], style.GROUNDS[name]
            return task, self.studio.film(field, ground, lambda part: self.progress.add(_FILM * part))
        said, places = "", None
        for ground in self.grounds:
            said, places = self.picture(self.studio.pictures[place], style.GROUNDS[ground], places)
        self.progress.add(1)
        return task, said

    def title(self, picture: runs.Picture) -> str:
        return f"{self.studio.title}: {picture.what}" if self.studio.title else picture.what

    def picture(self, picture: runs.Picture, ground: style.Ground, places: list[Bbox] | None) -> tuple[str, list[Bbox]]:
        """Returns what the caption has to say beyond, and the places of all axes, which are those on another ground too."""
        import matplotlib.pyplot as plt
        from matplotlib.backend_bases import get_registered_canvas_class

        with style.on(ground, self.settings):
            width = plt.rcParams["figure.figsize"][0]
            figure = plt.figure(figsize=(width, width * picture.height), dpi=plt.rcParams["savefig.dpi"])
            said = picture.draw(figure)
            if not self.is_journal:
                style.title(figure, self.title(picture), self.studio.warning)
            style.set_offsets(figure)
            if places is None:
                figure.get_layout_engine().execute(figure)
            figure.set_layout_engine("none")  # once for all files
            for ax, position in zip(figure.axes, places or []):
                ax.set_position(position)
            places = [ax.get_position(original=True) for ax in figure.axes]
            for extension in self.formats:
                if extension != "png" and ground.suffix:
                    continue  # on paper there is one ground
                dateless = {"png": {}, "svg": {"Date": None}, "pdf": {"CreationDate": None}}[extension]
                fast = {"pil_kwargs": {"compress_level": 4}} if extension == "png" else {}
                figure.set_dpi(plt.rcParams["savefig.dpi"])
                write = getattr(get_registered_canvas_class(extension)(figure), f"print_{extension}")
                write(f"{picture.stem}{ground.suffix}.{extension}", metadata=dateless, **fast)  # savefig draws twice
            plt.close(figure)
        return said, places

    def reply(self, results: dict[Task, typing.Any]) -> dict[str, typing.Any]:
        warning = f"; {self.studio.warning}" if self.studio.warning else ""
        pictures = [
            {
                "stem": picture.stem,
                "title": self.title(picture) + warning,
                "caption": picture.caption + results["picture", k, ""],
            }
            for k, picture in enumerate(self.studio.pictures)
        ]
        made = [
            self.studio.film_reply(field, {ground: results["film", k, ground] for ground in self.grounds})
            for k, field in enumerate(self.studio.films)
        ]
        return {"pictures": pictures, "films": made}


Task = tuple[str, int, str]  # "film", which of them, the ground; or "picture", which of them, ""
_WIDTH = 3.4  # inches
_FILM = 10.0  # pictures that one film counts for
_draw: _Draw


def _do(task: Task) -> tuple[Task, typing.Any]:
    return _draw.do(task)


def draw(request: dict[str, typing.Any]) -> dict[str, typing.Any]:
    """Into the working directory. Returns {"pictures": [{stem, title, caption}, …], "films": [{field, frames, remark, note, files}, …]}."""
    import matplotlib

    matplotlib.rcdefaults()  # whatever a user's own settings are
    matplotlib.use("Agg")
    global _draw
    _draw = _Draw(request)
    _end_with_parent()
    try:
        results = dict(_all_done(_draw.tasks))
    finally:
        _draw.progress.end()
    return _draw.reply(results)


def _all_done(tasks: list[Task]) -> typing.Iterator[tuple[Task, typing.Any]]:
    processes = min(len(os.sched_getaffinity(0)), len(tasks), 8)
    if processes > 1:
        context = multiprocessing.get_context("fork")
        try:
            pool = concurrent.futures.ProcessPoolExecutor(processes, context, _end_with_parent)
        except OSError:  # no memory that processes share
            pool = None
        if pool is not None:
            with pool:
                yield from pool.map(_do, tasks)
            return
    yield from map(_do, tasks)
