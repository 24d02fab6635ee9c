"""A field in the plane as a film: by ffmpeg where it is there, and else an animated picture that every browser plays."""

from __future__ import annotations

import pathlib
import shutil
import subprocess
import typing

import numpy as np

from . import colours, curves, maps, names, runs, style

_MOST_FRAMES = 150
_FRAMES_PER_SECOND = 15
_WIDTH, _DPI = 3.6, 200  # inches; an even number of points
# What a film does not say about its colours each player guesses from its size, and not all alike.
_COLOURS = "scale=out_color_matrix=bt709:out_range=tv -color_range tv -colorspace bt709 -color_primaries bt709 -color_trc bt709"
_CODECS = (("mp4", "-c:v libx264 -crf 20 -movflags +faststart"), ("webm", "-c:v libvpx-vp9 -b:v 0 -crf 32"))


def frames(solution: runs.Solution) -> np.ndarray:
    return curves.spread(len(solution.t), _MOST_FRAMES)


def common_scale(solution: runs.Solution, field: str, look: colours.Look) -> colours.Scale:
    """From some of the frames, the first and the last among them: of large planes all would take long to read."""
    chosen = frames(solution)
    most = max(2, int(4e7 / solution.points))
    return colours.scale_of(list(solution.values(field, chosen[curves.spread(len(chosen), most)])), look)


def _ffmpeg(file: pathlib.Path, size: tuple[int, int], codec: str) -> subprocess.Popen[bytes]:
    raw = f"-f rawvideo -pixel_format rgba -video_size {size[0]}x{size[1]} -framerate {_FRAMES_PER_SECOND} -i -"
    words = f"ffmpeg -nostdin -y -loglevel error {raw} -pix_fmt yuv420p -vf {_COLOURS} {codec}".split()
    return subprocess.Popen([*words, str(file)], stdin=subprocess.PIPE, stderr=subprocess.PIPE)


def _by_ffmpeg(stem: pathlib.Path, pictures: list[np.ndarray]) -> tuple[str, str]:
    """The name of the file, or "" and why."""
    said = ""
    height, width = pictures[0].shape[:2]
    for extension, codec in _CODECS:
        file = stem.with_suffix("." + extension)
        program = _ffmpeg(file, (width, height), codec)
        _, words = program.communicate(b"".join(picture.tobytes() for picture in pictures))
        if program.returncode == 0:
            return file.name, ""
        said = (
            words.decode(errors="replace").strip()[-300:] or f"exit code {program.returncode}"
        )  # built without this codec, most likely
        file.unlink(missing_ok=True)
    return "", said


def _animated(stem: pathlib.Path, pictures: list[np.ndarray]) -> str:
    from PIL import Image, features

    images = [Image.fromarray(picture[..., :3]) for picture in pictures]
    settings: dict[str, typing.Any] = {
        "save_all": True,
        "append_images": images[1:],
        "duration": 1000 // _FRAMES_PER_SECOND,
        "loop": 0,
    }
    if features.check("webp_anim"):
        file = stem.with_suffix(".webp")
        images[0].save(file, quality=85, method=2, **settings)
    else:
        file = stem.with_suffix(".png")
        images[0].save(file, **settings)
    return file.name


def draw(
    solution: runs.Solution,
    field: str,
    ground: style.Ground,
    scale: colours.Scale,
    title: str,
    warning: str,
    into: pathlib.Path,
    progress: typing.Callable[[float], None],
) -> dict[str, typing.Any]:
    """One film on one ground: {"file": its name, "frames": how many, "note": what is said of it}."""
    import matplotlib.pyplot as plt

    chosen = frames(solution)
    x, y, first = runs.plane(solution, solution.values(field, chosen[:1])[0], 0, 1)
    shape = min(1.6, max(0.3, float(np.ptp(y) / (np.ptp(x) or 1.0))))
    pictures = []
    with style.on(ground, {"savefig.dpi": _DPI, "figure.dpi": _DPI}):
        height = round(_WIDTH * (0.78 * shape + 0.2) * _DPI / 2) * 2 / _DPI
        figure, ax = plt.subplots(figsize=(_WIDTH, height))
        mesh = maps.image(ax, x, y, first, scale)
        colours.add_bar(mesh, ax, scale, solution.label(field))
        ax.set(xlabel=names.place(solution.axes[0][0]), ylabel=names.place(solution.axes[1][0]), aspect="equal")
        style.title(figure, title, warning)
        caption = ax.set_title(f"$t$ = {solution.t[-1]:.4g}")
        figure.canvas.draw()
        figure.set_layout_engine("none")  # once is enough, and nothing jumps
        for done, k in enumerate(chosen):
            mesh.set_array(runs.plane(solution, solution.values(field, np.array([k]))[0], 0, 1)[2].T)
            caption.set_text(f"$t$ = {solution.t[k]:.4g}")
            figure.canvas.draw()
            pictures.append(np.array(figure.canvas.buffer_rgba()))
            progress((done + 1) / len(chosen))
        plt.close(figure)
    stem = into / f"film_{field}{ground.suffix}"
    file, note = _by_ffmpeg(stem, pictures) if shutil.which("ffmpeg") else ("", "")
    if not file:
        file = _animated(stem, pictures)
        why = f"failed: {note}" if note else "was not found on the PATH (Debian package ffmpeg)"
        note = f"an animated picture, since ffmpeg {why}"
    return {"file": file, "frames": len(chosen), "note": note}
