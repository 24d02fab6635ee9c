"""The table: on stdout a line for each row; a page of results, and one with a matrix for each check."""

from __future__ import annotations

import math
import re
from collections import Counter

from .verdict import Row

# Of each check the title of its rows, and what must hold.
CHECKS = {
    "order": ("Observed orders",
              "the slope of the error over the last three of falling steps is the order that `seiche list methods` declares, less 0.4 or a tenth; or what the system allows"),
    "linear": ("Largest error on linear systems, at steps of any length",
               "methods with all of the linear part in the exponential are exact on linear systems, however far apart the rates"),
    "projection": ("The default law against `guard` and `none`: error as a multiple of the better of the two",
                   "the default law's error is at most twice that of `guard` and of `none` (three times for order two), also where steps resolve neither layers nor oscillations"),
    "tolerance": ("Tolerances: error as a multiple of tolerance × gain",
                  "the error is at most ten times tolerance × gain, gain = ∫‖∂z(T)/∂z(t)‖dt: what one error per unit of time amounts to"),
    "law": ("Largest rise of the kept energy in a step, relative to it, for h = 1/4, 3, 30, 300",
            "where a law is promised, no recorded energy rises beyond round-off for h = 1/4 … 300, and none is promised where the exact H may rise"),
    "backends": ("Largest distance between backends", "dense, modal and sparse differ by round-off"),
    "certificate": ("Promises against eigenvalues", "`seiche check` promises where eigenvalues of random systems say so, and nowhere else"),
    "scale": ("Distance to the same solution in other units", "lengths and times of 2^±100 change nothing"),
    "ensemble": ("Distance of members to single runs", "members are single runs"),
    "drift": ("Relative drift of the kept energy in 100 000 steps without damping", "100 000 steps of a free pendulum keep their energy"),
    "ending": ("Runs that are hard to end",
               "blow-ups, collapsing steps and extreme rates end within 60 s of a processor, with a true word"),
    "reference": ("References", "the references are of these systems, and their own error is small"),
}


def line(row: Row) -> str:
    note = f"   {row.note}" if row.note and row.verdict == "wrong" else ""
    return f"{row.system:28}  {row.method:16}  {row.check:11}  {row.expected:>22}  {row.got:>14}  {row.verdict}{note}"


HEADER = f"{'system':28}  {'method':16}  {'check':11}  {'expected':>22}  {'got':>14}  verdict"


def summary(rows: list[Row]) -> str:
    counts = Counter(row.verdict for row in rows)
    return f"{counts['right']} right, {counts['wrong']} wrong, {counts['refused']} refused (the method does not take the system, and says why)"


def cell(row: Row) -> str:
    shown = {"refused": "–"}.get(row.verdict, row.got.replace("|", "/"))
    return f"**{shown}** ✗" if row.verdict == "wrong" else shown


def matrix(rows: list[Row]) -> str:
    """Systems down, methods across; or across and down, where there is one system."""
    systems, methods = list(dict.fromkeys(r.system for r in rows)), list(dict.fromkeys(r.method for r in rows))
    cells = {(r.system, r.method): cell(r) for r in rows}
    if len(cells) < 0.4 * len(systems) * len(methods) or len(systems) == 1:  # hardly a matrix
        lines = ["| system | method | expected | got |", "|---|---|---|---|"]
        lines += [f"| {r.system} | {r.method} | {r.expected} | {cell(r)} |" for r in rows]
    else:
        lines = ["| | " + " | ".join(methods) + " |", "|---" * (len(methods) + 1) + "|"]
        lines += [f"| {s} | " + " | ".join(cells.get((s, m), "") for m in methods) + " |" for s in systems]
    return "\n".join(lines)


def of_check(rows: list[Row], check: str) -> list[Row]:
    return [row for row in rows if row.check.split(",")[0] == check]


def nearest(rows: list[Row]) -> str:
    """The row that came nearest to its bound."""
    def closeness(row: Row) -> float:
        bound = re.match(r"([≤≥]) ([-+.\de]+)", row.expected)
        try:
            got = float(row.got.split()[0].rstrip(","))
        except ValueError:
            return -math.inf  # a word
        if row.verdict != "right" or not (bound or row.expected == "no rise"):
            return -math.inf
        if not bound:
            return got
        return float(bound.group(2)) / got if bound.group(1) == "≥" else got / float(bound.group(2))

    worst = max(rows, key=closeness)
    if closeness(worst) == -math.inf:
        return ""
    return f"{worst.got.split(',')[0]}, {worst.expected} ({worst.system}, {worst.method})"


def pages(rows: list[Row], version: str, seconds: float, systems: list, command: str) -> tuple[str, str]:
    """Markdown: the results on one screen, and every row."""
    wrong = [row for row in rows if row.verdict == "wrong"]
    results = f"""# Verification

What `{command}` found when it was last run for this page, with {version}:
{summary(rows)}, in {seconds:.0f} s.

The suite stands in `verification/`, apart from the tests. Its {len(systems)} systems are in no case file of this project. Each is
written twice: as a user writes it, by formula or in matrices, and as a plain right-hand side in NumPy. References are
by Radau IIA collocation of order 17, compared with order 13 and with SciPy, or closed forms: their own error is 1e-14
or better, and stands in `verification/references.json`. The program only meets them in the comparison.

| check | what must hold | right | wrong | refused | nearest to its bound |
|---|---|---|---|---|---|
"""
    every = f"# Verification: every row\n\nBy `{command}`, with {version}. A dash means that the method refuses the system with a reason.\n"
    for check, (title, held) in CHECKS.items():
        chosen = of_check(rows, check)
        if chosen:
            counts = Counter(row.verdict for row in chosen)
            results += f"| {check} | {held} | {counts['right']} | {counts['wrong']} | {counts['refused']} | {nearest(chosen)} |\n"
            every += f"\n## {title}\n\n{matrix(chosen)}\n"
    if wrong:
        results += "\n## Wrong\n\n| system | method | check | expected | got | |\n|---|---|---|---|---|---|\n"
        results += "\n".join(f"| {r.system} | {r.method} | {r.check} | {r.expected} | {r.got} | {r.note.replace('|', '/')} |" for r in wrong) + "\n"
    results += """
```sh
make verify                             # all of it, half an hour on two cores
make verify VERIFY="--only morse"       # one system; --quick, --json, --check order,law, --page FILE
make verify VERIFY=--references         # compute the references anew
```

A whole run leaves every row in `build/verification_rows.md`, and `make docs` shows that file beside this page. A part
of the suite is the test `verification` of `ctest`.
"""
    every += "\n## The systems\n\n| system | end | |\n|---|---|---|\n"
    return results, every + "\n".join(f"| {s.name} | {s.end:g} | {s.about} |" for s in systems) + "\n"
