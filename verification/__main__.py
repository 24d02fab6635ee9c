"""Runs the suite: python3 -m verification [--quick] [--only SYSTEM,…] [--check NAME,…] [--json] [--page FILE] [--references]"""

from __future__ import annotations

import os

for threads in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(threads, "1")  # the pool has one process per core

import argparse
import json
import subprocess
import sys
import time
from multiprocessing import Pool
from pathlib import Path

try:
    import h5py, numpy, scipy  # noqa: E401, F401
except ImportError as missing:
    print(f"verification: {missing}; scripts/install-deps --python installs it", file=sys.stderr)
    sys.exit(77)  # as a test it is skipped

from . import program, reference, table
from .checks import backends, certificate, drift, ending, ensemble, law, linear, order, projection, scale, tolerance
from .systems import SYSTEMS
from .verdict import Row, row

OF_SYSTEMS = {"order": order, "linear": linear, "projection": projection, "tolerance": tolerance, "law": law, "backends": backends}
OF_THEIR_OWN = {"certificate": certificate, "scale": scale, "ensemble": ensemble, "drift": drift, "ending": ending}
LEFT_OUT_OF_QUICK = {"ending"}
REFERENCES = reference.load()
ROWS = Path(__file__).resolve().parents[1] / "build/verification_rows.md"  # docs/site/build.py takes it from there


def judge(task) -> list[Row]:
    check, first, second = task
    if check in OF_SYSTEMS:
        system = SYSTEMS[first]
        return OF_SYSTEMS[check].judge(system, second, REFERENCES[first])
    return OF_THEIR_OWN[check].judge(first, second)


def remake(name: str) -> tuple[str, dict]:
    return name, reference.make(SYSTEMS[name])


def reference_rows(names: list[str]) -> list[Row]:
    """References that belong to another right-hand side, or whose own error is too large, are wrong before anything is run."""
    rows = []
    for name in names:
        kept = REFERENCES.get(name)
        if kept is None or kept["fingerprint"] != reference.fingerprint(SYSTEMS[name]):
            rows.append(row(name, "–", "reference", "of this system", "missing or stale: --references", False))
        elif kept["error"] > 1e-11 or kept["scipy"] > 1e-9:
            rows.append(row(name, "–", "reference", "≤ 1e-11, SciPy ≤ 1e-9", f"{kept['error']:.1e}, {kept['scipy']:.1e}", False))
    return rows


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="verification", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="the part that the continuous integration runs, less than a minute")
    parser.add_argument("--only", default="", help="systems, by name")
    parser.add_argument("--check", default="", help="checks, by name: " + ", ".join([*OF_SYSTEMS, *OF_THEIR_OWN]))
    parser.add_argument("--json", action="store_true", help="rows as one JSON document on stdout")
    parser.add_argument("--page", type=Path, help="write the page of results, docs/verification.md, to this file, and every row to build/verification_rows.md, as a whole run does anyway")
    parser.add_argument("--references", action="store_true", help="compute the references anew; runs nothing")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes")
    parser.add_argument("--program", type=Path, help="the program; by default build/release/seiche")
    parser.add_argument("--time-out", type=int, help="seconds of a processor that a run may take; 60")
    parser.add_argument("--cases", type=Path, help="write the case of every wrong row into this folder")
    given = parser.parse_args()
    for name in filter(None, given.only.split(",")):
        if name not in SYSTEMS:
            parser.error(f"unknown system '{name}'; there are {', '.join(SYSTEMS)}")
    for name in filter(None, given.check.split(",")):
        if name not in OF_SYSTEMS and name not in OF_THEIR_OWN:
            parser.error(f"unknown check '{name}'; there are {', '.join([*OF_SYSTEMS, *OF_THEIR_OWN])}")
    return given


def tasks(given: argparse.Namespace, names: list[str]) -> list[tuple]:
    checks = set(filter(None, given.check.split(",")))
    methods = program.methods()
    found = []
    for check, module in OF_SYSTEMS.items():
        if not checks or check in checks:
            found += [(check, s.name, m) for s, m in module.tasks([SYSTEMS[name] for name in names], methods, given.quick)]
    for check, module in OF_THEIR_OWN.items():
        if check in checks or (not checks and not given.only and not (given.quick and check in LEFT_OUT_OF_QUICK)):
            found += [(check, *task) for task in module.tasks([], methods, given.quick)]
    return found


def write_pages(given: argparse.Namespace, rows: list[Row], seconds: float) -> None:
    version = subprocess.run([program.PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]
    command = "make verify" + (' VERIFY="--quick"' if given.quick else "")
    results, every = table.pages(rows, version, seconds, list(SYSTEMS.values()), command)
    ROWS.parent.mkdir(exist_ok=True)
    ROWS.write_text(every, encoding="utf-8")
    if given.page:
        given.page.write_text(results, encoding="utf-8")


def main() -> int:
    given = arguments()
    if given.program:
        program.PROGRAM = given.program.resolve()
    only = list(filter(None, given.only.split(",")))
    names = only or [s.name for s in SYSTEMS.values() if s.quick or not given.quick]
    if given.references:
        kept = {name: r for name, r in REFERENCES.items() if name in SYSTEMS}
        with Pool(given.jobs) as pool:
            for name, made in pool.imap_unordered(remake, only or list(SYSTEMS)):
                kept[name] = made
                print(f"{name:28}  {made['by']}: error {made['error']:.1e}, SciPy's {made['scipy']:.1e}, gain {made['gain']:.3g}")
                reference.store(kept)
        return 0
    if not program.PROGRAM.exists():
        print(f"verification: {program.PROGRAM} is not there; build it, or name it by --program", file=sys.stderr)
        return 2
    program.TIME_OUT = given.time_out or program.TIME_OUT
    start = time.monotonic()
    rows = reference_rows(names)
    names = [name for name in names if name in REFERENCES]
    if not given.json:
        print(table.HEADER)
    with Pool(given.jobs) as pool:
        for some in pool.imap(judge, tasks(given, names)):
            rows += some
            if not given.json:
                print(*map(table.line, some), sep="\n", flush=True)
    seconds = time.monotonic() - start
    wrong = [r for r in rows if r.verdict == "wrong"]
    if given.json:
        print(json.dumps([r.public() for r in rows], ensure_ascii=False, indent=1))
    else:
        print(f"\n{table.summary(rows)}, in {seconds:.0f} s")
        print(*map(table.line, wrong), sep="\n")
    if given.cases:
        given.cases.mkdir(parents=True, exist_ok=True)
        for r in wrong:
            name = "_".join((r.system, r.method, r.check)).replace(" ", "-").replace("/", "-")
            (given.cases / f"{name}.toml").write_text(r.case)
    if given.page or not (given.quick or only or given.check):
        write_pages(given, rows, seconds)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
