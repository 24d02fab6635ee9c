"""Where methods were found wrong, or may be: layers of friction, stiffness in V, strong damping, solutions that fade to
round-off, translations, jumps at the start, and gradient flows at steps too long."""

import numpy as np

from ..system import System, canonical

LOOSE = (1e-4, 1e-6, 1e-8)
WELLS = {
    "quartic": ("q^2/2 + q^4/8", lambda q: -q - q**3 / 2),
    "quadratic": ("q^2", lambda q: -2 * q),
    "pendulum": ("1 - cos(q)", lambda q: -np.sin(q)),
}


def one_mass(V, extra, q, p=0):
    return f'name = "custom"\nfields = ["q", "p"]\nH = "p^2/2 + {V}"\ninitial = {{ q = "{q}", p = "{p}" }}\n{extra}'


def layers():
    """Saturating friction with random coefficients and widths: tanh(v/w) turns within a small part of a step."""
    random = np.random.default_rng(33)
    systems = []
    for k in range(8):
        V, force = WELLS[random.choice(list(WELLS))]
        c, w, q = round(random.uniform(0.1, 0.8), 3), round(10 ** random.uniform(-2.2, -0.7), 4), round(random.uniform(0.8, 2.8), 2)
        systems.append(
            System(
                name=f"layer_{k + 1}",
                problem=one_mass(V, f'friction = {{ kind = "tanh", coefficient = {c}, width = {w} }}', q),
                rhs=canonical(force, lambda t, p, c=c, w=w: c * np.tanh(p / w)),
                z0=np.array([q, 0.0]),
                end=6.0,
                gross=(0.25,),
                stiff=True,
                tolerances=LOOSE,
                about=f"{c} tanh(v/{w})",
            )
        )
    return systems


def strong(name, V, force, D, q, p, end, about):
    return System(
        name=name,
        problem=one_mass(V, f"D = {{ p = {D} }}", q, p),
        rhs=canonical(force, lambda t, p: D * p),
        z0=np.array([q, p], float),
        end=end,
        gross=(1 / 10, 1 / 40, 1 / 160),
        stiff=True,
        tolerances=(1e-6,),
        about=about,
    )


def strong_pair(t, s):
    a, b, p, r = s
    pull = (a - b) ** 3
    return np.array([p, r, -pull - a - 500 * p, pull - b - 0.05 * r])


def two_masses(H, D, start, extra=""):
    initial = ", ".join(f'{name} = "{x}"' for name, x in zip(("a", "b", "p", "r"), start))
    return (
        f'name = "custom"\nfields = ["a", "b", "p", "r"]\nH = "(p^2 + r^2)/2 + {H}"\n'
        f"D = {{ p = {D[0]}, r = {D[1]} }}\ninitial = {{ {initial} }}\n{extra}"
    )


def stiff_in_V(name, H, forces, D, start, end, gross, about, slope=1.0):
    def rhs(t, s):
        a, b, p, r = s
        f, g = forces(a, b)
        return np.array([p, r, f - D[0] * p, g - D[1] * r])

    return System(
        name=name,
        problem=two_masses(H, D, start),
        rhs=rhs,
        z0=np.array(start, float),
        end=end,
        gross=gross,
        tolerances=(1e-6, 1e-8),
        slope=slope,
        about=about,
    )


def fading(name, V, force, q, D=0.8, end=30.0):
    return System(
        name=name,
        problem=one_mass(V, f"D = {{ p = {D} }}", q),
        rhs=canonical(force, lambda t, p: D * p),
        z0=np.array([q, 0.0]),
        end=end,
        tolerances=(1e-6,),
        about=f"to e^(-{D * end:g}) of its energy",
    )


def translated(name, V, force, shift, start, end, flow=False):
    """The whole problem moved by `shift`, which no force sees."""
    if flow:
        problem = f'name = "custom"\nfields = ["q"]\nH = "{V}"\nS = [["-1"]]\ninitial = {{ q = "{shift!r} + {start}" }}'
        rhs, z0 = (lambda t, s: force(s - shift)), np.array([shift + start])
    else:
        problem = one_mass(V, "D = { p = 0.3 }", f"{shift!r} + {start}")
        rhs, z0 = canonical(lambda q: force(q - shift), lambda t, p: 0.3 * p), np.array([shift + start, 0.0])
    return System(name=name, problem=problem, rhs=rhs, z0=z0, end=end, steps=(1 / 8, 1 / 16, 1 / 32, 1 / 64), gross=(1 / 4,), tolerances=(), about=f"about {shift:g}")


def jumping(name, V, force, push, text, breaks, D=0.2):
    return System(
        name=name,
        problem=one_mass(V, f'D = {{ p = {D} }}\nforce = {{ p = "{text}" }}', 0),
        rhs=canonical(force, lambda t, p: D * p - push(t)),
        z0=np.array([0.0, 0.0]),
        end=5.0,
        law="free",
        breaks=breaks,
        tolerances=(1e-4, 1e-6),
        about="a force that jumps at t = 0, from rest",
    )


def descending(name, V, force, start, end, gross):
    return System(
        name=name,
        problem=f'name = "custom"\nfields = ["q"]\nH = "{V}"\nS = [["-1"]]\ninitial = {{ q = "{start}" }}',
        rhs=lambda t, s: force(s),
        z0=np.array([float(start)]),
        end=end,
        gross=gross,
        stiff=True,
        tolerances=(1e-6,),
        about="a gradient flow at steps too long",
    )


PI = np.pi
SYSTEMS = [
    *layers(),
    strong("strong_pendulum", "1 - cos(q) + q^2/2", lambda q: -np.sin(q) - q, 400, 1.5, 2, 10.0, "D = 400"),
    strong("strong_quartic", "q^2/2 + q^4/4", lambda q: -q - q**3, 150, 1, -3, 4.0, "D = 150"),
    strong("strong_log", "2*log(1 + q^2)", lambda q: -4 * q / (1 + q * q), 60, 1.2, 4, 6.0, "D = 60"),
    strong("strong_morse", "(1 - exp(-q))^2", lambda q: -2 * (1 - np.exp(-q)) * np.exp(-q), 250, 0.8, 5, 6.0, "D = 250"),
    System(
        name="strong_pair",
        problem=two_masses("(a - b)^4/4 + a^2/2 + b^2/2", (500, 0.05), (1, -0.5, 1, 0.3)),
        rhs=strong_pair,
        z0=np.array([1, -0.5, 1, 0.3]),
        end=10.0,
        gross=(1 / 40, 1 / 160),
        stiff=True,
        tolerances=(1e-6,),
        about="one mass damped by 500 beside another by 0.05",
    ),
    stiff_in_V(
        "stiff_cosh", "b^2/2 + 1e4*(cosh(a) - 1) + a*b^2/2", lambda a, b: (-1e4 * np.sinh(a) - b * b / 2, -b - a * b), (20, 0.1),
        (0.05, 1, 0, 0), 6.0, (1 / 40, 1 / 80), "frequency 100 in V, damped",
    ),
    stiff_in_V(
        "stiff_cosh_weak", "b^2/2 + 1e4*(cosh(a) - 1) + a*b^2/2", lambda a, b: (-1e4 * np.sinh(a) - b * b / 2, -b - a * b), (5, 0.1),
        (0.05, 1, 0, 0), 6.0, (1 / 40,), "frequency 100 in V, damped less",
    ),
    stiff_in_V(
        "stiff_exponential", "b^2/2 + 4e3*(exp(a) - 1 - a) + a*b^2/2", lambda a, b: (-4e3 * (np.exp(a) - 1) - b * b / 2, -b - a * b), (12, 0.2),
        (0.03, 1, 0, 0.5), 5.0, (1 / 32, 1 / 64), "frequency 63 in V",
    ),
    stiff_in_V(
        "steep_pendulum", "b^2/2 + 900*(1 - cos(3*a)) + 0.3*a^2*b^2", lambda a, b: (-2700 * np.sin(3 * a) - 0.6 * a * b * b, -b - 0.6 * a * a * b),
        (15, 0.1), (0.1, 1, 0, 0), 4.0, (1 / 50, 1 / 100), "frequency 90 in V", 2700,
    ),
    fading("fading_log", "log(1 + q^2)", lambda q: -2 * q / (1 + q * q), 0.5),
    fading("fading_steep_log", "50*log(1 + 20*q^2)", lambda q: -2000 * q / (1 + 20 * q * q), 0.1),
    fading("fading_morse", "(1 - exp(-q))^2", lambda q: 2 * np.expm1(-q) * np.exp(-q), 0.5),
    fading("fading_lennard_jones", "(1 + q)^(-12) - 2*(1 + q)^(-6) + 1", lambda q: -12 * (1 + q) ** -13 * np.expm1(6 * np.log1p(q)), 0.1),
    fading("fading_exponential", "exp(q) - q - 1", lambda q: -np.expm1(q), 0.5),
    fading("fading_root", "sqrt(1 + 4*q^2) - 1", lambda q: -4 * q / np.sqrt(1 + 4 * q * q), 0.5),
    translated("far_flow", "12*(1 - cos(q))", lambda x: -12 * np.sin(x), 40 * PI, 2.5, 3.0, flow=True),
    translated("far_pendulum", "1 - cos(q)", lambda x: -np.sin(x), 400 * PI, 2.0, 8.0),
    translated("far_cosines", "3*(1 - cos(q)) + 0.5*(1 - cos(2*q))", lambda x: -3 * np.sin(x) - np.sin(2 * x), -60 * PI, 1.0, 6.0),
    translated("far_steep_flow", "2*sin(q)^2 + 1 - cos(q)", lambda x: -2 * np.sin(2 * x) - np.sin(x), 100 * PI, 1.2, 3.0, flow=True),
    jumping(
        "jump_pendulum", "1 - cos(q)", lambda q: -np.sin(q), lambda t: 0.5 * np.sign(np.sin(2 * t)), "0.5*sign(sin(2*t))", (PI / 2, PI, 3 * PI / 2)
    ),
    jumping("jump_quartic", "q^2/2 + q^4/4", lambda q: -q - q**3, lambda t: np.exp(-t), "exp(-t)*sign(t)", ()),
    jumping(
        "jump_fast", "2*q^2", lambda q: -4 * q, lambda t: 0.3 + 0.4 * np.sign(np.sin(3 * t)), "0.3 + 0.4*sign(sin(3*t))",
        (PI / 3, 2 * PI / 3, PI, 4 * PI / 3),
    ),
    descending("steep_descent", "20*(1 - cos(q)) + q^2/2", lambda q: -20 * np.sin(q) - q, 2.8, 2.0, (1 / 2, 1 / 4, 1 / 8)),
    descending("quartic_descent", "q^4", lambda q: -4 * q**3, 3, 2.0, (1 / 2, 1 / 8, 1 / 16)),
    descending("two_wells_descent", "(q^2 - 1)^2/4 + 0.3*sin(6*q)", lambda q: q - q**3 - 1.8 * np.cos(6 * q), 1.9, 2.0, (1 / 4, 1 / 8, 1 / 16)),
]
