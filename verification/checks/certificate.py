"""The promise of `seiche check --json` against eigenvalues of the matrices, on random systems from files.

For z = (u, v) with H = ½zᵀMz + a/4 Σu⁴ and damping on v alone the law holds if sym(S) ⪯ 0, M ⪰ 0 and sym(MD) ⪰ 0; where damping moves u as well, it does
for D = c·1. For another diagonal D ⪰ 0 it would too, and a promise is not asked for; nor where gamma makes up for what D feeds, since the parts of the damping
are judged one by one. Where round-off decides the sign of an eigenvalue, nothing is asked.
"""

import numpy as np

from .. import program
from ..systems.random_matrices import definite, market, skew
from ..verdict import Row, row

KINDS = (
    "friction of low rank",
    "friction that feeds",
    "friction that is not symmetric",
    "a mass matrix",
    "sym(S) negative",
    "sym(S) indefinite",
    "M indefinite",
    "D = c",
    "D diagonal",
    "linear",
    "gamma makes up for D",
)


def tasks(systems, methods, quick):
    return [(kind, seed) for seed in range(2 if quick else 6) for kind in range(len(KINDS))]


def smallest(A: np.ndarray) -> float:
    """Smallest eigenvalue of the symmetric part, relative to the largest in size; 0 for round-off."""
    values = np.linalg.eigvalsh((A + A.T) / 2)
    relative = values[0] / max(np.abs(values).max(), 1e-300)
    return 0.0 if abs(relative) < 1e-12 else float(relative)


def draw(kind: int, seed: int) -> dict:
    rng = np.random.default_rng([kind, seed])
    n = int(rng.integers(2, 13))
    zero, one = np.zeros((n, n)), np.eye(n)
    drawn = {"fields": 2, "gamma": 0.0, "quartic": 1.0}
    K, W, G = definite(rng, n, n if seed % 2 else max(1, n - 1)), one, definite(rng, n, max(1, n // 2))
    S = np.block([[zero, one], [-one, zero]])
    feed = 10.0 ** -rng.uniform(0.3, 4)
    x = rng.normal(size=n)
    x /= np.linalg.norm(x)
    if kind == 1:
        G = definite(rng, n) - (definite(rng, n)[0, 0] + 2 + feed) * np.outer(x, x)
    elif kind == 2:
        G = G + skew(rng, n)
    elif kind == 3:
        W, G = definite(rng, n), definite(rng, n)
    elif kind == 4:
        S = S - np.block([[zero, zero], [zero, definite(rng, n, 1)]])
        G = zero
    elif kind == 5:
        S = S + feed * np.block([[zero, zero], [zero, np.outer(x, x)]])
    elif kind == 6:
        K = definite(rng, n) - (3 + feed) * np.outer(x, x)
    elif kind == 10:
        G = G - 0.1 * np.outer(x, x)
        drawn["gamma"] = 0.05 if seed % 2 else 0.2
    M = np.block([[K, zero], [zero, W]])
    D = np.block([[zero, zero], [zero, G]])
    if kind >= 7 and kind <= 9:
        drawn["fields"] = 1
        M, S = definite(rng, n), skew(rng, n)
        D = {7: 0.3 * one, 8: np.diag(rng.uniform(0.0, 1.0, n)), 9: definite(rng, n) + skew(rng, n)}[kind]
        drawn["quartic"] = 0.0 if kind == 9 else 1.0
    return drawn | {"M": M, "S": S, "D": D}


def truth(drawn: dict, kind: int) -> bool | None:
    """Does the law hold? None: a promise is neither asked for nor false."""
    M, S, D = drawn["M"], drawn["S"], drawn["D"].copy()
    n = M.shape[0]
    if drawn["fields"] == 2:
        D[n // 2 :, n // 2 :] += drawn["gamma"] * np.eye(n // 2)
    signs = [-smallest(S + S.T) if np.abs(S + S.T).max() > 0 else 0.0, smallest(M), smallest(M @ D)]
    largest_of_S = float(np.linalg.eigvalsh((S + S.T) / 2)[-1])
    if any(0 < abs(s) < 1e-9 for s in signs[1:]):
        return None
    if largest_of_S > 1e-9 or signs[1] < 0:
        return False
    if signs[2] >= 0 and largest_of_S < 1e-12:
        by_parts = smallest(M @ drawn["D"]) >= 0
        return None if kind == KINDS.index("D diagonal") or not by_parts else True
    # −dH/dt of the linear part, whatever S does: if it is negative somewhere, small z rise
    rate = smallest(M @ D - M @ S @ M)
    return False if rate < -1e-9 else None


def judge(kind, seed, reference=None) -> list[Row]:
    drawn = draw(kind, seed)
    holds = truth(drawn, kind)
    problem = f"""name = "sparse"
M = "M.mtx"
S = "S.mtx"
D = "D.mtx"
fields = {drawn["fields"]}
quartic = {drawn["quartic"]}
gamma = {drawn["gamma"]}"""
    files = {f"{name}.mtx": market(drawn[name]) for name in "MSD"}
    case = program.case_text(problem, {"name": "egc4", "h": 0.1}, 1.0)
    name = f"random, {KINDS[kind]}"
    answer = program.check(case, files)
    if "refused" in answer:
        said, promised = "refused", False
    else:
        promised = answer["law"]["promised"]
        said = "promised" if promised else "not promised"
    expected = {True: "promised", False: "not promised", None: "either"}[holds]
    right = holds is None or promised == holds
    size = drawn["M"].shape[0]
    note = answer.get("refused") or answer["law"]["reason"]
    return [row(name, f"seed {seed}, n = {size}", "certificate", expected, said, right, case, note)]
