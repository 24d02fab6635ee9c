"""Draws pictures on both grounds in every format that is asked for, in as many processes as there are processors."""

from __future__ import annotations

import difflib
import multiprocessing
import os
import pathlib
import time
import typing

from . import colours, films, names, runs, style


class _Progress:
    """A line on the terminal that says how far all processes have come; nothing where nobody looks on."""

    def __init__(self, tasks: int, is_shown: bool):
        self._tasks, self._done = tasks, multiprocessing.Value("d", 0.0)
        self._last = multiprocessing.Value("d", 0.0)
        self._begin = time.monotonic()
        self._terminal: typing.Any = None
        if is_shown:
            try:
                self._terminal = open("/dev/tty", "w", encoding="utf-8")
            except OSError:
                pass

    def add(self, tasks: float) -> None:
        with self._done.get_lock():
            self._done.value += tasks
            share, now = self._done.value / self._tasks, time.monotonic()
            if self._terminal is None or now - self._begin < 0.5 or now - self._last.value < 0.1:
                return
            self._last.value = now
            left = (now - self._begin) * (1 - share) / max(share, 1e-9)
            bar = "━" * round(20 * share)
            print(
                f"\r\x1b[2K{100 * share:3.0f} % {bar:<20} drawing, {left:.0f} s left",
                end="",
                file=self._terminal,
                flush=True,
            )

    def end(self) -> None:
        if self._terminal is not None:
            print("\r\x1b[2K", end="", file=self._terminal, flush=True)


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


class Studio:
    """All that a process needs to draw its share of the tasks."""

    def __init__(self, request: dict[str, typing.Any]):
        self.into = pathlib.Path()
        self.title, self.warning, self.formats = request["title"], request["warning"], request["formats"]
        self.is_journal = bool(request.get("journal"))
        width = request.get("width", _WIDTH)
        self.settings = {"figure.figsize": (width, width), "font.size": 8 if self.is_journal else 7}
        limits = request.get("range")
        self.look = colours.Look(
            tuple(limits) if limits else None, request.get("centre"), _known_palette(request.get("palette"))
        )
        self.run, self.history = request["run"], request["history"]
        self.solution = runs.Solution(os.path.join(self.run, "solution.h5"))
        self.pictures = runs.pictures_of(self.solution, self.history, self.look)
        self.filmed: list[str] = []
        if len(self.solution.axes) == 2 and len(self.solution.t) > 1:
            wanted = request.get("films")
            self.filmed = [
                name
                for name in self.solution.fields
                if name in (wanted if wanted is not None else self.solution.fields[:1])
            ]
        self.scales = {field: films.common_scale(self.solution, field, self.look) for field in self.filmed}

    def tasks(self) -> list[tuple[str, int, str]]:
        """Films first, since they take longest."""
        filmed = [("film", place, ground) for place in range(len(self.filmed)) for ground in style.GROUNDS]
        return filmed + [("picture", place, ground) for place in range(len(self.pictures)) for ground in style.GROUNDS]

    def do(self, task: tuple[str, int, str], progress: _Progress) -> tuple[tuple[str, int, str], typing.Any]:
        kind, place, name = task
        if kind == "film":
            field = self.filmed[place]
            share = [0.0]

            def report(done: float) -> None:
                progress.add(_FILM * (done - share[0]))
                share[0] = done

            solution = runs.Solution(self.solution.path)  # of this process
            return task, films.draw(
                solution, field, style.GROUNDS[name], self.scales[field], self.title, self.warning, self.into, report
            )
        said = self.draw(self.pictures[place], style.GROUNDS[name])
        progress.add(1)
        return task, said

    def draw(self, picture: runs.Picture, ground: style.Ground) -> str:
        import matplotlib.pyplot as plt

        with style.on(ground, self.settings):
            width = plt.rcParams["figure.figsize"][0]
            figure = plt.figure(figsize=(width, width * picture.height))
            said = picture.draw(figure)
            if not self.is_journal:
                style.title(figure, f"{self.title}: {picture.what}", self.warning)
            style.set_offsets(figure)
            figure.canvas.draw()
            figure.set_layout_engine("none")  # laid out once for all files
            for extension in self.formats:
                if extension != "png" and ground.suffix:
                    continue  # on paper there is one ground
                file = self.into / f"{picture.stem}{ground.suffix}.{extension}"
                figure.savefig(
                    file,
                    metadata={}
                    if extension == "png"
                    else {"Date": None}
                    if extension == "svg"
                    else {"CreationDate": None},
                )
            plt.close(figure)
        return said


_WIDTH = 3.4  # inches
_FILM = 20.0  # tasks that one film counts for
_studio: Studio
_progress: _Progress


def _do(task: tuple[str, int, str]) -> tuple[tuple[str, int, str], typing.Any]:
    return _studio.do(task, _progress)


def draw(request: dict[str, typing.Any]) -> dict[str, typing.Any]:
    """Returns {"pictures": [{stem, title, caption}, …], "films": [{field, frames, remark, note, files}, …]}."""
    import matplotlib

    matplotlib.use("Agg")
    global _studio, _progress
    _studio = Studio(request)
    tasks = _studio.tasks()
    _progress = _Progress(
        round(sum(_FILM if kind == "film" else 1 for kind, *_ in tasks)), bool(request.get("progress"))
    )
    processes = min(len(os.sched_getaffinity(0)), len(tasks), 8)
    if processes > 1:
        with multiprocessing.get_context("fork").Pool(processes) as pool:
            results = dict(pool.imap_unordered(_do, tasks))
    else:
        results = dict(map(_do, tasks))
    _progress.end()
    pictures = [
        {
            "stem": picture.stem,
            "title": f"{_studio.title}: {picture.what}" + (f"; {_studio.warning}" if _studio.warning else ""),
            "caption": picture.caption + results["picture", place, "light"],
        }
        for place, picture in enumerate(_studio.pictures)
    ]
    made = []
    for place, field in enumerate(_studio.filmed):
        of = {ground: results["film", place, ground] for ground in style.GROUNDS}
        made.append(
            {
                "field": names.in_text(field),
                "frames": of["light"]["frames"],
                "remark": _studio.scales[field].remark(),
                "note": of["light"]["note"],
                "files": {ground: one["file"] for ground, one in of.items()},
            }
        )
    return {"pictures": pictures, "films": made}
