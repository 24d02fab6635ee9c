"""Friction beyond linear."""

import numpy as np

from ..system import System, canonical

HALVES = (1 / 4, 1 / 8, 1 / 16, 1 / 32)
DUFFING = """name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
initial = { q = 1, p = 0.5 }
"""


def duffing(friction):
    return canonical(lambda q: -q - q**3, friction)


def van_der_pol(t, s):
    q, p = s
    return np.array([p, -q - 0.2 * q**3 - 0.8 * (q * q - 1) * p])


def position_and_speed(t, s):
    q, p = s
    return np.array([p, -q - q**3 - 0.2 * p - 0.1 * p**3 * (1 + q * q)])


START = np.array([1, 0.5])
SYSTEMS = [
    System(
        name="quadratic_drag",
        problem=DUFFING + 'friction = { kind = "quadratic", coefficient = 0.3 }',
        rhs=duffing(lambda t, p: 0.3 * p * np.where(p.real < 0, -p, p)),
        z0=START,
        end=5.0,
        steps=(1 / 8, 1 / 16, 1 / 32, 1 / 64),
        gross=(0.5,),
        limits=dict.fromkeys(("egc4", "egc6", "egc8", "etdrk4"), 2.5),
        tolerances=(1e-4, 1e-6),
        about="|v|v has one derivative only",
    ),
    System(
        name="cubic_friction",
        problem=DUFFING + 'friction = { kind = "cubic", coefficient = 0.3 }',
        rhs=duffing(lambda t, p: 0.3 * p**3),
        z0=START,
        end=5.0,
        steps=HALVES,
        gross=(0.5,),
    ),
    System(
        name="saturating_friction",
        problem=DUFFING + 'friction = { kind = "tanh", coefficient = 0.3, width = 0.5 }',
        rhs=duffing(lambda t, p: 0.3 * np.tanh(p / 0.5)),
        z0=START,
        end=5.0,
        steps=(1 / 8, 1 / 16, 1 / 32, 1 / 64),
        gross=(0.5,),
        quick=True,
    ),
    System(
        name="nearly_dry",
        problem=DUFFING + 'friction = { kind = "tanh", coefficient = 0.3, width = 0.02 }',
        rhs=duffing(lambda t, p: 0.3 * np.tanh(p / 0.02)),
        z0=START,
        end=4.0,
        gross=(0.25,),
        stiff=True,
        tolerances=(1e-4, 1e-6, 1e-9),
        about="tanh(v/0.02): a sharp turn at every standstill",
    ),
    System(
        name="van_der_pol_hard",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/20"
initial = { q = 0.5, p = 0 }
friction = { kind = "position", coefficient = "0.8*(q^2 - 1)" }""",
        rhs=van_der_pol,
        z0=np.array([0.5, 0]),
        end=6.0,
        steps=HALVES,
        law="free",
        about="friction that feeds",
    ),
    System(
        name="position_and_speed",
        problem=DUFFING + 'friction = { kind = "formula", r = "0.2*v + 0.1*v^3*(1 + u^2)" }',
        rhs=position_and_speed,
        z0=START,
        end=5.0,
        steps=HALVES,
        gross=(0.5,),
    ),
]
