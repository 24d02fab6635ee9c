"""Python values as case files write them, so that one parser checks both."""

from __future__ import annotations

import json
import math
import os
import re
from typing import Any, Mapping

import numpy as np


# SymPy's names of what formulas have.
_OF_SYMPY = {"Abs": "abs", "Max": "max", "Min": "min", "Heaviside": "step", "E": "exp(1)", "**": "^"}


def formula_of(expression: Any) -> str:
    """A SymPy expression as a formula of case files."""
    return re.sub(r"\b(?:Abs|Max|Min|Heaviside|E)\b|\*\*", lambda name: _OF_SYMPY[name[0]], str(expression))


def toml(value: Any) -> str:
    """The value as TOML: numbers, texts, paths, expressions of SymPy, lists and dictionaries of them."""
    if hasattr(value, "free_symbols"):
        return json.dumps(formula_of(value))
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        if math.isfinite(value):
            return repr(value)
        return "nan" if math.isnan(value) else "inf" if value > 0 else "-inf"
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False).replace("\x7f", "\\u007F")
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(str(k))} = {toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(v) for v in value) + "]"
    raise TypeError(f"a case cannot hold {value!r:.60}: write a number, a text, a list or a dictionary of them")


def section(name: str, values: Mapping[str, Any]) -> str:
    """[name] with one line for each value that is not None."""
    lines = [f"{json.dumps(key)} = {toml(value)}" for key, value in values.items() if value is not None]
    return "\n".join([f"[{name}]", *lines]) + "\n"
