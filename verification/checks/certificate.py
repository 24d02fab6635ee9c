"""The promise of `seiche check --json` against eigenvalues of the matrices, on random systems from files.

For z = (u, v) with H = ½zᵀMz + a/4 Σu⁴ and damping on v alone the law holds if sym(S) ⪯ 0, M ⪰ 0 and sym(MD) ⪰ 0; where damping moves u as well, it does
for D = c·1. For another diagonal D ⪰ 0 it may hold too, but the certificate asks for a multiple of 1 and must say so. The damping is D + γP, where P marks v:
where P and D commute, the two are one matrix and gamma may make up for what D feeds; where they do not, each is judged by itself.

Every row expects one answer, and where it is a refusal or no promise, the sentence that belongs to it. A system whose eigenvalues round-off decides, or whose
law they leave open, counts as wrong: another one must be drawn.
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
    "gamma beside D that couples",
)
FEEDS = "sym(MD) is not positive semidefinite: the damping feeds some direction"
GAINS = "sym(S) is not negative semidefinite"
NOT_A_MULTIPLE = "the energy-compatible damping condition is not guaranteed"
NOT_SEMIDEFINITE = "M must be positive semidefinite, but zᵀMz = -"


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
    if kind == 11:
        D = np.block([[0.3 * one, 0.01 * rng.normal(size=(n, n))], [zero, G - 0.1 * np.outer(x, x)]])
        drawn |= {"gamma": 0.3, "quartic": 0.0}
    if kind >= 7 and kind <= 9:
        drawn["fields"] = 1
        M, S = definite(rng, n), skew(rng, n)
        D = {7: 0.3 * one, 8: np.diag(rng.uniform(0.0, 1.0, n)), 9: definite(rng, n) + skew(rng, n)}[kind]
        drawn["quartic"] = 0.0 if kind == 9 else 1.0
    return drawn | {"M": M, "S": S, "D": D}


def expected(drawn: dict, kind: int) -> tuple[str, str]:
    """The answer, and words of its sentence."""
    M, S, D = drawn["M"], drawn["S"], drawn["D"]
    n = M.shape[0]
    P = np.diag(np.repeat([0.0, 1.0], n // 2)) if drawn["fields"] == 2 else np.zeros((n, n))
    parts = [D + drawn["gamma"] * P] if np.array_equal(D @ P, P @ D) else [D, drawn["gamma"] * P]
    largest_of_S = float(np.linalg.eigvalsh((S + S.T) / 2)[-1])
    of_M, of_MD = smallest(M), min(smallest(M @ part) for part in parts)
    if any(0 < abs(s) < 1e-9 for s in (of_M, of_MD)) or 1e-12 < abs(largest_of_S) < 1e-9:
        return "undecided", ""
    if of_M < 0:
        return "refused", NOT_SEMIDEFINITE
    if largest_of_S > 1e-9:
        return "not promised", GAINS
    if kind == KINDS.index("D diagonal"):
        return "not promised", NOT_A_MULTIPLE
    return ("promised", "") if of_MD >= 0 else ("not promised", FEEDS)


def contradiction(drawn: dict, answer: str) -> bool:
    """Is a law promised although small z rise? By −dH/dt of the linear part, whatever S does."""
    M, S, D = drawn["M"], drawn["S"], drawn["D"].copy()
    n = M.shape[0]
    if drawn["fields"] == 2:
        D[n // 2 :, n // 2 :] += drawn["gamma"] * np.eye(n // 2)
    return answer == "promised" and smallest(M @ D - M @ S @ M) < -1e-9


def judge(kind, seed, reference=None) -> list[Row]:
    drawn = draw(kind, seed)
    wanted, words = expected(drawn, kind)
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
        said, reason = "refused", answer["refused"]
    else:
        said, reason = ("promised" if answer["law"]["promised"] else "not promised"), answer["law"]["reason"]
    right = said == wanted and words in reason and not contradiction(drawn, said)
    size = drawn["M"].shape[0]
    note = reason if words in reason else f"it does not say '{words}' but: {reason}"
    return [row(name, f"seed {seed}, n = {size}", "certificate", wanted, said, right, case, note)]
