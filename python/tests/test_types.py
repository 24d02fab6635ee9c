"""What type checkers are told of the arguments is what the program takes."""

import importlib.util
import subprocess
import sys
from pathlib import Path
from typing import get_args

import pytest
import seiche
from seiche import _core, _types

ROOT = Path(__file__).resolve().parents[2]


def allowed(key):
    """What the parser of case files allows."""
    with pytest.raises(ValueError) as refused:
        _core.parse_case('[problem]\nname = "klein_gordon"\n', "<keywords>", [f"{key}=nothing"], "")
    return refused.value.parts["allowed"]


@pytest.mark.parametrize(
    ("names", "key"),
    [
        (_types.Method, "method.name"),
        (_types.Backend, "backend.name"),
        (_types.ProblemName, "problem.name"),
        (_types.Boundary, "problem.boundary"),
        (_types.Discretisation, "problem.discretisation"),
    ],
)
def test_the_names_in_signatures_are_those_of_the_program(names, key):
    assert sorted(get_args(names)) == sorted(allowed(key))


def test_they_are_those_of_the_lists():
    assert set(get_args(_types.Method)) == {method["name"] for method in seiche.methods()}
    assert set(get_args(_types.ProblemName)) == {problem["name"] for problem in seiche.problems()}
    assert set(get_args(_types.Backend)) == {"auto"} | {backend["name"] for backend in seiche.backends()}


def test_words_of_a_grid_are_arguments_of_a_problem():
    grid = {"points": 8, "length": 1.0, "initial": {"u": "x*(1 - x)", "v": 0}}
    by_name = seiche.Problem(fields=["u", "v"], H="v^2/2 + u_x^2/2", boundary="dirichlet", discretisation="fd2", **grid)
    assert by_name.size == 2 * 7
    with pytest.raises(ValueError, match="unknown problem.boundary 'open'|unknown boundary 'open'"):
        seiche.Problem(fields=["u", "v"], H="v^2/2 + u_x^2/2", boundary="open", **grid)
    with pytest.raises(ValueError, match="boundary: only for a problem by formulas"):
        seiche.Problem(M=[[1, 0], [0, 1]], boundary="periodic")


MISTAKES = """
import seiche
seiche.solve("oscillator", 1.0, method="seisaw")
seiche.solve("oscilator", 1.0)
seiche.solve("oscillator", 1.0, backend="gpu")
seiche.Problem(fields=["u", "v"], H="v^2/2", boundary="open")
seiche.fit("oscillator", [1.0], [1.0], {"gamma": 0.1}, method="egc5")
"""


@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not installed")
def test_a_type_checker_complains_of_misspelt_names_alone(tmp_path):
    (tmp_path / "mistakes.py").write_text(MISTAKES)
    files = ["python/seiche", str(tmp_path / "mistakes.py")]
    words = [sys.executable, "-m", "mypy", "--no-error-summary", "--cache-dir", str(tmp_path / "cache"), *files]
    found = subprocess.run(words, cwd=ROOT, capture_output=True, text=True).stdout
    places = {line.split(": error:")[0].rpartition("/")[2] for line in found.splitlines() if ": error:" in line}
    assert places == {f"mistakes.py:{line}" for line in range(3, 8)}, found
