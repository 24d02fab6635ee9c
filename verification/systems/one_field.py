"""Dispersive equations and gradient flows: the structure is a derivative, or symmetric; and two that change with the state."""

import numpy as np

from ..system import System
from .matrices_of_grids import by_wave_number, derivative, laplacian, points

TWO_PI = 2 * np.pi
D1, D3 = derivative(24, 16.0), derivative(24, 16.0, 3)
X_KDV = points(24, 16.0)
P_BBM = by_wave_number(24, 16.0, lambda k: -1j * k / (1 + k * k))
A_BO = by_wave_number(24, 16.0, lambda k: -1j * k * abs(k))
X_NLS = points(16, TWO_PI)
L_NLS = by_wave_number(16, TWO_PI, lambda k: -(k**2))
D_TWO, L_TWO = derivative(16, TWO_PI), L_NLS
X_CH = points(16, 1.0)
L_CH = laplacian(16, 1.0)
X_AC = points(16, 10.0, "neumann")
L_AC = laplacian(16, 10.0, "neumann")
X_SH = points(16, 4 * TWO_PI)
A_SH = by_wave_number(16, 4 * TWO_PI, lambda k: (1 - k * k) ** 2)
X_BURGERS = points(16, 1.0)


def sech(x):
    return 1 / np.cosh(x)


def nls(t, s):
    q, p = s[:16], s[16:]
    r = q * q + p * p
    return np.concatenate([-L_NLS @ p / 2 - r * p - 0.05 * q, L_NLS @ q / 2 + r * q - 0.05 * p])


def boussinesq(t, s):
    u, v = s[:16], s[16:]
    return np.concatenate([D_TWO @ v - 0.05 * u, D_TWO @ (u - 0.05 * (L_TWO @ u) + u**3) - 0.05 * v])


def central(n, length):
    D = (np.eye(n, k=1) - np.eye(n, k=-1)) * n / (2 * length)
    D[0, -1], D[-1, 0] = -n / (2 * length), n / (2 * length)
    return D


D_BURGERS, L_BURGERS = central(16, 1.0), laplacian(16, 1.0)


def burgers(t, u):
    return -2 / 3 * (u * (D_BURGERS @ u) + D_BURGERS @ (u * u)) + 0.02 * (L_BURGERS @ u) - 0.1 * u


def rigid_body(t, L):
    w = L / np.array([1.0, 3.0, 7.0])
    return np.array([L[1] * w[2] - L[2] * w[1], L[2] * w[0] - L[0] * w[2], L[0] * w[1] - L[1] * w[0]]) - (0.1 + 0.05 * np.sin(t)) * L


SYSTEMS = [
    System(
        name="kdv",
        problem="""name = "custom"
fields = ["u"]
length = 16.0
points = 24
discretisation = "spectral"
M = "-d_x^2"
V = "-u^3"
S = "d_x"
D = "0.05"
initial = { u = "0.5*sech((x - 6)/2)^2" }""",
        rhs=lambda t, u: -D3 @ u - 3 * (D1 @ (u * u)) - 0.05 * u,
        z0=0.5 * sech((X_KDV - 6) / 2) ** 2,
        end=3.0,
        steps=(1 / 8, 1 / 16, 1 / 32, 1 / 64),
        gross=(0.25, 0.5),
        law="free",
        bounded=False,
        stiff=True,
    ),
    System(
        name="bbm",
        problem="""name = "custom"
fields = ["u"]
length = 16.0
points = 24
discretisation = "spectral"
S = "-d_x/(1 + k_x^2)"
M = "1"
V = "u^3/6"
D = "0.02"
initial = { u = "0.8*sech((x - 6)/2)^2" }""",
        rhs=lambda t, u: P_BBM @ (u + u * u / 2) - 0.02 * u,
        z0=0.8 * sech((X_KDV - 6) / 2) ** 2,
        end=6.0,
        steps=(1, 1 / 2, 1 / 4, 1 / 8),
        gross=(2.0,),
        law="free",
        bounded=False,
        about="Benjamin, Bona and Mahony: S by a function of the wave number",
    ),
    System(
        name="benjamin_ono",
        problem="""name = "custom"
fields = ["u"]
length = 16.0
points = 24
discretisation = "spectral"
S = "-d_x"
M = "abs(k_x)"
V = "u^3/3"
D = "0.05"
initial = { u = "0.6*sech((x - 6)/2)^2" }""",
        rhs=lambda t, u: A_BO @ u - D1 @ (u * u) - 0.05 * u,
        z0=0.6 * sech((X_KDV - 6) / 2) ** 2,
        end=3.0,
        steps=(1 / 4, 1 / 8, 1 / 16, 1 / 32),
        gross=(0.5,),
        law="free",
        bounded=False,
        stiff=True,
    ),
    System(
        name="nls_focusing",
        problem=f"""name = "custom"
fields = ["q", "p"]
length = {TWO_PI!r}
points = 16
discretisation = "spectral"
H = "p_x^2/4 + q_x^2/4 - (p^2 + q^2)^2/4"
D = {{ q = 0.05, p = 0.05 }}
initial = {{ q = "0.6 + 0.2*cos(x)", p = "0.3*sin(x)" }}""",
        rhs=lambda t, s: nls(t, s),
        z0=np.concatenate([0.6 + 0.2 * np.cos(X_NLS), 0.3 * np.sin(X_NLS)]),
        end=3.0,
        steps=(1 / 8, 1 / 16, 1 / 32, 1 / 64),
        gross=(0.25, 0.5),
        law="free",
        bounded=False,
    ),
    System(
        name="boussinesq",
        problem=f"""name = "custom"
fields = ["u", "v"]
length = {TWO_PI!r}
points = 16
discretisation = "spectral"
H = "v^2/2 + u^2/2 + 0.05*u_x^2/2 + u^4/4"
S = [[0, "d_x"], ["d_x", 0]]
D = {{ u = 0.05, v = 0.05 }}
initial = {{ u = "0.5*cos(x)", v = "0.3*sin(x)" }}""",
        rhs=boussinesq,
        z0=np.concatenate([0.5 * np.cos(X_NLS), 0.3 * np.sin(X_NLS)]),
        end=3.0,
        steps=(1 / 8, 1 / 16, 1 / 32, 1 / 64),
        gross=(0.25, 0.5),
        about="two fields, S = ∂ₓ between them",
    ),
    System(
        name="cahn_hilliard",
        problem="""name = "custom"
fields = ["u"]
length = 1.0
points = 16
H = "0.004*u_x^2/2 + (u^2 - 1)^2/4"
S = "laplacian"
initial = { u = "0.6*cos(2*pi*x) + 0.2*sin(4*pi*x)" }""",
        rhs=lambda t, u: L_CH @ (-0.004 * (L_CH @ u) + u**3 - u),
        z0=0.6 * np.cos(TWO_PI * X_CH) + 0.2 * np.sin(2 * TWO_PI * X_CH),
        end=0.05,
        gross=(1 / 200, 1 / 400, 1 / 800),
        stiff=True,
        tolerances=(1e-4, 1e-6),
        about="S is the Laplacian: a stiff gradient flow",
    ),
    System(
        name="allen_cahn",
        problem="""name = "custom"
fields = ["u"]
length = 10.0
points = 16
boundary = "neumann"
H = "u_x^2/2 + (u^2 - 1)^2/4"
S = "-1"
initial = { u = "0.8*cos(pi*x/10) + 0.3*cos(3*pi*x/10)" }""",
        rhs=lambda t, u: L_AC @ u - u**3 + u,
        z0=0.8 * np.cos(np.pi * X_AC / 10) + 0.3 * np.cos(3 * np.pi * X_AC / 10),
        end=3.0,
        steps=(1 / 4, 1 / 8, 1 / 16, 1 / 32),
        gross=(0.5,),
        stiff=True,
    ),
    System(
        name="swift_hohenberg",
        problem=f"""name = "custom"
fields = ["u"]
length = {4 * TWO_PI!r}
points = 16
discretisation = "spectral"
H = "u^2/2 - u_x^2 + u_xx^2/2 - 0.15*u^2 + u^4/4"
S = "-1"
initial = {{ u = "0.4*cos(x) + 0.3*sin(x/2)" }}""",
        rhs=lambda t, u: -(A_SH @ u) + 0.3 * u - u**3,
        z0=0.4 * np.cos(X_SH) + 0.3 * np.sin(X_SH / 2),
        end=3.0,
        steps=(1 / 4, 1 / 8, 1 / 16, 1 / 32),
        gross=(0.5,),
        stiff=True,
    ),
    System(
        name="tumbling_body",
        problem="""name = "rigid_body"
inertia_1 = 1.0
inertia_2 = 3.0
inertia_3 = 7.0
gamma = "0.1 + 0.05*sin(t)"
initial = { l1 = 0.5, l2 = 2, l3 = -1 }""",
        rhs=rigid_body,
        z0=np.array([0.5, 2, -1]),
        end=6.0,
        steps=(1 / 4, 1 / 8, 1 / 16, 1 / 32),
        gross=(0.5, 1.0),
        quick=True,
        about="S changes with the state",
    ),
    System(
        name="burgers_ring",
        problem="""name = "burgers"
points = 16
alpha = 2.0
nu = 0.02
gamma = 0.1
initial = { u = "sin(2*pi*x) + 0.3*cos(4*pi*x)" }""",
        rhs=burgers,
        z0=np.sin(TWO_PI * X_BURGERS) + 0.3 * np.cos(2 * TWO_PI * X_BURGERS),
        end=0.5,
        steps=(1 / 32, 1 / 64, 1 / 128, 1 / 256),
        gross=(1 / 16,),
        stiff=True,
    ),
]
