"""Names, numbers and times as they are set in print."""

from __future__ import annotations

import math
import re

_GREEK = dict(
    zip(
        "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon phi chi psi omega".split(),
        "αβγδεζηθικλμνξπρστυφχψω",
    )
)
_INDICES = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_EXPONENTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def symbol(name: str) -> str:
    """In formulas: u in italics, l₁ with an index, Greek letters."""
    if name in _GREEK:
        return rf"$\{name}$"
    if name[1:].isdigit() or name[1:] in ("x", "y", "z"):
        return f"${name[0]}_{{{name[1:]}}}$"
    return f"${name}$" if len(name) == 1 else "$\\mathit{" + name.replace("_", r"\_") + "}$"


def in_text(name: str) -> str:
    """In sentences, without formulas."""
    if name in _GREEK:
        return _GREEK[name]
    return name[0] + name[1:].translate(_INDICES) if name[1:].isdigit() else name


def label(meaning: str, name: str) -> str:
    """Of an axis: "displacement u", or only u where the meaning says no more or is too long."""
    return (
        symbol(name)
        if not meaning or meaning.startswith("field ") or len(meaning) > 24
        else f"{meaning} {symbol(name)}"
    )


def place(name: str) -> str:
    """Of an axis along which there are places: x, y, z, or the numbers of points."""
    return name if name == "point" else symbol(name)


def number(x: float) -> str:
    """Four digits, and a power of ten where it is far from 1: 3·10⁻⁵."""
    digits, _, power = f"{x:.4g}".replace("-", "−").partition("e")
    factor = "" if digits == "1" else digits + "·"
    return f"{factor}10{str(int(power.replace('−', '-'))).translate(_EXPONENTS)}" if power else digits


def power(x: float) -> str:
    """Of a power of ten: 10⁻³."""
    return f"10{str(round(math.log10(x))).translate(_EXPONENTS)}" if x > 0 else ""


def offset(text: str) -> str:
    """Of an axis, as Matplotlib writes it: 1e−5 and +1e3, or both."""
    return re.sub(r"1e([-−]?\d+)", lambda found: "10" + found[1].replace("−", "-").translate(_EXPONENTS), text)


def step(h: float) -> str:
    """As a power of two where it is one."""
    mantissa, exponent = math.frexp(h)
    return "2" + str(exponent - 1).translate(_EXPONENTS) if mantissa == 0.5 else number(h)


def listed(names: list[str]) -> str:
    return names[0] if len(names) == 1 else ", ".join(names[:-1]) + " and " + names[-1]
