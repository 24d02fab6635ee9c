"""A case run to a folder of files, as the program runs it."""

from __future__ import annotations

import json
import os
import pathlib
from typing import Any

from . import _core
from ._problem import Case, load, thread_count, truth
from ._progress import Report, showing
from ._result import Answer, say


class CaseRun(Answer):
    """What ``summary.json`` says of a run; keys are attributes too. ``notes`` were said before it; ``folder`` has its files."""

    @property
    def success(self) -> bool:
        return self["status"] == "success"


def run(
    case: Case | str | os.PathLike,
    folder: str | os.PathLike | None = None,
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
        raise ValueError(f"{', '.join(overrides)}: give keys to replace to seiche.load, or the name of the case file here")
    directory = os.fspath(case._core.output_directory if folder is None else folder)
    if not directory:
        raise ValueError("folder must not be empty")
    with showing(progress) as tell:
        done = _core.run(case._core, directory, thread_count(threads), truth("restart", restart), _hours(max_hours), tell)
        summary = json.loads(done.summary)
        if tell is not None:
            tell(summary["t"], case.t_end, summary["steps"])
    return _case_run(done, directory)


def resume(
    folder: str | os.PathLike,
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
