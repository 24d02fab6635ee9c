"""The program under test: case files in, states, energies and summaries out."""

from __future__ import annotations

import json
import math
import os
import resource
import shutil
import signal
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from .system import System

TIME_OUT = 60  # seconds of a processor, of which no run here takes a tenth; a longer one has the wrong verdict
PROGRAM = Path(os.environ.get("SEICHE", "build/release/seiche")).resolve()


@dataclass
class Run:
    code: int  # exit code; −1: out of time
    said: str  # the last line on stderr
    summary: dict | None
    state: np.ndarray | None
    energies: dict[str, np.ndarray]  # columns of energy.csv
    times: np.ndarray  # of the snapshots
    states: np.ndarray  # a row for each of them
    case: str
    members: np.ndarray | None = None  # of an ensemble: a row of final values for each

    @property
    def solved(self) -> bool:
        return self.code == 0 and self.state is not None and bool(np.isfinite(self.state).all())

    @property
    def refused(self) -> bool:
        return self.code == 2

    @property
    def law(self) -> str:
        return "" if self.summary is None else self.summary["energy"]["law"]

    def outcome(self) -> str:
        if self.code == -1:
            return f"no end within {TIME_OUT:g} s"
        return f"exit {self.code}: {self.said[:160]}" if self.code else "a state that is not finite"


def toml(value) -> str:
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and value == int(value) and abs(value) < 1e15:
        return f"{value:.1f}"
    return repr(value)


def case_text(
    problem: str, method: dict, end: float, output: dict | None = None, backend: dict | None = None, ensemble: str = ""
) -> str:
    sections = {
        "method": method,
        "backend": backend or {},
        "time": {"end": float(end)},
        "output": {"report": "off"} | ({} if ensemble else {"snapshot_every": 0}) | (output or {}),
    }
    text = f"[problem]\n{problem}\n"
    for name, keys in sections.items():
        if keys:
            text += f"\n[{name}]\n" + "".join(f"{key} = {toml(value)}\n" for key, value in keys.items())
    return text + (f"\n[ensemble]\n{ensemble}\n" if ensemble else "")


def read_snapshots(file: Path) -> tuple[np.ndarray, np.ndarray]:
    if not file.exists():
        return np.zeros(0), np.zeros((0, 0))
    with h5py.File(file) as data:
        names = data.attrs["fields"]
        fields = (names.decode() if isinstance(names, bytes) else names).split()
        times = data["t"][:]
        return times, np.concatenate([data[name][:].reshape(times.size, -1) for name in fields], axis=1)


def limit_time() -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (TIME_OUT, TIME_OUT + 2))


def run(case: str, files: dict[str, str] | None = None, quiet: bool = True) -> Run:
    """One `seiche run`. Unless it is quiet, `said` is its first note beside that on how H was split."""
    folder = Path(tempfile.mkdtemp(prefix="seiche_verification_"))
    try:
        write(folder, case, files)
        out = folder / "out"
        command = [PROGRAM, "run", folder / "case.toml", "--out", out] + ["--quiet"] * quiet
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(command, capture_output=True, text=True, preexec_fn=limit_time)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL) or seconds >= TIME_OUT:
            return Run(-1, "", None, None, {}, np.zeros(0), np.zeros((0, 0)), case)
        lines = [line for line in done.stderr.splitlines() if line.strip()]
        if not quiet:
            lines = [line for line in lines if line.startswith("seiche: ") and "H = ½zᵀMz + V" not in line]
        said = next((line for line in lines if ": " in line), lines[0] if lines else "")
        said = said.replace(str(folder / "case.toml"), "case.toml")
        summary = json.loads((out / "summary.json").read_text()) if (out / "summary.json").exists() else None
        state = None
        if (out / "final.txt").exists():
            state = np.loadtxt(out / "final.txt", ndmin=1)
        energies = {}
        if (out / "energy.csv").exists():
            header, *rows = (out / "energy.csv").read_text().splitlines()
            numbers = np.array([[float(x) for x in row.split(",")] for row in rows]).reshape(len(rows), -1)
            energies = {name: numbers[:, i] for i, name in enumerate(header.split(","))} if len(rows) else {}
        finals = out / "finals.csv"
        members = np.loadtxt(finals, delimiter=",", skiprows=1, ndmin=2)[:, 1:] if finals.exists() else None
        return Run(done.returncode, said, summary, state, energies, *read_snapshots(out / "solution.h5"), case, members)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def check(case: str, files: dict[str, str] | None = None) -> dict:
    """What `seiche check --json` says of a case; {"refused": sentence} where it is refused."""
    folder = Path(tempfile.mkdtemp(prefix="seiche_verification_"))
    try:
        write(folder, case, files)
        done = subprocess.run([PROGRAM, "check", folder / "case.toml", "--json"], capture_output=True, text=True, timeout=TIME_OUT)
        return json.loads(done.stdout) if done.returncode == 0 else {"refused": done.stderr.strip()}
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def methods() -> list[dict]:
    done = subprocess.run([PROGRAM, "list", "methods", "--json"], capture_output=True, text=True, check=True)
    return [row for row in json.loads(done.stdout) if row["name"] != "auto"]


def write(folder: Path, case: str, files: dict[str, str] | None) -> None:
    (folder / "case.toml").write_text(case)
    for name, text in (files or {}).items():
        (folder / name).write_text(text)


def run_system(system: System, method: dict, end: float | None = None, **options) -> Run:
    return run(case_text(system.problem, method, system.end if end is None else end, **options), system.files)


def run_against(
    system: System, method: dict, reference: dict, coarsest: float | None = None, energy_every: int = 10**9
) -> tuple[Run, float]:
    """A run, and its largest error at those of the reference's times that steps of `coarsest` meet; all, with a tolerance."""
    kept = [system.end * k / 4 for k in (1, 2, 3, 4)]
    output: dict = {"energy_every": energy_every}
    if coarsest is None:
        output["snapshot_interval"] = system.end / 4
    else:
        kept = [t for t in kept if abs(t / coarsest - round(t / coarsest)) < 1e-6]
        every = math.gcd(*(round(t / method["h"]) for t in kept))
        output["snapshot_every"] = every
    got = run_system(system, method, output=output)
    if not got.solved:
        return got, math.inf
    error = 0.0
    for t, expected in zip(reference["times"], reference["states"]):
        if all(abs(t - k) > 1e-9 * system.end for k in kept):
            continue
        row = int(np.argmin(np.abs(got.times - t)))
        seen = got.state if abs(t - system.end) < 1e-9 * system.end else got.states[row]
        if abs(got.times[row] - t) > 1e-9 * system.end or not np.isfinite(seen).all():
            return got, math.inf
        error = max(error, float(np.abs(seen - np.asarray(expected)).max()))
    return got, error
