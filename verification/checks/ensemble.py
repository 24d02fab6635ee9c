"""Members of an ensemble against single runs with their parameters."""

import numpy as np

from .. import program
from ..verdict import Row, row

AGREEMENT = 1e-12
MEMBERS = 19  # one full group of sixteen and a part of one
RANGE = (0.05, 0.4)


def tasks(systems, methods, quick):
    if quick:
        methods = [m for m in methods if m["name"] in ("savf", "seisav", "seilm", "egc6", "crkn6")]
    return [(m["name"], 1 / 16) for m in methods]


PROBLEMS = {
    "oscillator with gamma": """name = "custom"
fields = ["q", "p"]
parameters = { gamma = 0.1 }
H = "p^2/2 + q^2/2 + q^4/4"
D = { p = "gamma" }
initial = { q = 1, p = 0.5 }""",
    "ring with gamma": """name = "custom"
fields = ["u", "v"]
length = 6.0
points = 12
parameters = { gamma = 0.1 }
H = "v^2/2 + u_x^2/2 + u^4/4"
D = { v = "gamma" }
initial = { u = "1 + 0.5*sin(pi*x/3)", v = 0 }""",
}


def judge(name, h, reference=None) -> list[Row]:
    rows = []
    for problem_name, problem in PROBLEMS.items():
        method = {"name": name} | ({"h": h} if h else {"tolerance": 1e-7})
        check = "ensemble" if h else "ensemble, tolerance"
        case = program.case_text(problem, method, 4.0, ensemble=f"members = {MEMBERS}\ngamma = {{ from = {RANGE[0]}, to = {RANGE[1]} }}")
        got = program.run(case)
        if got.refused:
            rows.append(Row(problem_name, name, check, f"≤ {AGREEMENT:g}", "refused", "refused", note=got.said))
            continue
        if got.members is None or len(got.members) != MEMBERS:
            rows.append(row(problem_name, name, check, f"≤ {AGREEMENT:g}", got.outcome(), False, case))
            continue
        apart = 0.0
        for i in (0, 7, MEMBERS - 1):
            gamma = RANGE[0] + (RANGE[1] - RANGE[0]) * i / (MEMBERS - 1)
            single = program.run(program.case_text(problem.replace("gamma = 0.1", f"gamma = {gamma!r}"), method, 4.0))
            apart = max(apart, float(np.abs(single.state - got.members[i]).max()) if single.solved else np.inf)
        rows.append(row(problem_name, name, check, f"≤ {AGREEMENT:g}", f"{apart:.0e}", apart <= AGREEMENT, case))
    return rows
