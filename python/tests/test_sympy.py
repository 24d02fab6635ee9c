"""Expressions of SymPy stand where formulas do."""

import numpy as np
import pytest

import seiche

sympy = pytest.importorskip("sympy")


def test_an_expression_is_the_formula_that_it_prints():
    q, p, c = sympy.symbols("q p c")
    H = p**2 / 2 + sympy.Rational(1, 3) * sympy.Abs(q) ** 3 + sympy.exp(-(q**2)) + sympy.sqrt(1 + q**2) * c
    ours = seiche.Problem(fields=["q", "p"], H=H, parameters={"c": 2}, D={"p": sympy.Rational(1, 10)}, initial={"q": sympy.pi / 3, "p": 0})
    written = seiche.Problem(
        fields=["q", "p"], H="p^2/2 + abs(q)^3/3 + exp(-q^2) + c*sqrt(1 + q^2)", parameters={"c": 2}, D={"p": 0.1},
        initial={"q": "pi/3", "p": 0},
    )  # fmt: skip
    a, b = (seiche.solve(problem, 3.0, method="egc4", h=0.05) for problem in (ours, written))
    assert np.allclose(a.y, b.y, rtol=0, atol=1e-13)


@pytest.mark.parametrize(
    "make, value",
    [
        (lambda x: sympy.Max(x, 0) + sympy.Min(x, 1), lambda x: max(x, 0) + min(x, 1)),
        (lambda x: sympy.Heaviside(x - 1) * sympy.E, lambda x: np.heaviside(x - 1, 0.5) * np.e),
        (lambda x: sympy.sech(x) * sympy.log(2 + x**2) / sympy.cosh(x), lambda x: np.log(2 + x * x) / np.cosh(x) ** 2),
        (lambda x: sympy.atan(x) + sympy.sign(x + 2), lambda x: np.arctan(x) + 1),
    ],
)
def test_functions_have_the_names_of_formulas(make, value):
    wave = seiche.problem("klein_gordon", points=8, length=2.0, initial={"u": make(sympy.Symbol("x")), "v": "0"})
    places = wave.axes[0]
    assert wave.z0[:8] == pytest.approx([value(x) for x in places], abs=1e-14)
