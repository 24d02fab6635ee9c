"""A case run to a folder of files, as the program runs it."""

from __future__ import annotations

import atexit
import contextlib
import hashlib
import importlib.util
import itertools
import json
import math
import os
import pathlib
import re
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

from . import _core
from ._problem import Case, Problem, load, real_array, run_case, thread_count, truth
from ._progress import Report, showing
from ._result import Answer, Result, quietly, say
from ._types import File

if TYPE_CHECKING:
    import xarray


class CaseRun(Answer):
    """What ``summary.json`` says of a run; keys are attributes too. ``notes`` were said before it; ``folder`` has its files."""

    @property
    def success(self) -> bool:
        return bool(self["status"] == "success")


def run(
    case: Case | File,
    folder: File | None = None,
    threads: int = 1,
    restart: bool = False,
    max_hours: float | None = None,
    progress: bool | Report = False,
    **overrides: Any,
) -> CaseRun:
    """Run a case, or an ensemble, to the files that ``seiche run`` leaves.

    Parameters
    ----------
    case : Case, or the name of a case file
    folder : where the files go; by default the ``output.directory`` of the case
    threads : over a large grid, or over the members of an ensemble; results do not depend on it
    restart : begin anew where the folder holds a run that did not finish, which is removed
    max_hours : write a checkpoint and stop after so much time; `resume` goes on from there
    progress : True for a bar on stderr, with the time that is left; or a function of (t, t_end, steps)
    **overrides : keys of the case to replace: ``seiche.run("case.toml", **{"method.h": "1/64"})``

    Returns what ``summary.json`` holds, ``notes`` and ``folder``. A computation that fails is a status, with what was computed
    before on disk. Ctrl-C ends the run after the step it is in: its status is then "interrupted", and its files are whole.
    """
    if not isinstance(case, Case):
        case = load(case, **overrides)
    elif overrides:
        raise ValueError(
            f"{', '.join(overrides)}: give keys to replace to seiche.load, or the name of the case file here"
        )
    directory = os.fspath(case._core.output_directory if folder is None else folder)
    if not directory:
        raise ValueError("folder must not be empty")
    with showing(progress) as tell:
        done = _core.run(
            case._core, directory, thread_count(threads), truth("restart", restart), _hours(max_hours), tell
        )
        summary = json.loads(done.summary)
        if tell is not None:
            steps = summary["steps"]
            if "members" in summary:  # which it counts together
                steps = math.ceil((summary["t"] - case.t_start) / summary["h"] - 1e-6)
            tell(summary["t"], case.t_end, steps)
    return _case_run(done, directory)


def resume(
    folder: File,
    until: float | None = None,
    threads: int = 1,
    max_hours: float | None = None,
    progress: bool | Report = False,
) -> CaseRun:
    """Go on with a run that was stopped or killed, from the newest checkpoint in its folder.

    Its files are then those of a run that was never stopped. Ctrl-C, ``max_hours`` and the case's ``[checkpoint]`` leave
    checkpoints.

    Parameters
    ----------
    folder : where `run`, or the program, left its files
    until : where to end, instead of the case's ``time.end``
    progress : as of `run`
    """
    t_end = None if until is None else float(until)
    directory = os.fspath(folder)
    with showing(progress) as tell:
        done = _core.resume(directory, t_end, thread_count(threads), _hours(max_hours), tell)
    return _case_run(done, directory)


def read(run: CaseRun | File) -> "xarray.Dataset":
    """The states that a run has written, as an `xarray.Dataset`, which reads from the disk what is asked of it.

    Of a run that has not ended, also while it goes on in another program, these are the states up to its newest
    checkpoint: ``attrs["message"]`` says how far it had come. To see more of it, read again.

    Parameters
    ----------
    run : CaseRun or path
        What `run`, `resume` or ``result.save`` returned, or the folder.

    Needs xarray, and h5netcdf or netCDF4.
    """
    import xarray

    engines = {"h5netcdf": "h5netcdf", "netCDF4": "netcdf4"}
    engine = next((engines[name] for name in engines if importlib.util.find_spec(name)), None)
    if engine is None:
        raise ImportError("seiche.read needs h5netcdf or netCDF4, by which xarray reads solution.h5")
    seen = _core.look(os.fspath(run.folder if isinstance(run, CaseRun) else run))
    if seen.how_far:
        atexit.register(seen.release)  # until then xarray may open the file again
    return xarray.open_dataset(seen.solution, engine=engine)


def _unsayable(result: Result) -> str:
    """Why no case file can say what was run, or ""."""
    given = result._asked.problem
    if isinstance(given, Problem) and given._text is None:
        parts = "is stated by its parts: state it by formulas, by its name, or by a case file"
        return f"its problem {parts if given._file is None else 'is that of a case file: solve the case itself'}"
    if result._shared is not None:
        return "several processes hold it: run the case itself, by mpiexec -n … seiche run, or save what gathered() brings together"
    if result.t_events:
        return "its events are Python functions"
    if result._asked.start < 0:
        return f"it begins at t = {result._asked.start:g}, and cases at 0 or later"
    return (
        ""
        if result.status == "success"
        else f"it {'failed' if result.status == 'failed' else 'was interrupted'} at t = {result.report['t']:.6g}"
    )


def _records(result: Result) -> list[dict[str, Any]]:
    """Keys of [output] by which a run records what the result has, as far as there are such, and takes the same steps."""
    asked, h = result._asked, result.report["h"]
    every_step = {"output.snapshot_every": 1, "output.snapshot_interval": 0}
    if asked.t_eval is None:
        return [every_step | {"energy_every": asked.record_every, "output.snapshot_every": asked.record_every}]
    later = asked.t_eval[asked.t_eval > asked.start]
    if h is None:  # by a tolerance: of the steps only the first depends on t_eval, and may have been a third of the way
        return [every_step] + [every_step | {"h": (later[0] - asked.start) / 3}] * (later.size > 0)
    steps = np.diff(np.append(asked.start, later)) / h
    every = np.round(steps)
    if steps.size == 0 or not (np.abs(steps - every[0]) < 1e-6).all() or every[0] < 1:
        return [{}]
    return [every_step | {"output.snapshot_every": int(every[0])}]


def save(result: Result, folder: File, progress: bool | Report) -> CaseRun:
    """What `Result.save` does."""
    reason = _unsayable(result)
    if reason:
        raise ValueError(f"no case file can say this run: {reason}")
    asked, directory = result._asked, pathlib.Path(folder)
    keys = asked.options | {"output.ledger": "off" if result.ledger is None else "on"}
    with contextlib.ExitStack() as undo:
        if asked.z0 is not None:
            keys["problem.initial"] = {"file": _initial_file(directory, asked.z0, undo)}
        before = _marks(directory)
        with showing(progress) as tell:
            for records in _records(result):
                core = run_case(asked.problem, keys | records)
                done = _core.run(core, os.fspath(directory), result.report["threads"], False, 0.0, tell)
                with quietly():  # it was said of the result
                    written = _case_run(done, os.fspath(directory))
                if not written.success or _is_of(written, result):
                    break
            else:
                for name, mark in _marks(directory).items():
                    if mark != before[name]:
                        (directory / name).unlink()
                raise RuntimeError("a run of the same case differs from this result, which is not saved")
        undo.pop_all()
    if written.success and asked.z0 is not None:
        _name_beside(written, keys["problem.initial"]["file"].name)
    return written


def _is_of(written: CaseRun, result: Result) -> bool:
    same = all(written[key] == result.report[key] for key in ("t", "steps"))
    same &= all(written["energy"][key] == result.report["energy"][key] for key in ("initial", "final"))
    final = np.loadtxt(written.folder / "final.txt", ndmin=1)
    return bool(same and (result.t[-1] != written.t or np.array_equal(final, result.y[:, -1])))


def _marks(directory: pathlib.Path) -> dict[str, Any]:
    """By what it is seen which files of a run are written; summary.json, without which there is no run, first."""
    names = "summary.json final.txt report.html solution.xdmf solution.h5 energy.csv case.toml"
    marks: dict[str, Any] = {}
    for name in names.split():
        with contextlib.suppress(OSError):
            about = (directory / name).stat()
            marks[name] = about.st_ino, about.st_mtime_ns, about.st_size
        marks.setdefault(name, None)
    return marks


def _initial_file(directory: pathlib.Path, z0: Any, undo: contextlib.ExitStack) -> pathlib.Path:
    """A file of the state at the start, under a name that no other file has; where no run comes to be, it is removed."""
    text = "".join(f"{value!r}\n" for value in real_array("z0", z0).ravel().tolist())
    if not directory.exists():
        directory.mkdir(parents=True)
        undo.callback(_remove_if_empty, directory)
    for number in itertools.count(1):
        file = directory.resolve() / ("initial.txt" if number == 1 else f"initial_{number}.txt")
        try:
            with file.open("x") as new:
                undo.callback(_remove_unless_named, file)
                new.write(text)
            break
        except FileExistsError:
            if file.is_file() and file.read_bytes() == text.encode():
                break
    return file


def _remove_if_empty(directory: pathlib.Path) -> None:
    with contextlib.suppress(OSError):
        directory.rmdir()


def _remove_unless_named(file: pathlib.Path) -> None:
    """A run that stopped on the way, whose case names the file, needs it to go on."""
    case = file.with_name("case.toml")
    if not case.is_file() or os.fsencode(file.name) not in case.read_bytes():
        file.unlink(missing_ok=True)


def _name_beside(written: CaseRun, name: str) -> None:
    """Lets the case name its initial file without a folder, so that both may move; summary.json has the hash of the case."""

    def replace(file: pathlib.Path, change: Callable[[str], str]) -> bytes:
        with open(file, encoding="utf-8", errors="surrogateescape", newline="") as old:
            text = change(old.read()).encode("utf-8", "surrogateescape")
        new = file.with_name(f"{file.name}.new")
        new.write_bytes(text)
        os.replace(new, file)
        return text

    folder, earlier = written.folder, written["sha256"]["case.toml"]
    for file, quote in {"case.toml": '"', "report.html": "&quot;"}.items():
        line, named = f"initial = {{ file = {quote}.*{quote} }}", f"initial = {{ file = {quote}{name}{quote} }}"
        if (folder / file).is_file():
            text = replace(folder / file, lambda old: re.sub(f"(?m)^{line}$", lambda _: named, old, count=1))
        if file == "case.toml":
            written["sha256"]["case.toml"] = hashlib.sha256(text).hexdigest()
    replace(folder / "summary.json", lambda old: old.replace(earlier, written["sha256"]["case.toml"]))


def _hours(given: float | None) -> float:
    if given is None:
        return 0.0
    if not given > 0:
        raise ValueError(f"max_hours = {given!r} must be > 0")
    return float(given)


def _case_run(done: _core.CaseRun, directory: str) -> CaseRun:
    summary = json.loads(done.summary)
    say([*done.notes, f"{directory}: {summary['message']}"], done.remarks, stacklevel=4)
    return CaseRun(summary, notes=done.notes, folder=pathlib.Path(directory))
