"""What arguments may be: names that there are, arrays, files."""

from __future__ import annotations

import os
from typing import Any, Literal, Union

import numpy as np
from numpy.typing import ArrayLike as ArrayLike, NDArray

Array = NDArray[np.float64]
File = Union[str, "os.PathLike[str]"]
Size = Union[float, str]  # a number, or a fraction in quotes: "1/64"
Matrix = Any  # an array, one of scipy.sparse, or by formulas a table

# A test compares them with what the parser of case files allows.
# fmt: off
Method = Literal[
    "avf", "sav", "lm", "savf", "ssav", "slm", "eavf", "eisav", "eilm", "seavf", "seisav", "seilm", "seidm", "egc2", "egc4",
    "egc6", "egc8", "seimp", "etdrk4", "crkn4", "crkn6", "strang_exact", "chin4", "auto",
]
Backend = Literal["auto", "dense", "modal", "sparse", "reference", "petsc"]
ProblemName = Literal[
    "klein_gordon", "alpha_fpu", "gkdv", "sine_gordon", "oscillator", "nls", "beta_fpu", "chain", "wave", "truss", "network",
    "sparse", "burgers", "rigid_body", "allen_cahn", "cahn_hilliard", "swift_hohenberg", "phase_field_crystal",
    "custom",
]
Boundary = Literal["periodic", "dirichlet", "neumann"]
Discretisation = Literal["fd2", "fd4", "spectral"]
# fmt: on
