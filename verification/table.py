"""The table: on stdout a line for each row; on a page a matrix for each check."""

from __future__ import annotations

from collections import Counter

from .verdict import Row

TITLES = {
    "order": "Observed orders",
    "linear": "Largest error on linear systems, at steps of any length",
    "projection": "The default law against `guard` and `none`: error as a multiple of the better of the two",
    "tolerance": "Tolerances: error as a multiple of tolerance × gain",
    "law": "Largest rise of the kept energy in a step, relative to it, for h = 1/4, 3, 30, 300",
    "backends": "Largest distance between backends",
    "certificate": "Promises against eigenvalues",
    "scale": "Distance to the same solution in other units",
    "ensemble": "Distance of members to single runs",
    "drift": "Relative drift of the kept energy in 100 000 steps without damping",
    "ending": "Runs that are hard to end",
    "reference": "References",
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


def page(rows: list[Row], version: str, seconds: float, systems: list, command: str) -> str:
    wrong = [row for row in rows if row.verdict == "wrong"]
    text = f"""# Verification

What `{command}` found when it was last run for this page, with {version}: {summary(rows)}, in {seconds:.0f} s.

The suite stands in `verification/`, apart from the tests. Its {len(systems)} systems are in no case file of this project. Each is written twice: as a user writes it, by formula
or in matrices, and as a plain right-hand side in NumPy. References are by Radau IIA collocation of order 17, compared with order 13 and with SciPy, or closed forms: their own error is 1e-14 or
better, and stands in `verification/references.json`. The program only meets them in the comparison.

| check | what must hold |
|---|---|
| order | the slope of the error over the last three of falling steps is the order that `seiche list methods` declares, less 0.4 or a tenth; or what the system allows |
| linear | methods with all of the linear part in the exponential are exact on linear systems, however far apart the rates |
| projection | the default law's error is at most twice that of `law = "guard"` and of `law = "none"` (three times for methods of order two), also where steps resolve neither layers nor oscillations |
| tolerance | the error is at most ten times tolerance × gain, gain = ∫‖∂z(T)/∂z(t)‖dt: what one error per unit of time amounts to |
| law | where a law is promised, no recorded energy rises beyond round-off for h = 1/4 … 300, and none is promised where the exact H may rise |
| backends | dense, modal and sparse differ by round-off |
| certificate | `seiche check` promises where eigenvalues of random systems say so, and nowhere else |
| scale | lengths and times of 2^±100 change nothing |
| ensemble | members are single runs |
| drift | 100 000 steps of a free pendulum keep their energy |
| ending | blow-ups, collapsing steps and extreme rates end within 60 s of a processor, with a true word |

```sh
make verify                             # all of it, some minutes on two cores
make verify VERIFY="--only morse"       # one system; --quick, --json, --check order,law, --page FILE
make verify VERIFY=--references         # compute the references anew
```

A part of it is the test `verification` of `ctest`. A dash means that the method refuses the system with a reason.
"""
    if wrong:
        text += "\n## Wrong\n\n| system | method | check | expected | got | |\n|---|---|---|---|---|---|\n"
        text += "\n".join(f"| {r.system} | {r.method} | {r.check} | {r.expected} | {r.got} | {r.note.replace('|', '/')} |" for r in wrong) + "\n"
    for check, title in TITLES.items():
        chosen = [row for row in rows if row.check.split(",")[0] == check]
        if chosen:
            text += f"\n## {title}\n\n{matrix(chosen)}\n"
    text += "\n## The systems\n\n| system | end | |\n|---|---|---|\n"
    return text + "\n".join(f"| {s.name} | {s.end:g} | {s.about} |" for s in systems) + "\n"
