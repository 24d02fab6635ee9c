"""Damping and forces that change in time."""

import numpy as np

from ..system import System, canonical

HALVES = (1 / 4, 1 / 8, 1 / 16, 1 / 32)


def turning(t, s):
    a, b, p, r = s
    return np.array([p, r, -a - a**3 - (0.3 + 0.2 * np.sin(2 * t)) * p - 0.1 * r, -2 * b - 0.1 * p - 0.25 * r])


SYSTEMS = [
    System(
        name="ramp",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
D = { p = "0.05 + 0.4*t/(1 + t)" }
initial = { q = 1.3, p = 0 }""",
        rhs=canonical(lambda q: -q - q**3, lambda t, p: (0.05 + 0.4 * t / (1 + t)) * p),
        z0=np.array([1.3, 0]),
        end=6.0,
        steps=HALVES,
        gross=(0.5,),
    ),
    System(
        name="pulse",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
D = { p = "0.05 + 2*exp(-((t - 2)/0.5)^2)" }
initial = { q = 1.3, p = 0 }""",
        rhs=canonical(lambda q: -q - q**3, lambda t, p: (0.05 + 2 * np.exp(-(((t - 2) / 0.5) ** 2))) * p),
        z0=np.array([1.3, 0]),
        end=4.0,
        steps=(1 / 8, 1 / 16, 1 / 32, 1 / 64),
        gross=(0.5,),
    ),
    System(
        name="jump",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
D = { p = "0.5 + 0.45*sign(t - 1.3)" }
initial = { q = 1.3, p = 0 }""",
        rhs=canonical(lambda q: -q - q**3, lambda t, p: (0.05 if t < 1.3 else 0.95) * p),
        z0=np.array([1.3, 0]),
        end=4.0,
        breaks=(1.3,),
        about="a rate that jumps between two steps",
    ),
    System(
        name="turning_damping",
        problem="""name = "custom"
fields = ["a", "b", "p", "r"]
H = "(p^2 + r^2)/2 + a^2/2 + a^4/4 + b^2"
D = [[0,0,0,0],[0,0,0,0],[0,0,"0.3 + 0.2*sin(2*t)",0.1],[0,0,0.1,0.25]]
initial = { a = 1, b = 0.5, p = 0, r = 0.7 }""",
        rhs=turning,
        z0=np.array([1, 0.5, 0, 0.7]),
        end=5.0,
        steps=HALVES,
        gross=(0.5,),
        quick=True,
        about="D(t) does not commute with itself",
    ),
    System(
        name="forced",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
D = { p = 0.2 }
force = { p = "0.5*cos(1.3*t)" }
initial = { q = 0.5, p = 0 }""",
        rhs=lambda t, s: np.array([s[1], -s[0] - s[0] ** 3 - 0.2 * s[1] + 0.5 * np.cos(1.3 * t)]),
        z0=np.array([0.5, 0]),
        end=6.0,
        steps=HALVES,
        law="free",
        quick=True,
    ),
    System(
        name="forced_twice",
        problem="""name = "custom"
fields = ["a", "b", "p", "r"]
H = "(p^2 + r^2)/2 + (a^2 + b^2)/2 + a^2*b^2/2"
D = { p = 0.1, r = 0.3 }
force = { p = "sin(2*t)", r = "0.3*exp(-t)" }
initial = { a = 0.5, b = 1, p = 0, r = 0 }""",
        rhs=lambda t, s: np.array(
            [
                s[2],
                s[3],
                -s[0] - s[0] * s[1] ** 2 - 0.1 * s[2] + np.sin(2 * t),
                -s[1] - s[1] * s[0] ** 2 - 0.3 * s[3] + 0.3 * np.exp(-t),
            ]
        ),
        z0=np.array([0.5, 1, 0, 0]),
        end=5.0,
        steps=HALVES,
        law="free",
    ),
]
