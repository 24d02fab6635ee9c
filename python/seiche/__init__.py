"""Energy-stable integrators for damped Hamiltonian systems.

Seiche integrates ż = S∇H(z) − D(t)z with H(z) = ½zᵀMz + V(z) so that the damping is exact and the
energy law of the equation holds at every step, for any step size::

    import seiche
    wave = seiche.problem("klein_gordon", points=64, alpha=1.0, gamma=0.1)
    result = seiche.solve(wave, 50.0, method="seisav", h="1/64")
    result.y.shape, result.energy[-1], result.law

`problem`, `load` and `Problem` state equations, `solve` and `solve_ensemble` integrate them, `Simulation` steps, `run` leaves files as the program does, `check`, `spectrum` and
`converge` judge them, `fit` finds their parameters from measurements, `methods()`, `problems()` and `backends()` list what there is, and `seiche.plot` draws.
What is to be known of a run, the notes of its result, is logged at INFO by ``logging.getLogger("seiche")``.
States are z = (field 0 at all points, field 1 at all points, …); units are those of the equation.
"""

from typing import TYPE_CHECKING, Any

from ._core import __citation__, __version__, backends, methods, problems
from ._ensemble import EnsembleResult, solve_ensemble
from ._fit import FitResult, fit
from ._problem import Case, Problem, load, problem
from ._result import DenseOutput, Result, SeicheWarning, Status
from ._run import CaseRun, read, resume, run
from ._simulation import Simulation, StepError
from ._solve import solve
from ._studies import check, converge, spectrum

if TYPE_CHECKING:
    from . import plot

__all__ = [
    "Case",
    "CaseRun",
    "DenseOutput",
    "EnsembleResult",
    "FitResult",
    "Problem",
    "Result",
    "SeicheWarning",
    "Simulation",
    "Status",
    "StepError",
    "__citation__",
    "__version__",
    "backends",
    "check",
    "converge",
    "fit",
    "load",
    "methods",
    "plot",
    "problem",
    "problems",
    "read",
    "resume",
    "run",
    "solve",
    "solve_ensemble",
    "spectrum",
]


def __getattr__(name: str) -> Any:
    if name == "plot":  # Matplotlib takes longer to import than most runs take
        import importlib

        return importlib.import_module(".plot", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
