"""Nonlinear waves on small grids: every boundary, damping in space, Kelvin–Voigt friction, two dimensions."""

import numpy as np

from ..system import System, canonical
from .matrices_of_grids import by_wave_number, laplacian, points

HALVES = (1 / 4, 1 / 8, 1 / 16, 1 / 32)
QUARTERS = (1 / 8, 1 / 16, 1 / 32, 1 / 64)
TWO_PI = 2 * np.pi


def sech(x):
    return 1 / np.cosh(x)


def start(u, v=0.0):
    return np.concatenate([u, v + np.zeros_like(u)])


X_PHI4 = points(16, 12.0, "neumann")
L_PHI4 = laplacian(16, 12.0, "neumann")
L_SINE = laplacian(16, 10.0, "dirichlet")
X_SINE = points(16, 10.0, "dirichlet")
X_RING = points(16, 6.0)
L_RING = laplacian(16, 6.0)
RATE = 0.5 * np.exp(-((X_RING - 3) ** 2))
L_VOIGT = laplacian(16, TWO_PI, "dirichlet")
X_VOIGT = points(16, TWO_PI, "dirichlet")
L_SPECTRAL = by_wave_number(16, TWO_PI, lambda k: -(k**2))
X_SPECTRAL = points(16, TWO_PI)
L_BEAM = by_wave_number(12, TWO_PI, lambda k: -(k**2))
X_BEAM = points(12, TWO_PI)
L_PLANE = np.kron(laplacian(6, 6.0), np.eye(5)) + np.kron(np.eye(6), laplacian(6, 6.0, "dirichlet"))
X_PLANE, Y_PLANE = np.repeat(points(6, 6.0), 5), np.tile(points(6, 6.0, "dirichlet"), 6)


def bonds(n: int) -> np.ndarray:
    """All n differences u_{j+1} − u_j of n − 1 masses between walls."""
    B = np.zeros((n, n - 1))
    for j in range(n - 1):
        B[j, j], B[j + 1, j] = 1, -1
    return B


BONDS = bonds(12)


def hardening(u):
    d = BONDS @ u
    return -BONDS.T @ (d + d**3)


def toda(u):
    return -BONDS.T @ (1 - np.exp(-(BONDS @ u)))


def kelvin_voigt(nu: float) -> System:
    return System(
        name=f"kelvin_voigt_{nu:g}",
        problem=f"""name = "custom"
fields = ["u", "v"]
length = {TWO_PI!r}
points = 16
boundary = "dirichlet"
H = "v^2/2 + u_x^2/2 + u^4/4"
D = {{ v = "-{nu}*laplacian" }}
initial = {{ u = "sin(x/2) + 0.3*sin(2*x)", v = "0.2*sin(x)" }}""",
        rhs=canonical(lambda u: L_VOIGT @ u - u**3, lambda t, v: -nu * (L_VOIGT @ v)),
        z0=start(np.sin(X_VOIGT / 2) + 0.3 * np.sin(2 * X_VOIGT), 0.2 * np.sin(X_VOIGT)),
        end=4.0,
        gross=(0.25, 0.125, 0.05),
        stiff=True,
        tolerances=(1e-4, 1e-6, 1e-8),
        quick=nu == 10,
        about="friction between neighbours, stiffer than the waves",
    )


SYSTEMS = [
    System(
        name="phi4_neumann",
        problem="""name = "custom"
fields = ["u", "v"]
length = 12.0
points = 16
boundary = "neumann"
H = "v^2/2 + u_x^2/2 + (u^2 - 1)^2/4"
D = { v = 0.1 }
initial = { u = "tanh((x - 5)/1.3)", v = "-0.4*sech((x - 5)/1.3)^2" }""",
        rhs=canonical(lambda u: L_PHI4 @ u - u**3 + u, lambda t, v: 0.1 * v),
        z0=start(np.tanh((X_PHI4 - 5) / 1.3), -0.4 * sech((X_PHI4 - 5) / 1.3) ** 2),
        end=5.0,
        steps=HALVES,
        gross=(0.5,),
    ),
    System(
        name="sine_gordon_dirichlet",
        problem="""name = "custom"
fields = ["u", "v"]
length = 10.0
points = 16
boundary = "dirichlet"
H = "v^2/2 + u_x^2/2 + 1 - cos(u)"
D = { v = 0.05 }
initial = { u = "2*exp(-(x - 4)^2)", v = "0.5*sin(pi*x/10)" }""",
        rhs=canonical(lambda u: L_SINE @ u - np.sin(u), lambda t, v: 0.05 * v),
        z0=start(2 * np.exp(-((X_SINE - 4) ** 2)), 0.5 * np.sin(np.pi * X_SINE / 10)),
        end=5.0,
        steps=HALVES,
        gross=(0.5,),
        quick=True,
    ),
    System(
        name="damped_in_places",
        problem="""name = "custom"
fields = ["u", "v"]
length = 6.0
points = 16
H = "v^2/2 + u_x^2/2 + u^2/2 + u^4/4"
D = { v = "0.5*exp(-(x - 3)^2)" }
initial = { u = "exp(sin(pi*x/3)) - 1", v = 0 }""",
        rhs=canonical(lambda u: L_RING @ u - u - u**3, lambda t, v: RATE * v),
        z0=start(np.exp(np.sin(np.pi * X_RING / 3)) - 1),
        end=4.0,
        steps=QUARTERS,
        gross=(0.5,),
    ),
    System(
        name="damped_in_places_and_times",
        problem="""name = "custom"
fields = ["u", "v"]
length = 6.0
points = 16
H = "v^2/2 + u_x^2/2 + u^2/2 + u^4/4"
D = { v = "0.5*exp(-(x - 3)^2)*(1 + 0.5*sin(2*t))" }
initial = { u = "exp(sin(pi*x/3)) - 1", v = 0 }""",
        rhs=canonical(lambda u: L_RING @ u - u - u**3, lambda t, v: RATE * (1 + 0.5 * np.sin(2 * t)) * v),
        z0=start(np.exp(np.sin(np.pi * X_RING / 3)) - 1),
        end=4.0,
        steps=QUARTERS,
        gross=(0.5,),
    ),
    kelvin_voigt(1),
    kelvin_voigt(10),
    System(
        name="klein_gordon_spectral",
        problem=f"""name = "custom"
fields = ["u", "v"]
length = {TWO_PI!r}
points = 16
discretisation = "spectral"
H = "v^2/2 + u_x^2/2 + u^2/2 + u^4/4"
D = {{ v = 0.1 }}
initial = {{ u = "cos(x) + 0.4*sin(2*x)", v = "0.5*cos(x)" }}""",
        rhs=canonical(lambda u: L_SPECTRAL @ u - u - u**3, lambda t, v: 0.1 * v),
        z0=start(np.cos(X_SPECTRAL) + 0.4 * np.sin(2 * X_SPECTRAL), 0.5 * np.cos(X_SPECTRAL)),
        end=4.0,
        steps=HALVES,
        gross=(0.5, 1.0),
    ),
    System(
        name="beam",
        problem=f"""name = "custom"
fields = ["u", "v"]
length = {TWO_PI!r}
points = 12
discretisation = "spectral"
H = "v^2/2 + u_xx^2/2 + u^4/4"
D = {{ v = "0.05 - 0.02*laplacian" }}
initial = {{ u = "cos(x) + 0.2*cos(2*x)", v = 0 }}""",
        rhs=canonical(lambda u: -L_BEAM @ (L_BEAM @ u) - u**3, lambda t, v: 0.05 * v - 0.02 * (L_BEAM @ v)),
        z0=start(np.cos(X_BEAM) + 0.2 * np.cos(2 * X_BEAM)),
        end=4.0,
        steps=(1 / 16, 1 / 32, 1 / 64, 1 / 128),
        gross=(0.25, 0.5),
        about="fourth derivatives: frequencies up to 36",
    ),
    System(
        name="phi4_plane",
        problem="""name = "custom"
fields = ["u", "v"]
length = [6.0, 6.0]
points = [6, 6]
boundary = ["periodic", "dirichlet"]
H = "v^2/2 + u_x^2/2 + u_y^2/2 + u^2/2 + u^4/4"
D = { v = 0.2 }
initial = { u = "(1 + 0.5*cos(pi*x/3))*sin(pi*y/6)", v = "0.3*sin(pi*x/3)*sin(pi*y/3)" }""",
        rhs=canonical(lambda u: L_PLANE @ u - u - u**3, lambda t, v: 0.2 * v),
        z0=start(
            (1 + 0.5 * np.cos(np.pi * X_PLANE / 3)) * np.sin(np.pi * Y_PLANE / 6),
            0.3 * np.sin(np.pi * X_PLANE / 3) * np.sin(np.pi * Y_PLANE / 3),
        ),
        end=4.0,
        steps=HALVES,
        gross=(0.5, 1.0),
        about="two dimensions, a ring in x and walls in y",
    ),
    System(
        name="hardening_springs",
        problem="""name = "custom"
fields = ["u", "v"]
length = 12.0
points = 12
boundary = "dirichlet"
H = "v^2/2 + du^2/2 + du^4/4"
D = { v = "0.02 - 0.1*laplacian" }
initial = { u = "exp(-(x - 4)^2/2)", v = 0 }""",
        rhs=canonical(hardening, lambda t, v: 0.02 * v + 0.1 * BONDS.T @ (BONDS @ v)),
        z0=start(np.exp(-((np.arange(1, 12) - 4) ** 2) / 2)),
        end=5.0,
        steps=HALVES,
        gross=(0.5,),
    ),
    System(
        name="toda_walls",
        problem="""name = "custom"
fields = ["u", "v"]
length = 12.0
points = 12
boundary = "dirichlet"
H = "v^2/2 + exp(-du) + du - 1"
D = { v = 0.05 }
initial = { u = 0, v = "1.5*exp(-(x - 4)^2)" }""",
        rhs=canonical(toda, lambda t, v: 0.05 * v),
        z0=start(np.zeros(11), 1.5 * np.exp(-((np.arange(1, 12) - 4.0) ** 2))),
        end=5.0,
        steps=HALVES,
        gross=(0.5,),
    ),
]
