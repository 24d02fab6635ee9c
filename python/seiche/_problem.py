"""Equations: by name, from a case file, or by parts."""

from __future__ import annotations

import difflib
import numbers
import operator
import os
from typing import Any, Callable, Mapping, Sequence, cast

import numpy as np

from . import _core
from ._core import Case as CoreCase
from ._toml import section, toml
from ._types import Array, ArrayLike, Boundary, Discretisation, File, Matrix, ProblemName

_KEYWORDS = "<keywords>"

# Keys of case files whose argument has another name than they.
_KEY_ARGUMENTS = {
    "method.name": "method",
    "backend.name": "backend",
    "backend.plan": "plan",
    "backend.exponential": "exponential",
    "backend.pade_degree": "pade_degree",
    "backend.lanczos_dimension": "lanczos_dimension",
    "backend.solver": "solver",
    "noise.temperature": "temperature",
    "noise.seed": "seed",
    "time.start": "t_start",
    "time.end": "t_end",
    "output.energy_every": "energy_every",
}


def _argument(key: str) -> str:
    """What `solve` and the others call a key of a case file."""
    return _KEY_ARGUMENTS.get(key, key.removeprefix("method.").removeprefix("problem."))


def _refused(error: ValueError, by_arguments: bool = True) -> ValueError:
    """The same without places that a Python user never wrote, about arguments if those were written."""
    parts = error.parts  # type: ignore[attr-defined]  # of the module's own
    if not parts["place"].startswith((_KEYWORDS, "--set ")):
        return ValueError(str(error))
    if not by_arguments:
        return ValueError(parts["sentence"])
    if parts["kind"].startswith("key in ["):
        return ValueError(_unknown_argument(**parts))
    return ValueError(_argument(parts["key"]) + parts["sentence"].removeprefix(parts["key"]))


def _unknown_argument(kind: str, name: str, nearest: str, allowed: Sequence[str], **_: str) -> str:
    is_of_method = kind == "key in [method]"
    if is_of_method:
        allowed = [_argument(f"method.{key}") for key in allowed]
    else:  # a problem's name is no keyword of it
        allowed = [key for key in allowed if key != "name"]
    near = _argument(nearest)
    hint = f"; did you mean '{near}'?" if near not in ("", name) else "."  # the same in another section is no help
    names = f" Allowed: {', '.join(allowed)}" if allowed else ""
    return f"unknown {'argument' if is_of_method else kind} '{name}'{hint}{names}"


def parse_keywords(text: str, overrides: Sequence[str] = (), folder: str = "") -> CoreCase:
    try:
        return _core.parse_case(text, _KEYWORDS, list(overrides), folder)
    except ValueError as error:
        raise _refused(error) from None


def make_problem(case: CoreCase) -> _core.Problem:
    try:
        return _core.make_problem(case)
    except ValueError as error:
        raise _refused(error) from None


def real_array(name: str, values: Any) -> Array:
    """The values as an array of floats. Complex numbers are refused, instead of losing a part."""
    if np.iscomplexobj(values):
        raise ValueError(f"{name} is complex; it must be real")
    try:
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{name} = {values!r} must be an array of numbers") from None


def whole_number(name: str, value: Any, most: int = 2**62) -> int:
    try:
        count = operator.index(value)
    except TypeError:
        raise ValueError(f"{name} = {value!r} must be a whole number") from None
    if not 1 <= count <= most:
        raise ValueError(f"{name} = {count} must be " + (f"≤ {most}" if count > most else "≥ 1"))
    return count


def thread_count(threads: Any) -> int:
    return 1 if threads is None else whole_number("threads", threads, 1024)


def truth(name: str, value: Any) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise ValueError(f"{name} = {value!r} must be True or False")
    return bool(value)


def override(key: str, value: Any) -> str:
    return f"{key}={toml(value)}"


def _columns(name: str, matrix: Any) -> tuple[Any, ...] | None:
    """A matrix, full or of scipy.sparse, in compressed columns."""
    if matrix is None:
        return None
    if np.iscomplexobj(matrix):
        raise ValueError(f"{name} is complex; it must be real")
    if hasattr(matrix, "tocsc"):
        m = matrix.tocsc(copy=True)
        m.sum_duplicates()
        return (*m.shape, m.data, m.indices, m.indptr)
    full = real_array(name, matrix)
    if full.ndim != 2:
        raise ValueError(f"{name} has the shape {full.shape}; it must be a matrix")
    column, row = np.nonzero(full.T)
    starts = np.searchsorted(column, np.arange(full.shape[1] + 1))
    return (*full.shape, full.T[column, row], row.astype(np.intc), starts.astype(np.intc))


def _no_right_hand_side(given: Any) -> TypeError:
    if not callable(given):
        shown = repr(given)
        is_long = "\n" in shown or len(shown) > 60
        a_result = "; of a result it is result.problem" if hasattr(given, "problem") else ""
        return TypeError(
            f"a problem is a seiche.Problem, a seiche.Case or a name, not {f'a {type(given).__name__}' if is_long else shown}{a_result}"
        )
    return TypeError(
        "a problem is not a right-hand side f(t, z): the energy law needs the parts of ż = S∇H(z) − Dz. Write H by a formula, "
        'seiche.Problem(fields=["q", "p"], H="p^2/2 + q^4/4", D={"p": 0.1}, initial={"q": 1, "p": 0}), or give matrices, '
        "seiche.Problem(M=…, S=…, D=…, V=…, gradient=…, z0=…)"
    )


_NO_FUNCTIONS = {
    "H": 'is a formula in quotes, as in H="p^2/2 + q^4/4"; for Python functions give M, V and gradient',
    "V": "as a Python function goes with matrices, M=…, V=…, gradient=…; with fields by their names it is a formula in quotes",
    "M": "is a matrix, or by formulas a table; what is not quadratic belongs to V and gradient, or to H",
    "S": "is a matrix, or by formulas a table",
    "D": 'is a constant matrix, or by formulas a table, as in D={"p": "0.1*(1 + sin(t)^2)"}',
    "gamma": 'is a number, or a formula of the time in quotes, as in gamma="0.1 + 0.05*sin(t)"',
}


def _refuse_functions(values: Mapping[str, Any]) -> None:
    """Only V and gradient may be functions of Python. What is written for the others is said for each."""
    for name, value in values.items():
        inside = value.values() if isinstance(value, Mapping) else value if isinstance(value, (list, tuple)) else [value]
        if any(callable(entry) and not hasattr(entry, "free_symbols") for entry in inside):  # of SymPy
            instead = _NO_FUNCTIONS.get(name, "takes numbers and formulas in quotes, and no Python function")
            raise TypeError(f"{name} {instead}")


class Problem:
    """ż = S∇H(z) − Dz − γ(t)v with H(z) = ½zᵀMz + V(u), by its parts; or written down by formulas.

    By formulas, ``seiche.Problem(fields=["q", "p"], H="p^2/2 + q^4/4", D={"p": 0.1}, initial={"q": 1, "p": 0})``, the
    arguments are the keys of a case file whose problem is named "custom" (`seiche new custom` prints one): fields, H or M and V, S, D,
    parameters, initial, and for a grid points, length, boundary, discretisation. They are checked by the same parser.

    By parts,

    Parameters
    ----------
    M : (n, n) array or scipy.sparse matrix
        Symmetric and positive semidefinite.
    S : (n, n) array or scipy.sparse matrix, optional
        The structure; by default [[0, I], [−I, 0]]. Where S + Sᵀ ⪯ 0 fails, no energy law is promised.
    D : (n, n) array or scipy.sparse matrix, optional
        Constant damping, 1/time.
    V : callable or str, optional
        ``V(u) -> float``: u, of shape (n // fields,), is the first field of z. Or a formula W(u), such as "1 - cos(u)": V is
        then its sum over the points, and no Python function is called.
    gradient : callable
        ``gradient(u) -> array`` of the shape of u: ∇V at all points at once. It is compared
        with V at z0 and at a few random states of its size. Not for a formula.
    z0 : (n,) array, optional
        The state at the start; `solve` may give another one.
    fields : {2, 1}
        z = (u, v) by default; or u alone, so that V is a function of all of z.
    gamma : float or str, optional
        Further damping of the last field, 1/time: a number or a formula in t.
    grows_outward : bool
        Is u·∇V(u) ≥ 0 for every u? Asked for where damping moves u, before an energy law is promised.

    Raises
    ------
    ValueError
        Where sizes do not fit or a hypothesis fails, with the entries or the direction that show it.
    """

    _core: _core.Problem
    _text: str | None = None  # the [problem] section it came from
    _overrides: Sequence[str] = ()  # of its keys
    _has_initial: bool = True
    _file: str | None = None  # the case file it came from
    _remake: tuple[Any, ...] = ()  # without a text: a function of this module and its arguments, for pickle

    def __init__(
        self,
        *right_hand_side: Any,
        M: Matrix = None,
        S: Matrix = None,
        D: Matrix = None,
        H: str | None = None,
        V: Callable[[Array], float] | str | None = None,
        gradient: Callable[[Array], Any] | None = None,
        z0: ArrayLike | None = None,
        fields: int | Sequence[str] = 2,
        gamma: float | str | None = None,
        grows_outward: bool = False,
        boundary: Boundary | None = None,
        discretisation: Discretisation | None = None,
        **written: Any,
    ):
        if right_hand_side and isinstance(right_hand_side[0], str):
            raise TypeError(f"a problem by its name is seiche.problem({right_hand_side[0]!r})")
        if right_hand_side:
            raise _no_right_hand_side(right_hand_side[0])
        words = {"boundary": boundary, "discretisation": discretisation}
        written |= {name: value for name, value in words.items() if value is not None}
        _refuse_functions({"H": H, "M": M, "S": S, "D": D, "gamma": gamma})
        if isinstance(fields, numbers.Number) and not isinstance(fields, numbers.Integral):
            raise ValueError(f"fields = {fields!r} must be 1 or 2, or by formulas a list of names")
        if H is not None or not isinstance(fields, numbers.Integral):
            for name, value in {"gradient": gradient, "z0": z0, "gamma": gamma}.items():
                if value is not None:
                    instead = {
                        "gradient": "that of a formula is found by itself",
                        "z0": "write initial by formulas, or give numbers to solve(problem, t_span, z0)",
                        "gamma": "write D",
                    }[name]
                    raise ValueError(f"{name} belongs to a problem by parts; with H by a formula {instead}")
            if grows_outward:
                raise ValueError("grows_outward belongs to a problem by parts; of formulas it is found out")
            named = None if isinstance(fields, numbers.Integral) else list(cast(Sequence[str], fields))
            stated = problem("custom", fields=named, H=H, M=M, V=V, S=S, D=D, **({"initial": "zero"} | written))
            self._core, self._text = stated._core, stated._text
            self._has_initial = "initial" in written
            return
        if written:
            raise ValueError(f"{', '.join(written)}: only for a problem by formulas, with H or the names of its fields")
        if M is None:
            raise ValueError("a problem needs M, or H by a formula")
        start = None if z0 is None else real_array("z0", z0).copy()
        matrices = (_columns("M", M), _columns("S", S), _columns("D", D))
        self._take_parts(fields, *matrices, gamma, V, gradient, grows_outward, start)

    def _take_parts(self, *parts: Any) -> None:
        """Those of `_core.problem_by_parts`, of which the last is z0."""
        self._core = _core.problem_by_parts(*parts)
        self._has_initial = parts[-1] is not None
        self._remake = (_of_parts, parts)

    def __reduce__(self) -> tuple[Any, ...]:
        return self._remake if self._text is None else (of_text, (self._text, self._has_initial, self._overrides))

    @classmethod
    def _of_case(cls, case: CoreCase, text: str | None) -> "Problem":
        made = cls.__new__(cls)
        made._core = make_problem(case)
        made._text = text
        return made

    @property
    def name(self) -> str:
        return self._core.name

    @property
    def fields(self) -> list[str]:
        """Names of the fields, in the order of z."""
        return self._core.fields

    @property
    def size(self) -> int:
        """Numbers in a state: fields × points."""
        return self._core.size

    @property
    def axes(self) -> list[Array]:
        """Coordinates of the points along each axis of the grid."""
        return self._core.axes

    @property
    def shape(self) -> tuple[int, ...]:
        """Points along each axis of the grid; a field reshapes to it."""
        return tuple(len(axis) for axis in self.axes)

    @property
    def z0(self) -> Array:
        """(size,) the state at the start."""
        return self._core.z0

    @property
    def notes(self) -> list[str]:
        """What was done on the way that one should know."""
        return self._core.notes

    def __repr__(self) -> str:
        points = "" if self.shape == (1,) else f" at {' × '.join(map(str, self.shape))} points"
        return f"<seiche.Problem {self.name}: {', '.join(self.fields)}{points}>"


def of_text(text: str, has_initial: bool, overrides: Sequence[str] = ()) -> Problem:
    made = Problem._of_case(parse_keywords(text, overrides), text)
    made._has_initial, made._overrides = has_initial, overrides
    return made


def _of_parts(*parts: Any) -> Problem:
    made = Problem.__new__(Problem)
    made._take_parts(*parts)
    return made


def _of_case_file(*case: Any) -> Problem:
    return Case(*case).problem


class Case:
    """A case file as it was when it was read: a problem, and how to run it. Give it to `solve`, `solve_ensemble` or `check`."""

    def __init__(self, file: File, overrides: Sequence[str], written: str | bytes | None = None):
        self._file = os.fspath(file)
        self._overrides = list(overrides)
        # once: what is edited later belongs to another case
        self._written: str | bytes = _core.case_text(self._file) if written is None else written
        self._core = self._read([])
        self.problem = Problem._of_case(self._core, None)
        self.problem._file = self._file
        self.problem._remake = (_of_case_file, self.__reduce__()[1])

    def __reduce__(self) -> tuple[Any, ...]:
        return Case, (self._file, self._overrides, self._written)

    def _read(self, overrides: Sequence[str]) -> CoreCase:
        try:
            return _core.parse_case(
                self._written, self._file, [*self._overrides, *overrides], os.path.dirname(self._file)
            )
        except ValueError as error:
            raise _refused(error, by_arguments=len(overrides) > 0) from None

    @property
    def text(self) -> str:
        """The case as it runs, every default filled in."""
        return self._core.text()

    @property
    def t_start(self) -> float:
        return self._core.t_start

    @property
    def t_end(self) -> float:
        return self._core.t_end

    @property
    def _given_method(self) -> str | None:
        """The method that the case file, or a key that was replaced, asks for by its name; None for "auto", or none."""
        is_given = self._core.gives("method.name") and self._core.method != "auto"
        return self._core.method if is_given else None

    def __repr__(self) -> str:
        return f"<seiche.Case {self._file}: {self.problem.name} by {self._core.method}>"


def problem(name: ProblemName, **parameters: Any) -> Problem:
    """A problem of the library by its name, with the parameters of its case files.

    `seiche.problems()` lists both. Numbers may be texts ("1/3"), a damping a formula ("0.1 + 0.05*sin(t)"), and
    ``initial`` a preset, ``{"file": "z0.txt"}`` or formulas ``{"u": "sin(pi*x)", "v": "0"}``.
    """
    _refuse_functions(parameters)
    for key, value in parameters.items():
        if name != "custom" and (hasattr(value, "tocsc") or np.ndim(value) == 2):
            raise ValueError(f"{key} is a matrix: problems by name read matrices from files; seiche.Problem takes {key}")
    text = section("problem", {"name": name, **parameters})
    return Problem._of_case(parse_keywords(text), text)


def load(file: File, **overrides: Any) -> Case:
    """A case file, with keys replaced: ``seiche.load("case.toml", **{"method.h": "1/64"})``."""
    return Case(file, [override(key, value) for key, value in overrides.items()])


def as_problem(given: "Problem | Case | ProblemName") -> "Problem":
    if isinstance(given, str):
        return problem(given)
    if isinstance(given, Case):
        return given.problem
    if isinstance(given, Problem):
        return given
    raise _no_right_hand_side(given)


def require_start(given: Problem, *callers: str) -> None:
    """Refuses a problem without a given initial state: its zeros would look like an answer."""
    if given._has_initial:
        return
    if given._text is None:
        raise ValueError(f"z0 is missing: give it to {' or to '.join(('seiche.Problem', *callers))}")
    also = f", or z0 to {' or to '.join(callers)}" if callers else ""
    raise ValueError(f"the initial state is missing: give initial to seiche.Problem{also}")


_SECTIONS = {argument: key for key, argument in _KEY_ARGUMENTS.items()}


_OTHER_NAMES = dict.fromkeys(("t_end", "tend", "tmax", "t_max", "T", "tspan"), "t_span") | dict.fromkeys(("y0", "u0", "x0"), "z0")


_ARGUMENTS = (
    "t_span", "z0", "t_eval", "events", "dense_output", "observer", "record_every", "ledger", "backend", "threads",
)  # beside the keys of [method], which the parser of cases knows


def refuse_other_names(options: Mapping[str, Any]) -> None:
    """What other programs call an argument that is no key of a case, and arguments that are misspelt."""
    for name in options:
        nearest = _OTHER_NAMES.get(name)
        if nearest is None and name not in _SECTIONS:
            nearest = next(iter(difflib.get_close_matches(name, _ARGUMENTS, 1, 0.75)), None)
        if nearest not in (None, name):  # an ensemble takes no events
            raise ValueError(f"unknown argument '{name}'; did you mean '{nearest}'?")


def run_case(given: "Problem | Case", options: Mapping[str, Any]) -> CoreCase:
    """The case of one run: what is given, over what the case file says, over the defaults."""
    for name, value in options.items():
        if callable(value):  # an observer or events, which a case does not take
            raise ValueError(f"unknown argument '{name}'")
    keys = {name: name if "." in name else _SECTIONS.get(name, f"method.{name}") for name in options}
    overrides = [override(keys[name], value) for name, value in options.items() if value is not None]
    if isinstance(given, Case):
        return given._read(overrides)
    if given._text is not None:
        return parse_keywords(given._text, [*given._overrides, *overrides])
    # The parser wants the name of a problem; of what it knows about it, nothing is used.
    case = parse_keywords('[problem]\nname = "oscillator"\n', overrides)
    if options.get("h") is None and options.get("tolerance") is None:
        raise ValueError("give a step size h, or a tolerance")
    return case
