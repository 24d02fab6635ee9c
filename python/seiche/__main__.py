"""``python -m seiche fit``: what the program asks Python for."""

from __future__ import annotations

import argparse
import errno
import importlib.util
import json
import math
import os
import pathlib
import re
import sys
import warnings
from typing import Any, Callable, NoReturn, Sequence

import numpy as np

from . import __version__, fit
from ._fit import FitResult
from ._problem import Case
from ._records import RunFailed
from ._types import Array

SUCCESS, FAILED, WRONG_USAGE, LAW_VIOLATED, INTERRUPTED = 0, 1, 2, 3, 130  # exit codes, those of the program


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise ValueError(message)


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="seiche fit",
        description="Find parameters of a case from measurements of its solution.",
        allow_abbrev=False,
    )
    parser.add_argument("case", metavar="CASE", help="case file in TOML")
    parser.add_argument(
        "data",
        metavar="DATA",
        help="measurements: columns of the time, the measurement and, if known, its standard deviation",
    )
    parser.add_argument(
        "--parameter", metavar="NAME[=GUESS[:LEAST:MOST]]", action="append", default=[],
        help="what is looked for, a key of [problem] such as gamma or initial.q; from the case's own value or a guess; "
        "once for each",
    )  # fmt: skip
    parser.add_argument(
        "--observe",
        metavar="FIELD",
        help="what was measured: a field, or one of its points from 0, as u[5] (the first field)",
    )
    parser.add_argument("--sigma", metavar="S", type=float, help="standard deviation of all measurements (estimated)")
    parser.add_argument(
        "--h", metavar="H", help="step size (one whose errors are below a tenth of the standard deviation)"
    )
    parser.add_argument("--method", metavar="NAME", help="method of the runs (that of the case, or egc4)")
    parser.add_argument(
        "--set", metavar="KEY=VALUE", action="append", default=[], help="override a key of the case: problem.points=64"
    )
    parser.add_argument("--plot", metavar="FILE", help="draw the measurements and the solution: PNG, PDF or SVG")
    parser.add_argument("--json", action="store_true", help="print one JSON document on stdout")
    parser.add_argument("--quiet", action="store_true", help="no progress, and a word only when something went wrong")
    return parser


def _number(text: str, otherwise: float) -> float:
    return float(text) if text.strip() else otherwise


def _parameter(text: str) -> tuple[str, Any]:
    name, equals, numbers = text.partition("=")
    parts = numbers.split(":")
    try:
        if not name.strip() or len(parts) not in (1, 3):
            raise ValueError
        if not equals:
            return name.strip(), None
        guess = float(parts[0])
        return name.strip(), guess if len(parts) == 1 else (
            guess,
            _number(parts[1], -math.inf),
            _number(parts[2], math.inf),
        )
    except ValueError:
        raise ValueError(f"--parameter {text} must be NAME, NAME=GUESS, or NAME=GUESS:LEAST:MOST") from None


def _parameters(texts: Sequence[str]) -> dict[str, Any]:
    if not texts:
        raise ValueError("--parameter is missing: say what is looked for, as in --parameter gamma=0.1:0:1")
    found: dict[str, Any] = {}
    for name, value in map(_parameter, texts):
        if name in found:
            raise ValueError(f"--parameter {name} is given twice")
        found[name] = value
    return found


def _measurements(file: str) -> tuple[Array, list[str]]:
    """One row for each time, and the names in the first line where it is a header. Lines that begin with # are comments."""
    try:
        text = pathlib.Path(file).read_text(encoding="utf-8-sig")
    except OSError as error:
        raise ValueError(f"{file} cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise ValueError(f"{file} is not a text with columns of numbers") from None
    rows: list[list[float]] = []
    header: list[str] = []
    may_be_header = True
    for place, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        cells = _cells(line, f"{file}:{place}")
        wrong = [cell for cell in cells if not _is_number(cell)]
        gaps = [] if wrong else [cell for cell in cells if not math.isfinite(float(cell))]
        if may_be_header and len(wrong) == len(cells):
            may_be_header, header = False, cells
            continue
        may_be_header = False
        if wrong:
            raise ValueError(f"{file}:{place}: '{wrong[0]:.40}' is not a number")
        if gaps:
            raise ValueError(f"{file}:{place}: {gaps[0]:.40} is not finite; leave out what was not measured")
        if len(cells) not in (2, 3) or (rows and len(cells) != len(rows[0])):
            columns = (
                f"{len(rows[0])}, as above"
                if rows
                else "2 or 3: the time, the measurement and, if known, its standard deviation"
            )
            raise ValueError(f"{file}:{place}: {len(cells)} column{'s' * (len(cells) != 1)}, which must be {columns}")
        if rows and float(cells[0]) <= rows[-1][0]:
            raise ValueError(f"{file}:{place}: times must ascend, and {cells[0]:.40} follows {rows[-1][0]:g}")
        rows.append([float(cell) for cell in cells])
    if not rows:
        raise ValueError(f"{file} holds no measurements")
    return np.array(rows), header


def _cells(line: str, place: str) -> list[str]:
    cells = line.split(";") if ";" in line else line.split()
    for cell in cells if len(cells) > 1 else ():
        if re.fullmatch(r"[+-]?\d+,\d+(?:[eE][+-]?\d+)?", cell.strip()):
            raise ValueError(f"{place}: '{cell.strip():.40}': decimals are written with a point")
    return [cell.strip() for cell in (line.split(",") if "," in line and ";" not in line else cells)]


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _observed(text: str | None, case: Case) -> str | Callable[[Any, Any], Any] | None:
    problem = case.problem
    fields, points = problem.fields, problem.size // len(problem.fields)
    found = re.fullmatch(r"(\w+)(?:\[(\d+)\])?", text or fields[0])
    if found is None or found[1] not in fields:
        raise ValueError(f"--observe {text} is not a field; {problem.name} has {', '.join(fields)}")
    name, point = found[1], found[2]
    if point is None and points == 1:
        return name
    if point is None:
        raise ValueError(f"{name} has {points} points: say which was measured, as in --observe {name}[0]")
    if int(point) >= points:
        raise ValueError(f"--observe {text}: there is no such point; they are 0 to {points - 1}")
    row = fields.index(name) * points + int(point)
    return lambda t, y: y[row]


def _document(found: FitResult) -> str:
    def plain(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: plain(entry) for key, entry in value.items()}
        if isinstance(value, (list, tuple, np.ndarray)):
            return [plain(entry) for entry in value]
        return None if isinstance(value, float) and not math.isfinite(value) else value

    keys = (
        "success",
        "message",
        "parameters",
        "std",
        "correlations",
        "chi2",
        "dof",
        "p_value",
        "h",
        "nfev",
        "sigma",
        "residuals",
    )
    return json.dumps({key: plain(found[key]) for key in keys}, indent=2, ensure_ascii=False)


def _fit(words: Sequence[str]) -> int:
    asked = _parser().parse_args(words)
    parameters, (measured, header) = _parameters(asked.parameter), _measurements(asked.data)
    sigma = asked.sigma
    if measured.shape[1] == 3:
        if sigma is not None:
            raise ValueError(f"--sigma: the third column of {asked.data} has standard deviations already")
        sigma = measured[:, 2]
    if asked.plot:
        _require_picture(asked.plot)
    case = Case(asked.case, asked.set)
    if asked.observe is None and len(header) > 1 and header[1] in case.problem.fields:
        asked.observe = header[1]
    if header and header[0] in case.problem.fields:
        raise ValueError(f"{asked.data}: the first column is that of the time, and the header calls it {header[0]}")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the message of the result says the same
        found = fit(
            case, measured[:, 0], measured[:, 1], parameters, _observed(asked.observe, case), sigma, h=asked.h,
            method=asked.method, progress=not asked.quiet and sys.stderr.isatty(),
        )  # fmt: skip
    print(_document(found) if asked.json else "\n".join(repr(found).splitlines()[:-1]))
    if not asked.quiet or found._remarks:
        print(found.message, file=sys.stderr)
    if asked.plot:
        _draw(found, asked.plot)
    if not found.success:
        return FAILED
    return LAW_VIOLATED if any(result.law == "violated" for result in found.results) else SUCCESS


def _require_picture(file: str) -> None:
    """Before the search, which may take long."""
    path = pathlib.Path(file)
    if path.suffix.lower() not in (".png", ".pdf", ".svg"):
        raise ValueError(f"--plot {file} must end in .png, .pdf or .svg")
    code = (
        errno.ENOENT if not path.parent.exists()
        else errno.ENOTDIR if not path.parent.is_dir()
        else errno.EISDIR if path.is_dir()
        else 0 if os.access(path if path.exists() else path.parent, os.W_OK)
        else errno.EACCES
    )  # fmt: skip
    if code:
        raise ValueError(f"--plot {file} cannot be written: {os.strerror(code)}")
    if importlib.util.find_spec("matplotlib") is None:
        raise ValueError("--plot needs Matplotlib (Debian package python3-matplotlib)")


def _draw(found: FitResult, file: str) -> None:
    import matplotlib

    matplotlib.use("Agg")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found.plot().figure.savefig(file)
    except OSError as error:
        raise ValueError(f"--plot {file} cannot be written: {error.strerror}") from None


def main(words: Sequence[str]) -> int:
    try:
        if words[:1] == ["--version"]:
            print(__version__)
            return SUCCESS
        if words[:1] != ["fit"]:
            raise ValueError("python -m seiche knows one command: fit; the others are those of the program seiche")
        return _fit(words[1:])
    except RunFailed as error:
        print(f"seiche: {error}", file=sys.stderr)
        return FAILED
    except (ValueError, TypeError) as error:
        print(f"seiche: {error}", file=sys.stderr)
        return WRONG_USAGE
    except ImportError as error:
        print(f"seiche: fit needs SciPy (Debian package python3-scipy): {error}", file=sys.stderr)
        return FAILED
    except KeyboardInterrupt:
        print("seiche: interrupted", file=sys.stderr)
        return INTERRUPTED


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
