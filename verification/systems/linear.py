"""Linear systems with closed forms: far apart rates, defective matrices, chains."""

import numpy as np
from scipy.linalg import expm

from ..system import System


def damped(omega2: float, gamma: float, q: float, p: float, t: float) -> tuple[float, float]:
    """(q, p)(t) of q̈ + γq̇ + ω²q = 0, without cancellation where γ is large."""
    d = gamma * gamma / 4 - omega2
    if d < 0:
        w = np.sqrt(-d)
        c, s = np.cos(w * t), np.sin(w * t) / w
    elif d == 0:
        c, s = 1.0, t
    else:
        slow = -omega2 / (gamma / 2 + np.sqrt(d))
        fast = -(gamma / 2 + np.sqrt(d))
        a, b = (p - fast * q) / (slow - fast), (slow * q - p) / (slow - fast)
        return a * np.exp(slow * t) + b * np.exp(fast * t), a * slow * np.exp(slow * t) + b * fast * np.exp(fast * t)
    e = np.exp(-gamma * t / 2)
    return e * (q * c + (p + gamma / 2 * q) * s), e * (p * c - (omega2 * q + gamma / 2 * p) * s)


def two_rates(rate: float, fast: float = 0.0) -> System:
    """A slow oscillator beside one whose frequency is `rate`; `fast` is the amplitude of the latter."""

    def exact(t):
        a, p = damped(rate**2, 0.125, fast, 0.0, t)
        b, r = damped(1.0, 0.125, 1.0, 0.0, t)
        return np.array([a, b, p, r])

    return System(
        name=f"two_rates_1e{round(np.log10(rate))}" + ("_both" if fast else ""),
        problem=f"""name = "custom"
fields = ["a", "b", "p", "r"]
H = "(p^2 + r^2)/2 + {rate**2!r}*a^2/2 + b^2/2"
D = {{ p = 0.125, r = 0.125 }}
initial = {{ a = {fast!r}, b = 1, p = 0, r = 0 }}""",
        rhs=lambda t, s: np.array([s[2], s[3], -(rate**2) * s[0] - 0.125 * s[2], -s[1] - 0.125 * s[3]]),
        z0=np.array([fast, 1, 0, 0]),
        end=10.0,
        gross=(0.125, 0.05),
        exact=exact,
        gain=10.0,
        tolerances=(1e-4, 1e-9),
        quick=rate == 1e6,
        about="two oscillators that do not meet; the fast one is at rest" if not fast else "both move",
    )


def chain_matrix(n: int) -> np.ndarray:
    K = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    return np.block([[np.zeros((n, n)), np.eye(n)], [-K, -0.02 * np.eye(n) - 0.1 * K]])


CHAIN = chain_matrix(11)
PLUCKED = np.concatenate([np.exp(-((np.arange(1, 12) - 4) ** 2) / 2), np.zeros(11)])

SYSTEMS = [
    *(two_rates(rate) for rate in (1e3, 1e5, 1e6, 1e7, 1e9)),
    two_rates(1e3, fast=1e-3),
    System(
        name="critical_damping",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 + 2*q^2"
D = { p = 4 }
initial = { q = 1, p = 0.5 }""",
        rhs=lambda t, s: np.array([s[1], -4 * s[0] - 4 * s[1]]),
        z0=np.array([1, 0.5]),
        end=3.0,
        gross=(0.25, 1.0),
        exact=lambda t: np.array(damped(4, 4, 1, 0.5, t)),
        about="a matrix without a basis of eigenvectors",
    ),
    System(
        name="slow_decay",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2"
D = { p = 1e9 }
initial = { q = 1, p = 0.5 }""",
        rhs=lambda t, s: np.array([s[1], -s[0] - 1e9 * s[1]]),
        z0=np.array([1, 0.5]),
        end=1e9,
        gross=(1e7, 1.25e8),
        exact=lambda t: np.array(damped(1, 1e9, 1, 0.5, t)),
        stiff=True,
        gain=1e9,
        tolerances=(),
        about="rates 1e9 and 1e-9",
    ),
    System(
        name="linear_chain",
        problem="""name = "custom"
fields = ["u", "v"]
length = 12.0
points = 12
boundary = "dirichlet"
H = "v^2/2 + du^2/2"
D = { v = "0.02 - 0.1*laplacian" }
initial = { u = "exp(-(x - 4)^2/2)", v = 0 }""",
        rhs=lambda t, s: CHAIN @ s,
        z0=PLUCKED,
        end=10.0,
        gross=(0.25, 1.0),
        exact=lambda t: expm(CHAIN * t) @ PLUCKED,
        about="masses, springs and dashpots",
    ),
]
