"""Random S, M and D in Matrix Market files, with a quartic potential; or as tables of numbers in the case."""

import numpy as np

from ..system import System


def market(A: np.ndarray) -> str:
    n, m = A.shape
    entries = "\n".join(repr(float(x)) for x in A.T.ravel())
    return f"%%MatrixMarket matrix array real general\n{n} {m}\n{entries}\n"


def definite(rng, n: int, rank: int | None = None) -> np.ndarray:
    """Symmetric, of the given rank, eigenvalues between 0.5 and 2."""
    Q, _ = np.linalg.qr(rng.normal(size=(n, n)))
    values = rng.uniform(0.5, 2, n)
    values[(n if rank is None else rank) :] = 0
    A = (Q * values) @ Q.T
    return (A + A.T) / 2


def skew(rng, n: int) -> np.ndarray:
    A = rng.normal(size=(n, n)) / np.sqrt(n)
    return A - A.T


def one_field(seed: int, n: int, rank: int | None = None, dissipative: bool = False) -> System:
    """ż = S(Mz + z³) − Dz with D = G M + …: commuting with nothing, and sym(P_H D) ⪰ 0 only if D is a multiple of 1."""
    rng = np.random.default_rng(seed)
    M, S = definite(rng, n, rank), skew(rng, n)
    if dissipative:
        S = S - 0.1 * definite(rng, n, n // 2)
    D = 0.2 * np.eye(n) if not dissipative else np.zeros((n, n))
    z0 = np.exp(-((((np.arange(n) + 0.5) / n - 0.5) / 0.1) ** 2))
    return System(
        name=f"random_{n}_{seed}",
        problem="""name = "sparse"
M = "M.mtx"
S = "S.mtx"
D = "D.mtx"
fields = 1
quartic = 1.0
gamma = 0.0""",
        rhs=lambda t, z: S @ (M @ z + z**3) - D @ z,
        z0=z0,
        end=4.0,
        steps=(1 / 2, 1 / 4, 1 / 8, 1 / 16),
        gross=(1.0,),
        files={"M.mtx": market(M), "S.mtx": market(S), "D.mtx": market(D)},
        quick=seed == 2,
        about=f"M of rank {rank or n}" + (", sym(S) negative semidefinite" if dissipative else ""),
    )


def two_fields(seed: int, n: int) -> System:
    """ü + Γu̇ + Ku + u³ = 0 with random K and Γ of low rank, which do not commute."""
    rng = np.random.default_rng(seed)
    K, G = definite(rng, n), 0.5 * definite(rng, n, max(1, n // 2))
    zero = np.zeros((n, n))
    M = np.block([[K, zero], [zero, np.eye(n)]])
    D = np.block([[zero, zero], [zero, G]])
    u0 = np.exp(-((((np.arange(n) + 0.5) / n - 0.5) / 0.1) ** 2))
    return System(
        name=f"random_mechanical_{n}_{seed}",
        problem="""name = "sparse"
M = "M.mtx"
D = "D.mtx"
quartic = 1.0
gamma = "0.05 + 0.04*sin(t)\"""",
        rhs=lambda t, z: np.concatenate([z[n:], -K @ z[:n] - z[:n] ** 3 - G @ z[n:] - (0.05 + 0.04 * np.sin(t)) * z[n:]]),
        z0=np.concatenate([u0, np.zeros(n)]),
        end=5.0,
        steps=(1 / 2, 1 / 4, 1 / 8, 1 / 16),
        gross=(1.0,),
        files={"M.mtx": market(M), "D.mtx": market(D)},
        about="stiffness and friction that do not commute",
    )


def by_table(seed: int, n: int) -> System:
    """n fields a1 … an, S and D tables of numbers, H a formula with a term that couples all."""
    rng = np.random.default_rng(seed)
    M, S, D = definite(rng, n), skew(rng, n), 0.2 * definite(rng, n)
    names = [f"a{i}" for i in range(1, n + 1)]
    total = " + ".join(names)
    quadratic = " + ".join(f"({float(M[i, j])!r})*{names[i]}*{names[j]}/2" for i in range(n) for j in range(n))
    rows = [[float(x) for x in row] for row in S]
    rates = [[float(x) for x in row] for row in D]
    z0 = np.round(rng.uniform(-1, 1, n), 3)
    ones = np.ones(n)
    start = ", ".join(f"{name} = {float(x)!r}" for name, x in zip(names, z0))
    return System(
        name=f"table_{n}_{seed}",
        problem=f"""name = "custom"
fields = {names!r}
H = "{quadratic} + cosh({total}) - 1"
S = {rows!r}
D = {rates!r}
initial = {{ {start} }}""".replace("'", '"'),
        rhs=lambda t, z: S @ (M @ z + np.sinh(z.sum()) * ones) - D @ z,
        z0=z0,
        end=4.0,
        steps=(1 / 4, 1 / 8, 1 / 16, 1 / 32),
        gross=(0.5,),
        law="free",
        about="full tables of numbers in the case file",
    )


SYSTEMS = [
    one_field(1, 2),
    one_field(2, 7),
    one_field(3, 20, rank=12),
    one_field(4, 40),
    one_field(5, 9, dissipative=True),
    two_fields(6, 5),
    two_fields(7, 20),
    by_table(8, 3),
    by_table(9, 6),
]
