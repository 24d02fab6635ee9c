"""A field in the plane as a film: by ffmpeg where it is there, and else an animated picture that every browser plays."""

from __future__ import annotations

import pathlib
import shutil
import subprocess
import tempfile
import typing

import numpy as np

from . import colours, curves, maps, names, runs, style

_MOST_FRAMES = 150
_FRAMES_PER_SECOND = 15
_WIDTH, _DPI = 3.6, 200  # inches; an even number of points
# What a film does not say about its colours each player guesses from its size, and not all alike.
_COLOURS = "scale=out_color_matrix=bt709:out_range=tv -color_range tv -colorspace bt709 -color_primaries bt709 -color_trc bt709"
_CODECS = (("mp4", "-c:v libx264 -crf 20 -movflags +faststart"), ("webm", "-c:v libvpx-vp9 -b:v 0 -crf 32"))
_PICTURES = ("webp", "apng", "png")
ENDINGS = (*(ending for ending, _ in _CODECS), *_PICTURES)


def frames(solution: runs.Solution) -> np.ndarray:
    return curves.spread(len(solution.t), _MOST_FRAMES)


def common_scale(solution: runs.Solution, field: str, look: colours.Look) -> colours.Scale:
    """Of all frames."""
    return colours.common_scale(
        [colours.extent_of(solution.plane(field, k)[2]) for k in frames(solution)], look.of(field)
    )


class _Ffmpeg:
    """Takes frames one by one, and raises BrokenPipeError where ffmpeg has ended; close() says what went wrong, or ""."""

    def __init__(self, file: pathlib.Path, size: tuple[int, int], codec: str):
        self.file, self._said = file, tempfile.TemporaryFile()
        raw = f"-f rawvideo -pixel_format rgba -video_size {size[0]}x{size[1]} -framerate {_FRAMES_PER_SECOND} -i -"
        words = f"ffmpeg -nostdin -y -loglevel error {raw} -pix_fmt yuv420p -vf {_COLOURS} {codec}".split()
        self._program = subprocess.Popen([*words, str(file)], stdin=subprocess.PIPE, stderr=self._said)

    def add(self, frame: np.ndarray) -> None:
        self._program.stdin.write(frame.tobytes())

    def close(self) -> str:
        try:
            self._program.stdin.close()
        except BrokenPipeError:
            pass
        code = self._program.wait()
        if code == 0:
            return ""
        self.file.unlink(missing_ok=True)
        self._said.seek(0)
        return self._said.read().decode(errors="replace").strip()[-300:] or f"exit code {code}"


class _Animation:
    """The same as a picture that moves: WebP, or PNG where Pillow has none. Pillow wants all frames at once, small as they are."""

    def __init__(self, stem: pathlib.Path, ending: str):
        from PIL import features

        can = features.check("webp_anim")
        if ending == "webp" and not can:
            raise ValueError("this Pillow writes no WebP that moves: let the film end in .apng")
        self._webp = can if ending not in _PICTURES else ending == "webp"
        self.file = _with_ending(stem, ending if ending in _PICTURES else "webp" if can else "apng")
        self._frames: list[typing.Any] = []

    def add(self, frame: np.ndarray) -> None:
        from PIL import Image

        image = Image.fromarray(frame[..., :3])
        self._frames.append(image.resize((image.width // 2, image.height // 2)))

    def close(self) -> str:
        kind = {"format": "WEBP", "quality": 85, "method": 2} if self._webp else {"format": "PNG"}
        times = {"duration": 1000 // _FRAMES_PER_SECOND, "loop": 0}
        self._frames[0].save(self.file, save_all=True, append_images=self._frames[1:], **times, **kind)
        return ""


class Scene(typing.NamedTuple):
    """What all frames of a film have in common."""

    solution: runs.Solution
    field: str
    ground: style.Ground
    scale: colours.Scale
    title: str
    warning: str


def draw(
    scene: Scene, progress: typing.Callable[[float], None], stem: pathlib.Path | None = None, ending: str = ""
) -> dict[str, typing.Any]:
    """One film, by default in the working directory: {"file": its name, "frames": how many, "note": why it is no film but a
    picture that moves, or ""}. `ending` is one of ENDINGS, or "" for the first that can be had. `progress` is told each part of
    it that is done."""
    stem = pathlib.Path(f"film_{scene.field}{scene.ground.suffix}") if stem is None else stem
    said = "was not found on the PATH (Debian package ffmpeg)"
    count = len(frames(scene.solution))
    for extension, codec in _CODECS if shutil.which("ffmpeg") else ():
        if ending not in ("", extension):
            continue
        file, failure = _drawn(scene, lambda size: _Ffmpeg(_with_ending(stem, extension), size, codec), progress)
        if not failure:
            return {"file": file.name, "frames": count, "note": ""}
        said = f"failed: {failure}"  # built without this codec, most likely
    file, _ = _drawn(scene, lambda _: _Animation(stem, ending), progress)
    note = "" if ending in _PICTURES else f"an animated picture, since ffmpeg {said}"
    return {"file": file.name, "frames": count, "note": note}


def _with_ending(stem: pathlib.Path, ending: str) -> pathlib.Path:
    """Behind the name, of which a part may look like an ending."""
    return stem.with_name(f"{stem.name}.{ending}")


def _drawn(
    scene: Scene, kind: typing.Callable[[tuple[int, int]], typing.Any], progress: typing.Callable[[float], None]
) -> tuple[pathlib.Path, str]:
    """The file, and why it is not there, or ""."""
    import matplotlib.pyplot as plt

    solution, field = scene.solution, scene.field
    chosen = frames(solution)
    x, y, first = solution.plane(field, chosen[0])
    shape = min(1.6, max(0.3, float(np.ptp(y) / (np.ptp(x) or 1.0))))
    with style.on(scene.ground, {"savefig.dpi": _DPI, "figure.dpi": _DPI}):
        height = round(_WIDTH * (0.78 * shape + 0.2) * _DPI / 2) * 2 / _DPI
        figure, ax = plt.subplots(figsize=(_WIDTH, height))
        mesh = maps.image(ax, x, y, first, scene.scale)
        colours.add_bar(mesh, ax, scene.scale, solution.label(field))
        ax.set(xlabel=names.place(solution.axes[0][0]), ylabel=names.place(solution.axes[1][0]), aspect="equal")
        style.title(figure, scene.title, scene.warning)
        caption = ax.set_title(f"$t$ = {solution.t[-1]:.4g}")
        figure.canvas.draw()
        figure.set_layout_engine("none")  # once is enough, and nothing jumps
        film = kind(figure.canvas.get_width_height())
        try:
            for k in chosen:
                mesh.set_array(solution.plane(field, k)[2].T)
                caption.set_text(f"$t$ = {solution.t[k]:.4g}")
                figure.canvas.draw()
                film.add(np.asarray(figure.canvas.buffer_rgba()))
                progress(1 / len(chosen))
        except BrokenPipeError:  # no further frame is of use
            pass
        plt.close(figure)
    return film.file, film.close()
