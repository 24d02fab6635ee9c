"""A few degrees of freedom, H by a formula."""

import numpy as np

from ..system import System, canonical

HALVES = (1 / 4, 1 / 8, 1 / 16, 1 / 32)


def z(*values):
    return np.array(values, float)


def kepler(t, s):
    q, p = s[:2], s[2:]
    return np.concatenate([p, -q / (q @ q) ** 1.5 - 0.05 * p])


def toda_ring(t, s):
    q, p = s[:3], s[3:]
    bond = np.exp(q - np.roll(q, -1))
    return np.concatenate([p, np.roll(bond, 1) - bond - 0.1 * p])


def henon_heiles(t, s):
    x, y, px, py = s
    D = np.array([[0.10, 0.05], [0.05, 0.20]])
    return np.concatenate([s[2:], np.array([-x - 2 * x * y, -y - x * x + y * y]) - D @ s[2:]])


def double_pendulum(t, s):
    a, b, p, r = s
    return np.array([p - 0.5 * r, r - 0.5 * p, -2 * np.sin(a) - 0.3 * np.sin(a - b) - 0.05 * p, -np.sin(b) + 0.3 * np.sin(a - b) - 0.1 * r])


def magnetic(t, s):
    q, p = s[:2], s[2:]
    r2 = q @ q
    return np.array([p[0], p[1], -q[0] * r2 + 2 * p[1] - 0.1 * p[0], -q[1] * r2 - 2 * p[0] - 0.1 * p[1]])


def odd_structure(t, s):
    x, y, w = s
    g = np.array([x + x**3, 2 * y + 0.5 * y**3, w])
    return np.array([[0, 1, -0.5], [-1, 0, 0.7], [0.5, -0.7, 0]]) @ g - np.array([0.1, 0.2, 0.05]) * s


def dissipative_structure(t, s):
    q, p = s
    g = np.array([q + q**3, p])
    return np.array([[-0.3, 1.0], [-1.0, -0.1]]) @ g


def gradient_flow(t, s):
    a, b = s
    m = a * a + b * b - 1
    return -np.array([a * m + (a - b), b * m - (a - b)])


def coupled(t, s):
    a, b, p, r = s
    return np.array([p, r, -2 * a - b + np.sin(a - b) - 0.1 * p, -a - 2 * b - np.sin(a - b) - 0.1 * r])


def two_oscillators(length: float = 1.0, time: float = 1.0) -> str:
    """q̈ + 0.1q̇ + q + q³ = 0 beside a second that hangs on it: coordinates in units of `length`, t in units of `time`."""
    k, c, g = 1 / time**2, 1 / (time * length) ** 2, 0.1 / time
    return f"""name = "custom"
fields = ["a", "b", "p", "r"]
H = "(p^2 + r^2)/2 + {k!r}*(a^2/2 + b^2 - a*b/2) + {c!r}*a^4/4"
D = {{ p = {g!r}, r = {g!r} }}
initial = {{ a = {length!r}, b = {0.5 * length!r}, p = {0.25 * length / time!r}, r = 0 }}"""


SYSTEMS = [
    System(
        name="two_oscillators",
        problem=two_oscillators(),
        rhs=lambda t, s: np.array(
            [s[2], s[3], -s[0] + s[1] / 2 - s[0] ** 3 - 0.1 * s[2], -2 * s[1] + s[0] / 2 - 0.1 * s[3]]
        ),
        z0=z(1, 0.5, 0.25, 0),
        end=4.0,
        steps=HALVES,
        gross=(0.5,),
        about="a hardening oscillator and a linear one that hangs on it",
    ),
    System(
        name="overdamped",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
D = { p = 1000 }
initial = { q = 1, p = 0.3 }""",
        rhs=canonical(lambda q: -q - q**3, lambda t, p: 1000 * p),
        z0=z(1, 0.3),
        end=10.0,
        gross=(0.1, 0.05, 0.025),
        stiff=True,
        quick=True,
        about="an initial layer of length 0.001, which no step resolves",
    ),
    System(
        name="overdamped_extreme",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
D = { p = 1e8 }
initial = { q = 1, p = 1 }""",
        rhs=canonical(lambda q: -q - q**3, lambda t, p: 1e8 * p),
        z0=z(1, 1),
        end=1e7,
        gross=(1e4, 5e4),
        stiff=True,
        gain=1e7,
        tolerances=(),
        about="the same at γ = 1e8, over a slow time of 1e7",
    ),
    System(
        name="morse",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 + 1.5*(1 - exp(-0.8*q))^2"
D = { p = 0.1 }
initial = { q = "1.2", p = "0" }""",
        rhs=canonical(lambda q: -2.4 * np.exp(-0.8 * q) * (1 - np.exp(-0.8 * q)), lambda t, p: 0.1 * p),
        z0=z(1.2, 0),
        end=8.0,
        steps=HALVES,
        gross=(0.5,),
        about="soft when stretched, stiff when compressed",
    ),
    System(
        name="double_well",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 - q^2/2 + q^4/4"
D = { p = 0.3 }
initial = { q = 0.3, p = 1.1 }""",
        rhs=canonical(lambda q: q - q**3, lambda t, p: 0.3 * p),
        z0=z(0.3, 1.1),
        end=6.0,
        steps=HALVES,
        gross=(0.5,),
        quick=True,
    ),
    System(
        name="quartic",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^4/4"
D = { p = 0.2 }
initial = { q = 1.5, p = 0 }""",
        rhs=canonical(lambda q: -(q**3), lambda t, p: 0.2 * p),
        z0=z(1.5, 0),
        end=6.0,
        steps=HALVES,
        gross=(0.5,),
        about="nothing of the force is linear",
    ),
    System(
        name="relativistic",
        problem="""name = "custom"
fields = ["q", "p"]
H = "sqrt(1 + p^2) + q^2/2"
D = { p = 0.1 }
initial = { q = 1.5, p = 0 }""",
        rhs=canonical(lambda q: -q, lambda t, p: 0.1 * p, lambda p: p / np.sqrt(1 + p * p)),
        z0=z(1.5, 0),
        end=8.0,
        steps=HALVES,
        gross=(0.5,),
        about="kinetic energy that is not quadratic: damping touches V",
    ),
    System(
        name="henon_heiles_cross",
        problem="""name = "custom"
fields = ["x1", "x2", "p1", "p2"]
H = "(p1^2 + p2^2)/2 + (x1^2 + x2^2)/2 + x1^2*x2 - x2^3/3"
D = [[0,0,0,0],[0,0,0,0],[0,0,0.1,0.05],[0,0,0.05,0.2]]
initial = { x1 = 0.3, x2 = -0.2, p1 = 0.2, p2 = 0.25 }""",
        rhs=henon_heiles,
        z0=z(0.3, -0.2, 0.2, 0.25),
        end=8.0,
        steps=(1 / 2, 1 / 4, 1 / 8, 1 / 16),
        gross=(1.0,),
        bounded=False,
        about="friction that couples the momenta",
    ),
    System(
        name="double_pendulum",
        problem="""name = "custom"
fields = ["a", "b", "p", "r"]
H = "p^2/2 + r^2/2 - p*r/2 + 2*(1 - cos(a)) + (1 - cos(b)) + 0.3*(1 - cos(a - b))"
D = { p = 0.05, r = 0.1 }
initial = { a = 1.2, b = -0.5, p = 0, r = 0.4 }""",
        rhs=double_pendulum,
        z0=z(1.2, -0.5, 0, 0.4),
        end=6.0,
        steps=HALVES,
        gross=(0.5,),
        about="a constant metric that is not diagonal",
    ),
    System(
        name="kepler_drag",
        problem="""name = "custom"
fields = ["x1", "x2", "p1", "p2"]
H = "(p1^2 + p2^2)/2 - 1/sqrt(x1^2 + x2^2)"
D = { p1 = 0.05, p2 = 0.05 }
initial = { x1 = 1, x2 = 0, p1 = 0, p2 = 1.1 }""",
        rhs=kepler,
        z0=z(1, 0, 0, 1.1),
        end=6.0,
        steps=(1 / 8, 1 / 16, 1 / 32, 1 / 64),
        bounded=False,
    ),
    System(
        name="toda_ring",
        problem="""name = "custom"
fields = ["a", "b", "c", "pa", "pb", "pc"]
H = "(pa^2 + pb^2 + pc^2)/2 + exp(a - b) + exp(b - c) + exp(c - a) - 3"
D = { pa = 0.1, pb = 0.1, pc = 0.1 }
initial = { a = 0.5, b = -0.2, c = 0, pa = 0.3, pb = 0.4, pc = -0.7 }""",
        rhs=toda_ring,
        z0=z(0.5, -0.2, 0, 0.3, 0.4, -0.7),
        end=6.0,
        steps=HALVES,
        gross=(0.5,),
    ),
    System(
        name="magnetic",
        problem="""name = "custom"
fields = ["x1", "x2", "p1", "p2"]
H = "(p1^2 + p2^2)/2 + (x1^2 + x2^2)^2/4"
S = [[0,0,1,0],[0,0,0,1],[-1,0,0,2],[0,-1,-2,0]]
D = { p1 = 0.1, p2 = 0.1 }
initial = { x1 = 1, x2 = 0.5, p1 = 0, p2 = 0.8 }""",
        rhs=magnetic,
        z0=z(1, 0.5, 0, 0.8),
        end=6.0,
        steps=HALVES,
        gross=(0.5, 1.0),
        about="a charge in a magnetic field: S is skew and not canonical",
    ),
    System(
        name="coupled",
        problem="""name = "custom"
fields = ["a", "b", "p", "r"]
H = "p^2/2 + r^2/2 + a^2 + a*b + b^2 + cos(a - b)"
D = { p = 0.1, r = 0.1 }
initial = { a = 1, b = 0.4, p = 0, r = 0.2 }""",
        rhs=coupled,
        z0=z(1, 0.4, 0, 0.2),
        end=6.0,
        steps=HALVES,
        gross=(0.5, 1.0),
    ),
    System(
        name="both_damped",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
D = { q = 0.1, p = 0.2 }
initial = { q = 1.4, p = 0 }""",
        rhs=lambda t, s: np.array([s[1] - 0.1 * s[0], -s[0] - s[0] ** 3 - 0.2 * s[1]]),
        z0=z(1.4, 0),
        end=6.0,
        steps=HALVES,
        gross=(0.5,),
        quick=True,
        about="damping moves what V depends on",
    ),
    System(
        name="odd_structure",
        problem="""name = "custom"
fields = ["a", "b", "c"]
H = "(a^2 + 2*b^2 + c^2)/2 + a^4/4 + b^4/8"
S = [[0,1,-0.5],[-1,0,0.7],[0.5,-0.7,0]]
D = { a = 0.1, b = 0.2, c = 0.05 }
initial = { a = 1.2, b = 0.5, c = -0.4 }""",
        rhs=odd_structure,
        z0=z(1.2, 0.5, -0.4),
        end=6.0,
        steps=HALVES,
        gross=(0.5,),
        about="three fields: S is skew and singular",
    ),
    System(
        name="dissipative_structure",
        problem="""name = "custom"
fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
S = [[-0.3,1],[-1,-0.1]]
initial = { q = 1.2, p = 0.5 }""",
        rhs=dissipative_structure,
        z0=z(1.2, 0.5),
        end=5.0,
        steps=HALVES,
        gross=(0.5,),
        about="sym(S) is negative",
    ),
    System(
        name="gradient_flow",
        problem="""name = "custom"
fields = ["a", "b"]
H = "(a^2 + b^2 - 1)^2/4 + (a - b)^2/2"
S = [[-1,0],[0,-1]]
initial = { a = 1.5, b = 0.2 }""",
        rhs=gradient_flow,
        z0=z(1.5, 0.2),
        end=3.0,
        steps=(1 / 8, 1 / 12, 1 / 16, 1 / 24),
        gross=(0.5,),
    ),
]
