"""The compiled part of the package; its functions are called by the Python files beside it."""

from typing import Any, Callable, Sequence

from ._types import Array

__version__: str
__citation__: str

class Problem:
    @property
    def name(self) -> str: ...
    @property
    def fields(self) -> list[str]: ...
    @property
    def size(self) -> int: ...
    @property
    def axes(self) -> list[Array]: ...
    @property
    def layout(self) -> dict[str, list[tuple[str, str]]]:
        """The fields, and the axes of one instant: their names and meanings in solution.h5."""
    def part(self, rank: int, count: int) -> Problem: ...  # which one of several processes holds
    @property
    def z0(self) -> Array: ...
    @property
    def notes(self) -> list[str]: ...

class Case:
    problem: str
    method: str
    h: float
    h_is_default: bool
    tolerance: float | None
    h_max: float
    backend: str
    t_start: float
    t_end: float
    ledger: bool
    output_directory: str
    notes: list[str]
    def gives(self, key: str) -> bool: ...  # a key such as "method.name", be it by an override
    @property
    def parameters(self) -> dict[str, str]: ...  # keys of [problem] with one value, as a case file writes them
    @property
    def is_ensemble(self) -> bool: ...
    def text(self) -> str: ...

class Solution:
    size: int
    t: Array
    y: Array
    H: Array
    modified: Array | None
    t_events: list[Array]
    y_events: list[Array]
    ledger: dict[str, Array]
    status: str
    message: str
    remarks: list[str]
    """Warnings: steps that were replaced, an energy that no solution has."""
    ended_by_event: bool
    nfev: int
    steps: int
    law: str
    law_reason: str
    method: str
    method_reason: str
    notes: list[str]
    backend: str
    has_sol: bool
    sol_span: tuple[float, float]
    def at(self, times: Array) -> Array: ...
    def report_json(self) -> str: ...
    def certificate_json(self) -> str: ...

class Simulation:
    t: float
    steps: int
    y: Array
    H: float
    modified: float
    method: str
    backend: str
    replaced: int
    def __init__(self, problem: Problem, case: Case, z0: Array | None, t: float, threads: int) -> None: ...
    def step(self, h: float, count: int) -> str: ...
    def set_state(self, y: Array, t: float) -> None: ...

class Ensemble:
    t: Array
    running: Array
    H: dict[str, Array]
    modified: dict[str, Array]
    y: Array
    status: list[str]
    message: list[str]
    remarks: list[list[str]]
    law: list[str]
    energy: list[float]
    parameters: dict[str, Array]
    side_by_side: bool
    wall_seconds: float

def case_text(file: str) -> bytes: ...
def parse_case(text: str | bytes, name: str, overrides: Sequence[str], folder: str) -> Case: ...
def make_problem(case: Case, rank: int = 0, count: int = 1) -> Problem: ...
def problem_by_parts(
    fields: int,
    M: tuple[Any, ...] | None,
    S: tuple[Any, ...] | None,
    D: tuple[Any, ...] | None,
    gamma: float | str | None,
    V: Callable[[Array], float] | str | None,
    gradient: Callable[[Array], Any] | None,
    grows_outward: bool,
    z0: Array | None,
) -> Problem: ...
def solve(
    problem: Problem,
    case: Case,
    t_start: float,
    t_end: float,
    z0: Array | None,
    t_eval: Array | None,
    events: list[tuple[Any, ...]],
    dense_output: bool,
    observer: Callable[[float, Array, float], Any] | None,
    record_every: int,
    ledger: bool,
    threads: int,
    checkpoint: str | None,
    progress: Callable[[float, float, int], Any] | None,
    communicator: int | None,
) -> Solution: ...
def ensemble_of_case(
    case: Case, threads: int, progress: Callable[[float, float, int], Any] | None
) -> Ensemble: ...
def ensemble_of_problems(
    problems: list[Problem],
    initial: list[Array],
    case: Case,
    threads: int,
    progress: Callable[[float, float, int], Any] | None,
) -> Ensemble: ...
class CaseRun:
    summary: str
    notes: list[str]
    remarks: list[str]

class Look:
    solution: str
    how_far: str
    def release(self) -> None: ...

def look(folder: str) -> Look:
    """The solution of a run, which is there until it is released; how far a run had come that has not ended."""

def run(
    case: Case,
    folder: str,
    threads: int,
    restart: bool,
    max_hours: float,
    progress: Callable[[float, float, int], Any] | None,
) -> CaseRun: ...
def resume(
    folder: str,
    t_end: float | None,
    threads: int,
    max_hours: float,
    progress: Callable[[float, float, int], Any] | None,
) -> CaseRun: ...
def report(
    folder: str, formats: Sequence[str], film: bool, programs: str, interpreter: str
) -> None: ...
def check(problem: Problem, case: Case) -> str: ...
def spectrum(problem: Problem, case: Case) -> str: ...
def converge(problem: Problem, methods: list[str], step_sizes: list[float], case: Case, timed: bool) -> str: ...
def methods() -> list[dict[str, Any]]:
    """Every method: name, closure, propagator, composition, order, the energy that never grows, projection, reference."""

def problems() -> list[dict[str, Any]]:
    """Every problem: name, equation, reference, fields, initial data and parameters with their defaults."""

def backends() -> list[dict[str, Any]]:
    """Every backend: name and summary."""

def method_styles() -> dict[str, tuple[str, str, bool, str]]:
    """Of each method its colour, marker, whether that is filled, and dash."""
